// SPDX-License-Identifier: BSD-3-Clause
// Files that are written as a whole or not at all, and locks on them; where messages go.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/file_lock.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::ptrdiff_t files_in(const fs::path& folder) { return std::distance(fs::directory_iterator(folder), {}); }

TEST(PartialFile, TakesTheNameOfItsTargetWhenItIsPublished) {
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "table.csv";
  std::ofstream(target) << "old";
  {
    PartialFile partial(target);
    std::ofstream(partial.path()) << "new";
    EXPECT_EQ(content(target), "old");
    partial.publish(true);
  }
  EXPECT_EQ(content(target), "new");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(PartialFile, IsRemovedWhenItIsGivenUp) {
  const TemporaryFolder folder;
  {
    const PartialFile partial(folder.path() / "table.csv");
  }
  EXPECT_EQ(files_in(folder.path()), 0);
}

TEST(PartialFile, TwoOfOneTargetDoNotMeet) {
  const TemporaryFolder folder;
  const PartialFile first(folder.path() / "table.csv"), second(folder.path() / "table.csv");
  EXPECT_NE(first.path(), second.path());
}

// Whoever may write into the folder could have planted them.
TEST(WriteTextAtomically, LeavesFilesAndLinksOfOthersAlone) {
  const TemporaryFolder folder;
  const fs::path victim = folder.path() / "victim", target = folder.path() / "run.toml";
  std::ofstream(victim) << "mine";
  fs::create_symlink(victim, target);
  fs::create_symlink(victim, folder.path() / "run.toml.partial");
  write_text_atomically(target, "text");
  EXPECT_EQ(content(victim), "mine");
  EXPECT_EQ(content(target), "text");
}

TEST(WriteTextAtomically, WritesIntoWhatIsNoFileAsItIs) {
  EXPECT_NO_THROW(write_text_atomically("/dev/null", "text"));
  const TemporaryFolder folder;
  // A link below /dev to a file, such as /dev/stdout of a redirected program: written to, not replaced.
  const int file = ::open((folder.path() / "output").c_str(), O_CREAT | O_WRONLY, 0600);
  write_text_atomically(fmt::format("/dev/fd/{}", file), "text");
  ::close(file);
  EXPECT_EQ(read_text(folder.path() / "output"), "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  try {
    write_text_atomically("/dev/full", "text");
    FAIL() << "a full device took a text";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/dev/full: cannot write the file: No space left"));
  }
}

// A file system in memory, as clusters use for scratch, lies below /dev.
TEST(WriteTextAtomically, ReplacesFilesBelowDev) {
  std::string name = "/dev/shm/whipple_test_XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) GTEST_SKIP() << "no writable /dev/shm";
  const fs::path file = fs::path(name) / "t.toml";
  write_text_atomically(file, "first, longer");
  write_text_atomically(file, "second");
  EXPECT_EQ(content(file), "second");
  EXPECT_EQ(files_in(name), 1);
  fs::remove_all(name);
}

TEST(ReplaceDurably, WritesTheWholeFileAndRemovesWhatHasTheNameOfTheCopy) {
  const TemporaryFolder folder;
  const fs::path victim = folder.path() / "victim", target = folder.path() / "s.h5",
                 copy = folder.path() / ".part";
  std::ofstream(victim) << "mine";
  fs::create_symlink(victim, copy);
  replace_durably(target, copy, "first");
  replace_durably(target, copy, "second");
  EXPECT_EQ(content(victim), "mine");
  EXPECT_EQ(content(target), "second");
  EXPECT_EQ(files_in(folder.path()), 2);
}

TEST(AppendText, AddsToTheFileAndNamesTheReason) {
  const TemporaryFolder folder;
  append_text(folder.path() / "t.csv", "a\n");
  append_text(folder.path() / "t.csv", "b\n");
  EXPECT_EQ(content(folder.path() / "t.csv"), "a\nb\n");
  try {
    append_text(folder.path() / "none" / "t.csv", "a");
    FAIL() << "a folder that is missing took a file";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("none/t.csv: cannot write the file: No such file or directory"));
  }
}

TEST(Utf8, KeepsLettersAndReplacesOtherBytes) {
  EXPECT_EQ(utf8("L\xC3\xA4ufe \xE2\x82\xAC \xF0\x9F\x98\x80", "_"),
            "L\xC3\xA4ufe \xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(utf8("c\xE4", "_"), "c_");
  EXPECT_EQ(utf8("\xC0\x80\xED\xA0\x80\xF5", "_"),
            "______");  // no shortest form, half of a pair, beyond the last
  EXPECT_EQ(toml_string("c\xE4"), "\"c\xEF\xBF\xBD\"");
}

TEST(FileLock, IsRefusedWhileItIsHeldAndLeavesNothing) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / ".lock";
  {
    const FileLock lock(path, "the folder", FileLock::IfHeld::refuse);
    try {
      const FileLock second(path, "the folder", FileLock::IfHeld::refuse);
      FAIL() << "two locks at once";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr("the folder is being written by process " + std::to_string(getpid())));
    }
  }
  EXPECT_EQ(files_in(folder.path()), 0);
}

// The file of a killed holder stays, and locks nobody out; and one that waits gets the lock in the end.
TEST(FileLock, EndsWithItsProcess) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / ".lock";
  int ready[2] = {};
  ASSERT_EQ(pipe(ready), 0);
  const pid_t holder = fork();
  if (holder == 0) {
    const FileLock lock(path, "the folder", FileLock::IfHeld::refuse);
    (void)!write(ready[1], "x", 1);
    usleep(100'000);
    _exit(0);  // without destructors, as if killed
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THROW(FileLock(path, "the folder", FileLock::IfHeld::refuse), InputError);
  EXPECT_NO_THROW(FileLock(path, "the folder", FileLock::IfHeld::wait));
  EXPECT_NO_THROW(FileLock(path, "the folder", FileLock::IfHeld::refuse));
  waitpid(holder, nullptr, 0);
}

TEST(Log, GoesWhereTheCallerWantsByLevelAndToOneFile) {
  const TemporaryFolder folder;
  std::vector<std::pair<log::Kind, std::string>> shown;
  log::set_sink([&](log::Kind kind, const std::string& message) { shown.emplace_back(kind, message); });
  const auto say = [] {
    log::info("step {}", 1);
    log::warning("thin plate");
    log::detail("checkpoint");
  };
  log::set_file(folder.path() / "first.txt");
  say();
  log::set_level(log::Level::quiet);
  log::set_file(folder.path() / "second.txt");
  say();
  log::set_level(log::Level::verbose);
  log::detail("sorted");
  log::record_error("no energy");
  log::set_level(log::Level::normal);
  log::set_sink({});
  using enum log::Kind;
  EXPECT_EQ(
      shown,
      (std::vector<std::pair<log::Kind, std::string>>{
          {information, "step 1"}, {warning, "thin plate"}, {warning, "thin plate"}, {detail, "sorted"}}));
  const std::string first = content(folder.path() / "first.txt"),
                    second = content(folder.path() / "second.txt");
  EXPECT_THAT(first, ::testing::ContainsRegex("^20[-0-9]+ [0-9:]+ info: step 1\n"));
  EXPECT_THAT(first, HasSubstr(" warning: thin plate"));
  EXPECT_THAT(first, ::testing::Not(HasSubstr("warning: warning")));
  EXPECT_EQ(std::ranges::count(first, '\n'), 3);
  EXPECT_EQ(std::ranges::count(second, '\n'), 5);
  EXPECT_THAT(second, HasSubstr("error: no energy"));
}

}  // namespace
}  // namespace whipple
