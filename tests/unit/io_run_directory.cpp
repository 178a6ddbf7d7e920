// SPDX-License-Identifier: BSD-3-Clause
// The run directory: nothing of the user's is overwritten or removed, and refusals say what to do.
#include <gmock/gmock.h>

#include <fstream>
#include <limits>

#include "src/base/error.hpp"
#include "src/io/run_directory.hpp"
#include "tests/unit/io_support.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

using RunDirectoryTest = FolderTest;

void touch(const fs::path& path) { std::ofstream(path) << "x"; }

TEST_F(RunDirectoryTest, is_made_with_its_parents_and_takes_the_input) {
  const RunDirectory run = RunDirectory::create(folder_ / "a" / "b", "disk", false);
  EXPECT_TRUE(fs::is_directory(run.checkpoint_folder()));
  run.write_input("title = \"disk\"\n");
  EXPECT_EQ(read_text(run.input_file()), "title = \"disk\"\n");
  EXPECT_EQ(RunDirectory::open(folder_ / "a" / "b", "disk").name(), "disk");
}

TEST_F(RunDirectoryTest, an_existing_empty_folder_is_used) {
  EXPECT_NO_THROW((void)RunDirectory::create(folder_, "disk", false));
}

TEST_F(RunDirectoryTest, refuses_a_folder_that_holds_anything) {
  touch(folder_ / "notes.md");
  EXPECT_THAT(message_of<InputError>([&] { (void)RunDirectory::create(folder_, "disk", false); }),
              AllOf(HasSubstr(folder_.string()), HasSubstr("not empty"), HasSubstr("--force"),
                    HasSubstr("--restart")));
  EXPECT_TRUE(fs::exists(folder_ / "notes.md"));
  EXPECT_FALSE(fs::exists(folder_ / "checkpoint"));
}

TEST_F(RunDirectoryTest, force_removes_its_own_outputs_and_nothing_else) {
  const char* own[] = {"run.toml",
                       "history.csv",
                       "log.txt",
                       "disk.particles.hdf.series",
                       "disk.particles.000007.hdf",
                       "other.particles.000000.hdf.partial",
                       "checkpoint/checkpoint.00000012.h5",
                       "checkpoint/checkpoint.00000012.h5.partial",
                       "failed/checkpoint.00000012.h5"};
  const char* others[] = {
      "notes.md",         "case.toml",       "particles.hdf",          "disk.particles.7.hdf",
      "run.toml.backup",  "history.csv.old", "checkpoint/keep.h5",     "checkpoint/checkpoint.1.h5",
      "my.particles.txt", "report.html",     "disk.particles.000007.h"};
  fs::create_directories(folder_ / "checkpoint");
  fs::create_directories(folder_ / "failed");
  fs::create_directories(folder_ / "subfolder" / "deep");
  touch(folder_ / "subfolder" / "run.toml");
  for (const char* file : own) touch(folder_ / file);
  for (const char* file : others) touch(folder_ / file);
  (void)RunDirectory::create(folder_, "disk", true);
  for (const char* file : own) EXPECT_FALSE(fs::exists(folder_ / file)) << file;
  for (const char* file : others) EXPECT_TRUE(fs::exists(folder_ / file)) << file;
  EXPECT_TRUE(fs::exists(folder_ / "subfolder" / "run.toml"));
  EXPECT_FALSE(fs::exists(folder_ / "failed")) << "a run that did not fail must not seem to have";
}

TEST_F(RunDirectoryTest, refuses_a_file_an_unwritable_place_and_a_folder_without_a_run) {
  touch(folder_ / "file");
  EXPECT_THAT(message_of<InputError>([&] { (void)RunDirectory::create(folder_ / "file", "disk", true); }),
              HasSubstr("is not a folder"));
  EXPECT_THAT(
      message_of<InputError>([&] { (void)RunDirectory::create(folder_ / "file" / "run", "disk", false); }),
      AllOf(HasSubstr("cannot make the folder"), HasSubstr((folder_ / "file" / "run").string())));
  // The kernel's folder refuses new files whoever asks, the superuser included.
  EXPECT_THAT(message_of<InputError>([&] { (void)RunDirectory::create("/proc/self/task", "disk", true); }),
              HasSubstr("/proc/self/task"));
  EXPECT_THAT(message_of<InputError>([&] { (void)RunDirectory::open(folder_ / "none", "disk"); }),
              HasSubstr("no such folder"));
  EXPECT_THAT(message_of<InputError>([&] { (void)RunDirectory::open(folder_, "disk"); }),
              HasSubstr("no run.toml"));
}

TEST_F(RunDirectoryTest, asks_for_free_space) {
  const RunDirectory run = RunDirectory::create(folder_ / "run", "disk", false);
  EXPECT_NO_THROW(run.require_free_space(1));
  EXPECT_THAT(
      message_of<InputError>([&] { run.require_free_space(std::numeric_limits<std::uint64_t>::max()); }),
      AllOf(HasSubstr((folder_ / "run").string()), HasSubstr("needs about")));
}

TEST_F(RunDirectoryTest, a_text_is_replaced_as_a_whole) {
  const fs::path path = folder_ / "text";
  write_text_atomically(path, "first");
  write_text_atomically(path, "second, longer than the first");
  EXPECT_EQ(read_text(path), "second, longer than the first");
  EXPECT_FALSE(fs::exists(folder_ / "text.partial"));
  EXPECT_THAT(message_of<InputError>([&] { write_text_atomically(folder_ / "none" / "text", "x"); }),
              HasSubstr((folder_ / "none" / "text").string()));
  EXPECT_THAT(message_of<InputError>([&] { (void)read_text(folder_ / "none"); }),
              AllOf(HasSubstr((folder_ / "none").string()), HasSubstr("No such file")));
}

}  // namespace
}  // namespace whipple::io
