// SPDX-License-Identifier: BSD-3-Clause
// The run directory: nothing of the user's is overwritten or removed, and refusals say what to do.
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "src/core/base/error.hpp"
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
                       "checkpoint/checkpoint.00000013.h5.0123abcd.partial",
                       "failed/checkpoint.00000012.h5",
                       "status.json",
                       "steering.csv",
                       "control/1700.toml",
                       "control/1700.toml.taken"};
  const char* others[] = {
      "notes.md",         "case.toml",       "particles.hdf",           "disk.particles.7.hdf",
      "run.toml.backup",  "history.csv.old", "checkpoint/keep.h5",      "checkpoint/checkpoint.1.h5",
      "my.particles.txt", "report.html",     "disk.particles.000007.h", "control/notes.txt"};
  fs::create_directories(folder_ / "checkpoint");
  fs::create_directories(folder_ / "failed");
  fs::create_directories(folder_ / "control");
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

TEST_F(RunDirectoryTest, what_a_killed_run_left_half_written_is_removed) {
  const RunDirectory run = RunDirectory::create(folder_, "disk", false);
  fs::create_directories(folder_ / "materials");
  const char* left[] = {"run.toml.0123abcd.partial", "disk.particles.000003.hdf.0123abcd.partial",
                        "checkpoint/checkpoint.00000012.h5.0123abcd.partial",
                        "materials/copper.toml.0123abcd.partial"};
  const char* others[] = {"history.csv", "disk.particles.000002.hdf", "checkpoint/checkpoint.00000011.h5",
                          "notes.md.0123abcd.partial", "materials/copper.toml"};
  for (const char* file : left) touch(folder_ / file);
  for (const char* file : others) touch(folder_ / file);
  run.remove_partial_files();
  for (const char* file : left) EXPECT_FALSE(fs::exists(folder_ / file)) << file;
  for (const char* file : others) EXPECT_TRUE(fs::exists(folder_ / file)) << file;
}

TEST_F(RunDirectoryTest, has_one_run_at_a_time) {
  const fs::path path = folder_ / "run";
  {
    const RunDirectory run = RunDirectory::create(path, "disk", false);
    const std::string holder = "process " + std::to_string(getpid()) + " on ";
    EXPECT_THAT(message_of<InputError>([&] { (void)RunDirectory::create(path, "disk", true); }),
                AllOf(HasSubstr(path.string()), HasSubstr(holder)));
    EXPECT_THAT(message_of<InputError>([&] { (void)lock_run(path); }), HasSubstr(holder));
    EXPECT_TRUE(is_running(path));
  }
  EXPECT_FALSE(is_running(path));
  EXPECT_NO_THROW((void)lock_run(path));
  EXPECT_THAT(message_of<InputError>([&] { (void)lock_run(folder_ / "none"); }), HasSubstr("no such folder"));
}

TEST_F(RunDirectoryTest, force_removes_nothing_behind_a_link) {
  fs::create_directories(folder_ / "elsewhere");
  touch(folder_ / "elsewhere" / "checkpoint.00000012.h5");
  touch(folder_ / "victim");
  fs::create_directories(folder_ / "run");
  fs::create_symlink(folder_ / "victim", folder_ / "run" / "history.csv");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "run" / "checkpoint");
  EXPECT_THAT(message_of<InputError>([&] { (void)RunDirectory::create(folder_ / "run", "disk", true); }),
              AllOf(HasSubstr("checkpoint"), HasSubstr("symbolic link")));
  EXPECT_TRUE(fs::exists(folder_ / "elsewhere" / "checkpoint.00000012.h5"));
  fs::remove(folder_ / "run" / "checkpoint");
  (void)RunDirectory::create(folder_ / "run", "disk", true);
  EXPECT_FALSE(fs::is_symlink(folder_ / "run" / "history.csv")) << "a run would write its history through it";
  EXPECT_TRUE(fs::exists(folder_ / "victim"));
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
  EXPECT_THAT(message_of<InputError>([&] { write_text_atomically(folder_ / "none" / "text", "x"); }),
              HasSubstr((folder_ / "none" / "text").string()));
  EXPECT_THAT(message_of<InputError>([&] { (void)read_text(folder_ / "none"); }),
              AllOf(HasSubstr((folder_ / "none").string()), HasSubstr("no such file")));
}

}  // namespace
}  // namespace whipple::io
