// SPDX-License-Identifier: BSD-3-Clause
// A checkpoint that was damaged in any one place is recognised: no crash, no hang, no state read from it.
// WHIPPLE_FUZZ_TRIALS sets the number of damaged blocks (default 200); under the preset dev the sanitizers
// watch.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "src/core/base/error.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/run_directory.hpp"
#include "tests/unit/io_support.hpp"

namespace whipple::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class DamagedCheckpoint : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    CheckpointValues values;
    values.reals = {{"time", 0.25}};
    values.texts = {{"case", "title"}};
    path_ = write_checkpoint(folder_, 1, random_bits(40, 7), values, MPI_COMM_SELF);
    bytes_ = read_text(path_);
  }
  void expect_refused(const std::string& what) {
    try {
      (void)read_checkpoint(path_, MPI_COMM_SELF);
      FAIL() << "accepted: " << what;
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), HasSubstr(path_.string())) << what;
    }
  }
  /// Writes in place: thousands of new files would measure the disk.
  void overwrite(std::size_t at, const std::string& bytes) {
    std::fstream stream(path_, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(static_cast<std::streamoff>(at));
    stream << bytes;
  }
  fs::path path_;
  std::string bytes_;
};

TEST_F(DamagedCheckpoint, every_single_flipped_bit_is_recognised) {
  std::mt19937 random(8);
  for (std::size_t i = 0; i < bytes_.size(); i += i < 4096 ? 1 : 1 + random() % 13) {
    overwrite(i, std::string(1, static_cast<char>(bytes_[i] ^ (1 << (random() % 8)))));
    expect_refused("bit flipped in byte " + std::to_string(i));
    if (HasFatalFailure()) return;
    overwrite(i, bytes_.substr(i, 1));
  }
  EXPECT_NO_THROW((void)read_checkpoint(path_, MPI_COMM_SELF));
}

TEST_F(DamagedCheckpoint, every_truncation_is_recognised) {
  overwrite(bytes_.size(), "x");
  expect_refused("one byte more");
  for (std::size_t size = bytes_.size() - 1; size > 0; size -= size < 1100 ? 1 : 97) {
    fs::resize_file(path_, size);
    expect_refused("cut to " + std::to_string(size) + " bytes");
    if (HasFatalFailure()) return;
  }
  fs::resize_file(path_, 0);
  expect_refused("emptied");
}

TEST_F(DamagedCheckpoint, overwritten_and_swapped_blocks_are_recognised) {
  std::mt19937 random(9);
  const char* wanted = std::getenv("WHIPPLE_FUZZ_TRIALS");
  const int trials = wanted != nullptr ? std::atoi(wanted) : 200;
  for (int trial = 0; trial < trials; ++trial) {
    const std::size_t length = 1 + random() % 2048;
    const std::size_t from = random() % (bytes_.size() - length);
    const std::size_t to = random() % (bytes_.size() - length);
    const std::string block = trial % 2 == 0 ? std::string(length, '\0') : bytes_.substr(from, length);
    if (block == bytes_.substr(to, length)) continue;
    overwrite(to, block);
    expect_refused("block of " + std::to_string(length) + " bytes at " + std::to_string(to));
    if (HasFatalFailure()) return;
    overwrite(to, bytes_.substr(to, length));
  }
}

TEST_F(DamagedCheckpoint, the_undamaged_file_is_accepted) {
  EXPECT_EQ(differing_fields(read_checkpoint(path_, MPI_COMM_SELF).particles, random_bits(40, 7)), "");
}

}  // namespace
}  // namespace whipple::io
