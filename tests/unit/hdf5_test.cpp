// SPDX-License-Identifier: BSD-3-Clause
// The HDF5 layer: what is written is read back bit by bit, and failures name the file, the act and HDF5's
// reason.
#include "src/core/hdf5/hdf5.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <fstream>

#include "src/core/base/error.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::hdf5 {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Hdf5 : public FolderTest {};

TEST_F(Hdf5, reads_back_attributes_and_arrays) {
  const std::filesystem::path path = folder_ / "a.h5";
  const std::string long_text(200'000, 'x');  // longer than the 64 kB that an attribute itself may hold
  {
    File file = File::create(path, File::Compatibility::vtk);
    const Group group = file.root.create_group("group");
    group.set_attribute("integer", std::int64_t{-7});
    group.set_attribute("real", 0.1);
    group.set_fixed_attribute("text", "µs, \"quoted\"");
    group.set_attribute("long", std::string_view(long_text));
    group.set_fixed_attribute("fixed", "UnstructuredGrid");
    const std::vector<double> numbers = {1, 2, 3, 4, 5, 6};
    group.write<double>("numbers", numbers, Slab::whole(2), {.columns = 3, .deflate = 1, .fletcher32 = true});
    file.close();
  }
  const File file = File::open(path);
  const Group group = file.root.open_group("group");
  EXPECT_EQ(group.integer_attribute("integer"), -7);
  EXPECT_EQ(group.real_attribute("real"), 0.1);
  EXPECT_EQ(group.text_attribute("text"), "µs, \"quoted\"");
  EXPECT_THAT(message_of<InputError>([&] { (void)group.text_attribute("long"); }),
              HasSubstr("attribute long is a text of variable length"));
  EXPECT_EQ(group.text_attribute("fixed"), "UnstructuredGrid");
  EXPECT_EQ(group.attribute_names(), (std::vector<std::string>{"fixed", "integer", "long", "real", "text"}));
  const Dataset numbers = group.open_dataset("numbers");
  EXPECT_EQ(numbers.shape(), (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(numbers.read_all<double>(), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  std::vector<double> second_row(3);
  numbers.read_rows<double>(second_row, {1, 1, 2}, 3);
  EXPECT_EQ(second_row, (std::vector<double>{4, 5, 6}));
}

TEST_F(Hdf5, writes_slabs_that_need_more_than_one_chunk) {
  const std::filesystem::path path = folder_ / "chunks.h5";
  std::vector<std::uint64_t> numbers(1000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i * i;
  File file = File::create(path, File::Compatibility::vtk);
  file.root.write<std::uint64_t>("squares", numbers, Slab::whole(1000), {.deflate = 4, .chunk_rows = 128});
  file.close();
  const File again = File::open(path);
  EXPECT_EQ(again.root.open_dataset("squares").read_all<std::uint64_t>(), numbers);
  // Rows that begin and end within chunks.
  std::vector<std::uint64_t> part(500);
  again.root.open_dataset("squares").read_rows<std::uint64_t>(part, {200, 500, 1000}, 1);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), numbers.begin() + 200));
}

/// Deflated by libhdf5 itself, without shuffle, in chunks of some of the columns, of another byte order.
TEST_F(Hdf5, reads_chunks_of_any_shape) {
  const std::filesystem::path path = folder_ / "a.h5";
  std::vector<float> numbers(50 * 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 0.5F * static_cast<float>(i);
  const hsize_t lengths[2] = {50, 3};
  const auto written = [&](hsize_t rows, hsize_t columns, bool shuffle, hid_t type) {
    const hsize_t chunk[2] = {rows, columns};
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(2, lengths, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 2, chunk);
    if (shuffle) H5Pset_shuffle(creation);
    H5Pset_deflate(creation, 3);
    const hid_t array = H5Dcreate2(file, "numbers", type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Dwrite(array, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Dclose(array);
    H5Pclose(creation);
    H5Sclose(space);
    H5Fclose(file);
    std::vector<float> found(numbers.size());
    File::open(path).root.open_dataset("numbers").read_rows<float>(found, Slab::whole(50), 3);
    return found;
  };
  EXPECT_EQ(written(16, 3, true, H5T_NATIVE_FLOAT), numbers);
  EXPECT_EQ(written(16, 3, false, H5T_NATIVE_FLOAT), numbers);
  EXPECT_EQ(written(50, 3, true, H5T_NATIVE_FLOAT), numbers);
  EXPECT_EQ(written(16, 2, true, H5T_NATIVE_FLOAT), numbers);
  EXPECT_EQ(written(7, 3, true, H5T_IEEE_F32BE), numbers);
}

TEST_F(Hdf5, tells_the_type_of_stored_numbers) {
  const std::filesystem::path path = folder_ / "types.h5";
  const std::vector<std::uint8_t> bytes = {1, 2};
  const std::vector<float> reals = {1.0F, 2.0F};
  File file = File::create(path, File::Compatibility::compact);
  file.root.write<std::uint8_t>("bytes", bytes, Slab::whole(2));
  file.root.write<float>("reals", reals, Slab::whole(2));
  file.close();
  const File read = File::open(path);
  EXPECT_TRUE(read.root.open_dataset("bytes").stores<std::uint8_t>());
  EXPECT_FALSE(read.root.open_dataset("bytes").stores<std::uint16_t>());
  EXPECT_FALSE(read.root.open_dataset("bytes").stores<float>());
  EXPECT_TRUE(read.root.open_dataset("reals").stores<float>());
  EXPECT_FALSE(read.root.open_dataset("reals").stores<double>());
}

TEST_F(Hdf5, keeps_the_order_of_creation_and_changes_an_open_file) {
  const std::filesystem::path path = folder_ / "a.h5";
  {
    File file = File::create(path, File::Compatibility::compact);
    const Group group = file.root.create_group("points", Order::creation);
    for (const char* name : {"c", "a", "b"}) group.create_group(name);
    file.close();
  }
  {
    File file = File::open(path, File::Access::modify);
    const Group group = file.root.open_group("points");
    group.remove("a");
    group.set_fixed_attribute("empty", "");
    group.set_fixed_attribute("text", "10 \u00b5s");
    file.close();
  }
  const File file = File::open(path);
  const Group group = file.root.open_group("points");
  EXPECT_EQ(group.names(), (std::vector<std::string>{"b", "c"}));
  EXPECT_EQ(group.names(Order::creation), (std::vector<std::string>{"c", "b"}));
  EXPECT_TRUE(group.has_attribute("empty"));
  EXPECT_FALSE(group.has_attribute("other"));
  EXPECT_EQ(group.text_attribute("empty"), "");
  EXPECT_EQ(group.text_attribute("text"), "10 \u00b5s");
  EXPECT_THAT(message_of<InputError>([&] { group.remove("c"); }), HasSubstr("cannot remove c"));
}

TEST_F(Hdf5, errors_name_file_act_and_reason) {
  const std::filesystem::path missing = folder_ / "missing.h5";
  EXPECT_THAT(
      message_of<InputError>([&] { (void)File::open(missing); }),
      AllOf(HasSubstr(missing.string()), HasSubstr("cannot open the file"), HasSubstr("No such file")));

  const std::filesystem::path text = folder_ / "text.h5";
  std::ofstream(text) << "this is no HDF5 file\n";
  EXPECT_THAT(message_of<InputError>([&] { (void)File::open(text); }),
              AllOf(HasSubstr(text.string()), HasSubstr("signature")));

  const std::filesystem::path nowhere = folder_ / "no_such_folder" / "a.h5";
  EXPECT_THAT(message_of<InputError>([&] { (void)File::create(nowhere, File::Compatibility::vtk); }),
              AllOf(HasSubstr(nowhere.string()), HasSubstr("cannot create the file")));

  const std::filesystem::path path = folder_ / "a.h5";
  File file = File::create(path, File::Compatibility::vtk);
  const std::vector<float> numbers = {1, 2, 3};
  file.root.write<float>("numbers", numbers, Slab::whole(3));
  file.close();
  const File again = File::open(path);
  EXPECT_THAT(message_of<InputError>([&] { (void)again.root.open_dataset("other"); }),
              AllOf(HasSubstr(path.string()), HasSubstr("open data set other"), HasSubstr("doesn't exist")));
  EXPECT_THAT(message_of<InputError>([&] { (void)again.root.real_attribute("unit"); }),
              HasSubstr("attribute unit"));
  const Dataset dataset = again.root.open_dataset("numbers");
  EXPECT_THAT(message_of<InputError>([&] { (void)dataset.read_all<double>(); }), HasSubstr("another type"));
  std::vector<float> four(4);
  EXPECT_THAT(message_of<InputError>([&] { dataset.read_rows<float>(four, Slab::whole(4), 1); }),
              HasSubstr("has 3 rows of 1 numbers, expected 4 rows of 1"));
}

/// Room is made for what the file holds, not for what it declares.
TEST_F(Hdf5, refuses_arrays_that_the_file_cannot_hold) {
  const std::filesystem::path path = folder_ / "a.h5";
  {
    File file = File::create(path, File::Compatibility::vtk);
    const std::vector<double> zeros(1 << 20);
    file.root.write<double>("zeros", zeros, Slab::whole(zeros.size()), {.deflate = 9});
    for (const bool in_chunks : {false, true}) {
      const hsize_t rows = 1'000'000'000'000, chunk = 1 << 16;
      const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
      const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      if (in_chunks) H5Pset_chunk(creation.get(), 1, &chunk);
      const Handle empty(H5Dcreate2(file.root.id(), in_chunks ? "chunks" : "block", H5T_IEEE_F64LE,
                                    space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                         H5Dclose);
    }
    file.close();
  }
  const File file = File::open(path);
  for (const char* name : {"chunks", "block"}) {
    const Dataset dataset = file.root.open_dataset(name);
    EXPECT_THAT(message_of<InputError>([&] { (void)dataset.read_all<double>(); }),
                AllOf(HasSubstr(name), HasSubstr("which the file does not hold")));
  }
  EXPECT_EQ(file.root.open_dataset("zeros").read_all<double>(), std::vector<double>(1 << 20))
      << "a thousandfold compression is none";
}

/// libhdf5 copies what a compact array declares, not what it has: it reads beyond its memory.
TEST_F(Hdf5, refuses_compact_arrays_that_declare_more_than_they_hold) {
  const std::filesystem::path path = folder_ / "a.h5";
  const hsize_t rows = 1234, declared = 1235;
  const std::uint8_t one = 1;
  {
    File file = File::create(path, File::Compatibility::vtk);
    const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_layout(creation.get(), H5D_COMPACT);
    H5Pset_fill_value(creation.get(), H5T_NATIVE_UINT8, &one);
    const Handle made(H5Dcreate2(file.root.id(), "bytes", H5T_STD_U8LE, space.get(), H5P_DEFAULT,
                                 creation.get(), H5P_DEFAULT),
                      H5Dclose);
    file.close();
  }
  EXPECT_EQ(File::open(path).root.open_dataset("bytes").read_all<std::uint8_t>(),
            std::vector<std::uint8_t>(rows, one));
  const auto bytes_of = [](hsize_t number) {
    return std::string(reinterpret_cast<const char*>(&number), sizeof number);
  };
  std::ifstream whole(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  int replaced = 0;  // length and greatest length
  for (std::size_t at; (at = bytes.find(bytes_of(rows))) != std::string::npos; ++replaced) {
    bytes.replace(at, sizeof rows, bytes_of(declared));
  }
  ASSERT_EQ(replaced, 2);
  std::ofstream(path, std::ios::binary) << bytes;
  const File file = File::open(path);
  EXPECT_THAT(message_of<InputError>([&] { (void)file.root.open_dataset("bytes").read_all<std::uint8_t>(); }),
              AllOf(HasSubstr("bytes"), HasSubstr("which the file does not hold")));
}

/// libhdf5 copies a chunk of the declared size, whatever the filters made of the stored one.
TEST_F(Hdf5, refuses_chunks_that_are_not_whole) {
  const std::filesystem::path path = folder_ / "a.h5";
  const std::vector<double> numbers(100, 0.25);
  const auto refusal_of = [&](const std::vector<char>& chunk, std::uint32_t skipped) {
    File file = File::create(path, File::Compatibility::vtk);
    const Dataset made =
        file.root.write<double>("numbers", numbers, Slab::whole(100), {.deflate = 1, .chunk_rows = 100});
    const hsize_t offset = 0;
    H5Dwrite_chunk(made.id(), H5P_DEFAULT, skipped, &offset, chunk.size(), chunk.data());
    file.close();
    const File again = File::open(path);
    return message_of<InputError>([&] { (void)again.root.open_dataset("numbers").read_all<double>(); });
  };
  const auto damaged = HasSubstr("numbers: chunk 0 is no whole chunk of 800 bytes: the file is damaged");
  const unsigned deflate = 2;  // the second filter
  EXPECT_THAT(refusal_of(std::vector<char>(22, 'x'), deflate), damaged);
  EXPECT_THAT(refusal_of(std::vector<char>(22, 'x'), 0), damaged);
  const std::vector<Bytef> short_of_one(799);
  uLongf size = compressBound(short_of_one.size());
  std::vector<char> chunk(size);
  compress(reinterpret_cast<Bytef*>(chunk.data()), &size, short_of_one.data(), short_of_one.size());
  chunk.resize(size);
  EXPECT_THAT(refusal_of(chunk, 0), damaged);
}

TEST_F(Hdf5, a_full_disk_is_reported) {
  // /dev/full accepts to be opened and refuses every byte.
  const std::vector<double> numbers(1 << 16, 1.0);
  EXPECT_THAT(message_of<InputError>([&] {
                File file = File::create("/dev/full", File::Compatibility::vtk);
                file.root.write<double>("numbers", numbers, Slab::whole(numbers.size()));
                file.close();
              }),
              HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace whipple::hdf5
