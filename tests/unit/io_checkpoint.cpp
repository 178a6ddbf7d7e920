// SPDX-License-Identifier: BSD-3-Clause
// Checkpoints: bitwise round trip, two generations, recognised damage with a fall-back, other versions
// refused.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include "src/core/base/error.hpp"
#include "src/core/hdf5/hdf5.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/run_directory.hpp"
#include "src/io/sealed_file.hpp"
#include "tests/unit/io_support.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

using CheckpointFile = FolderTest;

CheckpointValues some_values() {
  CheckpointValues values;
  values.reals = {
      {"time", 1.0 / 3.0}, {"smallest", std::numeric_limits<double>::denorm_min()}, {"minus_zero", -0.0}};
  values.integers = {{"step", 12}, {"least", std::numeric_limits<std::int64_t>::min()}};
  values.texts = {{"case", "title = \"µ\"\n"}, {"empty", ""}, {"zero", std::string("a\0b", 3)}};
  values.arrays = {{"mass.body a/b", {1.5, -2.5}}, {"none", {}}};
  return values;
}

TEST_F(CheckpointFile, round_trip_is_bitwise) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{70'000}}) {
    for (const unsigned seed : {1U, 2U}) {  // with and without the optional fields
      const Particles particles = random_bits(n, seed);
      const fs::path path = write_checkpoint(folder_, 12, particles, some_values(), MPI_COMM_SELF);
      EXPECT_EQ(path, folder_ / "checkpoint.00000012.h5");
      const Checkpoint read = read_checkpoint(path, MPI_COMM_SELF);
      EXPECT_EQ(differing_fields(read.particles, particles), "") << n << " particles";
      EXPECT_EQ(read.values.reals, some_values().reals);
      EXPECT_TRUE(std::signbit(read.values.real("minus_zero")));
      EXPECT_EQ(read.values.integers, some_values().integers);
      EXPECT_EQ(read.values.texts, some_values().texts);
      EXPECT_EQ(read.values.arrays, some_values().arrays);
    }
  }
}

TEST_F(CheckpointFile, two_writes_of_one_state_give_one_and_the_same_file) {
  const Particles particles = random_bits(500, 2);
  const std::string first = read_text(write_checkpoint(folder_, 1, particles, some_values(), MPI_COMM_SELF));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 would stamp objects with the second
  const std::string second = read_text(write_checkpoint(folder_, 1, particles, some_values(), MPI_COMM_SELF));
  EXPECT_TRUE(first == second);
}

TEST_F(CheckpointFile, keeps_two_generations) {
  for (const std::int64_t step : {10, 20, 30}) {
    write_checkpoint(folder_, step, random_bits(10, 3), {}, MPI_COMM_SELF);
  }
  EXPECT_EQ(list_checkpoints(folder_),
            (std::vector<fs::path>{folder_ / "checkpoint.00000030.h5", folder_ / "checkpoint.00000020.h5"}));
  // Going on from step 20 gives up what came later.
  write_checkpoint(folder_, 25, random_bits(10, 3), {}, MPI_COMM_SELF);
  EXPECT_EQ(list_checkpoints(folder_),
            (std::vector<fs::path>{folder_ / "checkpoint.00000025.h5", folder_ / "checkpoint.00000020.h5"}));
}

TEST_F(CheckpointFile, the_latest_falls_back_to_the_one_before) {
  const Particles older = random_bits(100, 4);
  write_checkpoint(folder_, 10, older, some_values(), MPI_COMM_SELF);
  const fs::path newest = write_checkpoint(folder_, 20, random_bits(100, 5), some_values(), MPI_COMM_SELF);
  EXPECT_EQ(read_latest_checkpoint(folder_, MPI_COMM_SELF).path, newest);

  fs::resize_file(newest, fs::file_size(newest) - 1000);
  ::testing::internal::CaptureStderr();
  const Checkpoint read = read_latest_checkpoint(folder_, MPI_COMM_SELF);
  const std::string warning = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(read.path, folder_ / "checkpoint.00000010.h5");
  EXPECT_EQ(differing_fields(read.particles, older), "");
  EXPECT_THAT(warning,
              AllOf(HasSubstr(newest.string()), HasSubstr("truncated"), HasSubstr(read.path.string())));

  fs::resize_file(read.path, 100);
  EXPECT_THAT(
      message_of<InputError>([&] { (void)read_latest_checkpoint(folder_, MPI_COMM_SELF); }),
      AllOf(HasSubstr("no checkpoint is usable"), HasSubstr(newest.string()), HasSubstr(read.path.string())));
  EXPECT_THAT(message_of<InputError>([&] { (void)read_latest_checkpoint(folder_ / "none", MPI_COMM_SELF); }),
              HasSubstr("contains no checkpoint"));
}

TEST_F(CheckpointFile, a_run_killed_while_writing_leaves_the_one_before) {
  const fs::path good = write_checkpoint(folder_, 10, random_bits(100, 6), some_values(), MPI_COMM_SELF);
  std::ofstream(folder_ / "checkpoint.00000020.h5.partial") << read_text(good).substr(0, 5000);
  EXPECT_EQ(read_latest_checkpoint(folder_, MPI_COMM_SELF).path, good);
}

TEST_F(CheckpointFile, says_what_it_is_not) {
  const fs::path text = folder_ / "text.h5";
  std::ofstream(text) << "hello";
  EXPECT_THAT(message_of<InputError>([&] { (void)read_checkpoint(text, MPI_COMM_SELF); }),
              AllOf(HasSubstr(text.string()), HasSubstr("is not a checkpoint")));
  EXPECT_THAT(message_of<InputError>([&] { (void)read_checkpoint(folder_ / "none.h5", MPI_COMM_SELF); }),
              AllOf(HasSubstr("none.h5"), HasSubstr("No such file")));

  const fs::path newer = write_checkpoint(folder_, 1, {}, {}, MPI_COMM_SELF);
  std::string bytes = read_text(newer);
  bytes.replace(bytes.find("format 2"), 8, "format 9");
  std::ofstream(newer, std::ios::binary) << bytes;
  EXPECT_THAT(message_of<InputError>([&] { (void)read_checkpoint(newer, MPI_COMM_SELF); }),
              HasSubstr("of format 9; this program reads format 2"));

  CheckpointValues values;
  values.source = "x.h5";
  EXPECT_THAT(message_of<InputError>([&] { (void)values.real("time"); }),
              HasSubstr("x.h5: the value \"time\""));
}

TEST_F(CheckpointFile, names_missing_and_unknown_fields_and_other_units) {
  const auto write = [&](const char* left_out, const char* added, const char* volume_unit) {
    const fs::path path = folder_ / "other_version.h5";
    hdf5::File file = hdf5::File::create(path, hdf5::File::Compatibility::checksummed, seal_size);
    const hdf5::Group group = file.root.create_group("particles");
    group.set_attribute("count", std::int64_t{0});
    for_each_field<Particles>([&](const auto& field) {
      if (std::string(field.name) == left_out) return;
      const hdf5::Dataset array = group.write<double>(field.name, {}, hdf5::Slab::whole(0));
      array.set_fixed_attribute("unit", std::string(field.name) == "volume" ? volume_unit : field.unit);
    });
    if (*added != 0) group.write<double>(added, {}, hdf5::Slab::whole(0));
    file.close();
    seal(path);
    return message_of<InputError>([&] { (void)read_checkpoint(path, MPI_COMM_SELF); });
  };
  EXPECT_THAT(write("temperature", "", "m^3"), HasSubstr("missing fields: temperature"));
  EXPECT_THAT(write("", "spin", "m^3"), HasSubstr("unknown fields: spin"));
  EXPECT_THAT(write("", "", "cm^3"), HasSubstr("is in cm^3, expected m^3"));
}

/// A seal is no proof: whoever can write a file can seal it.
TEST_F(CheckpointFile, of_more_points_than_it_holds_is_refused) {
  const fs::path path = write_checkpoint(folder_, 1, random_bits(40, 2), some_values(), MPI_COMM_SELF);
  for (const std::int64_t count :
       {std::int64_t{-1}, std::int64_t{39}, std::int64_t{1'000'000'000'000'000'000}}) {
    hdf5::File file = hdf5::File::open(path, hdf5::File::Access::modify);
    {
      const hdf5::Group particles = file.root.open_group("particles");
      H5Adelete(particles.id(), "count");
      particles.set_attribute("count", count);
    }
    file.close();
    seal(path);
    EXPECT_THAT(message_of<InputError>([&] { (void)read_checkpoint(path, MPI_COMM_SELF); }),
                AllOf(HasSubstr(path.string()), HasSubstr(std::to_string(count))));
  }
}

TEST_F(CheckpointFile, an_unwritable_folder_is_the_users_matter) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THAT(message_of<InputError>([&] { write_checkpoint(folder_ / "file", 1, {}, {}, MPI_COMM_SELF); }),
              HasSubstr((folder_ / "file").string()));
}

}  // namespace
}  // namespace whipple::io
