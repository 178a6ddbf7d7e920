// SPDX-License-Identifier: BSD-3-Clause
// The HDF5 layer: what is written is read back bit by bit, and failures name the file, the act and HDF5's
// reason.
#include <gmock/gmock.h>

#include <fstream>

#include "src/base/error.hpp"
#include "src/io/hdf5.hpp"
#include "tests/unit/io_support.hpp"

namespace whipple::io::hdf5 {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Hdf5 : public FolderTest {
 protected:
  const Ranks one_{MPI_COMM_SELF};
};

TEST_F(Hdf5, reads_back_attributes_and_arrays) {
  const std::filesystem::path path = folder_ / "a.h5";
  const std::string long_text(200'000, 'x');  // longer than the 64 kB that an attribute itself may hold
  {
    File file = File::create(path, one_, File::Compatibility::vtk);
    const Group group = file.root.create_group("group");
    group.set_attribute("integer", std::int64_t{-7});
    group.set_attribute("real", 0.1);
    group.set_attribute("text", std::string_view("µs, \"quoted\""));
    group.set_attribute("long", std::string_view(long_text));
    group.set_fixed_attribute("fixed", "UnstructuredGrid");
    const std::vector<double> numbers = {1, 2, 3, 4, 5, 6};
    group.write<double>("numbers", numbers, Slab::whole(2), {.columns = 3, .deflate = 1, .fletcher32 = true},
                        one_);
    file.close();
  }
  const File file = File::open(path, one_);
  const Group group = file.root.open_group("group");
  EXPECT_EQ(group.integer_attribute("integer"), -7);
  EXPECT_EQ(group.real_attribute("real"), 0.1);
  EXPECT_EQ(group.text_attribute("text"), "µs, \"quoted\"");
  EXPECT_EQ(group.text_attribute("long"), long_text);
  EXPECT_EQ(group.text_attribute("fixed"), "UnstructuredGrid");
  EXPECT_EQ(group.attribute_names(), (std::vector<std::string>{"fixed", "integer", "long", "real", "text"}));
  const Dataset numbers = group.open_dataset("numbers");
  EXPECT_EQ(numbers.shape(), (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(numbers.read_all<double>(), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  std::vector<double> second_row(3);
  numbers.read_rows<double>(second_row, {1, 1, 2}, 3, one_);
  EXPECT_EQ(second_row, (std::vector<double>{4, 5, 6}));
}

TEST_F(Hdf5, writes_slabs_that_need_more_than_one_chunk) {
  const std::filesystem::path path = folder_ / "chunks.h5";
  std::vector<std::uint64_t> numbers(1000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i * i;
  File file = File::create(path, one_, File::Compatibility::vtk);
  file.root.write<std::uint64_t>("squares", numbers, Slab::whole(1000), {.deflate = 4, .chunk_rows = 128},
                                 one_);
  file.close();
  EXPECT_EQ(File::open(path, one_).root.open_dataset("squares").read_all<std::uint64_t>(), numbers);
}

TEST_F(Hdf5, errors_name_file_act_and_reason) {
  const std::filesystem::path missing = folder_ / "missing.h5";
  EXPECT_THAT(
      message_of<InputError>([&] { (void)File::open(missing, one_); }),
      AllOf(HasSubstr(missing.string()), HasSubstr("cannot open the file"), HasSubstr("No such file")));

  const std::filesystem::path text = folder_ / "text.h5";
  std::ofstream(text) << "this is no HDF5 file\n";
  EXPECT_THAT(message_of<InputError>([&] { (void)File::open(text, one_); }),
              AllOf(HasSubstr(text.string()), HasSubstr("signature")));

  const std::filesystem::path nowhere = folder_ / "no_such_folder" / "a.h5";
  EXPECT_THAT(message_of<InputError>([&] { (void)File::create(nowhere, one_, File::Compatibility::vtk); }),
              AllOf(HasSubstr(nowhere.string()), HasSubstr("cannot create the file")));

  const std::filesystem::path path = folder_ / "a.h5";
  File file = File::create(path, one_, File::Compatibility::vtk);
  const std::vector<float> numbers = {1, 2, 3};
  file.root.write<float>("numbers", numbers, Slab::whole(3), {}, one_);
  file.close();
  const File again = File::open(path, one_);
  EXPECT_THAT(message_of<InputError>([&] { (void)again.root.open_dataset("other"); }),
              AllOf(HasSubstr(path.string()), HasSubstr("open data set other"), HasSubstr("doesn't exist")));
  EXPECT_THAT(message_of<InputError>([&] { (void)again.root.real_attribute("unit"); }),
              HasSubstr("attribute unit"));
  const Dataset dataset = again.root.open_dataset("numbers");
  EXPECT_THAT(message_of<InputError>([&] { (void)dataset.read_all<double>(); }), HasSubstr("another type"));
  std::vector<float> four(4);
  EXPECT_THAT(message_of<InputError>([&] { dataset.read_rows<float>(four, Slab::whole(4), 1, one_); }),
              HasSubstr("has 3 rows of 1 numbers, expected 4 rows of 1"));
}

TEST_F(Hdf5, a_full_disk_is_reported) {
  // /dev/full accepts to be opened and refuses every byte.
  const std::vector<double> numbers(1 << 16, 1.0);
  EXPECT_THAT(message_of<InputError>([&] {
                File file = File::create("/dev/full", one_, File::Compatibility::vtk);
                file.root.write<double>("numbers", numbers, Slab::whole(numbers.size()), {}, one_);
                file.close();
              }),
              HasSubstr("/dev/full"));
}

}  // namespace
}  // namespace whipple::io::hdf5
