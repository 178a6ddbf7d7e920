// SPDX-License-Identifier: BSD-3-Clause
// Proves: a run that is killed (SIGKILL) and restarted gives bitwise the history of an undisturbed run; one
// and two threads give bitwise the same; SIGTERM writes a checkpoint and ends cleanly; a failed state is
// saved and named. Every run is a child process, as a user's would be, and MPI is started in none of the
// parents.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "src/base/error.hpp"
#include "src/base/log.hpp"
#include "src/base/progress.hpp"
#include "src/io/checkpoint.hpp"
#include "src/solver/run.hpp"
#include "tests/parallel/debris_case.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;

/// A coarse copper disk through an aluminium plate with the three-phase equation of state: shocks, spall,
/// melting, symmetry planes, particles that leave the domain.
const char* const debris_head = R"(
title = "coarse debris cloud"
[domain]
lower = ["0 mm", "0 mm", "-8 mm"]
upper = ["12 mm", "12 mm", "14 mm"]
cell_size = "1 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry" }
[time]
end = "4 us"
[output]
snapshot_every = "1 us"
checkpoint_every = "1 ms"
[[gauge]]
name = "axis"
position = ["0.5 mm", "0.5 mm", "1 mm"]
[[gauge]]
name = "rear"
kind = "moving"
position = ["1 mm", "1 mm", "2.8 mm"]
[[tracers]]
name = "line"
from = ["0 mm", "0 mm", "-3 mm"]
to = ["4 mm", "0 mm", "-3 mm"]
count = 3
)";

class Run : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("whipple_run_" + std::to_string(getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "debris.toml") << debris_head << debris_case::bodies;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] solver::RunOptions options(const std::string& directory, int threads = 1) const {
    return {.case_file = folder_ / "debris.toml",
            .output_directory = folder_ / directory,
            .restart = false,
            .force = false,
            .threads = threads,
            .program = "test",
            .overrides = {}};
  }

  /// Runs in a child; `watch` may send it signals. @returns the status of waitpid
  static int run_in_child(const solver::RunOptions& options, const std::function<void(pid_t)>& watch = {}) {
    const pid_t child = fork();
    if (child == 0) {
      log::set_level(log::Level::quiet);
      set_progress_visible(false);
      int code = 99;
      try {
        code = solver::run(options);
      } catch (const StateError& error) {
        std::ofstream(options.output_directory / "error.txt") << error.what();
        code = 3;
      } catch (const InputError&) {
        code = 2;
      }
      _exit(code);
    }
    if (watch) watch(child);
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }

  static std::string text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
  }
  [[nodiscard]] std::string history(const std::string& directory) const {
    return text(folder_ / directory / "history.csv");
  }
  [[nodiscard]] std::string gauges(const std::string& directory) const {
    const std::string content = text(folder_ / directory / "gauges.csv");
    EXPECT_GT(content.size(), 1000U);
    return content;
  }
  /// Bytes of the last checkpoint: every field of every particle in full precision.
  [[nodiscard]] std::string newest_checkpoint(const std::string& directory) const {
    const std::vector<fs::path> paths = io::list_checkpoints(folder_ / directory / "checkpoint");
    EXPECT_FALSE(paths.empty());
    return paths.empty() ? directory : text(paths.front());
  }
  [[nodiscard]] std::size_t history_rows(const std::string& directory) const {
    const std::string content = history(directory);
    return static_cast<std::size_t>(std::count(content.begin(), content.end(), '\n'));
  }
  /// The first line in which two tables differ, empty if they are the same.
  static std::string first_difference(const std::string& a, const std::string& b) {
    std::istringstream left(a), right(b);
    std::string left_line, right_line;
    while (true) {
      const bool more_left = static_cast<bool>(std::getline(left, left_line));
      const bool more_right = static_cast<bool>(std::getline(right, right_line));
      if (!more_left && !more_right) return "";
      if (more_left != more_right) return "one table ends before the other";
      if (left_line != right_line) return left_line + "\n" + right_line;
    }
  }
  /// Sends a signal once the history has so many rows.
  [[nodiscard]] std::function<void(pid_t)> signal_at(const std::string& directory, std::size_t rows,
                                                     int signal) const {
    return [this, directory, rows, signal](pid_t child) {
      for (int i = 0; i < 60000 && history_rows(directory) < rows; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      kill(child, signal);
    };
  }

  fs::path folder_;
};

TEST_F(Run, KilledAndRestartedGivesBitwiseTheSameHistory) {
  ASSERT_EQ(run_in_child(options("whole")), 0);
  ASSERT_GT(history_rows("whole"), 50U);

  const int status = run_in_child(options("killed"), signal_at("killed", 30, SIGKILL));
  ASSERT_TRUE(WIFSIGNALED(status)) << "the run ended before it could be killed";
  ASSERT_LT(history_rows("killed"), history_rows("whole"));
  solver::RunOptions again = options("killed");
  again.case_file.clear();
  again.restart = true;
  ASSERT_EQ(run_in_child(again), 0);
  EXPECT_EQ(first_difference(history("killed"), history("whole")), "");
  EXPECT_EQ(first_difference(gauges("killed"), gauges("whole")), "");
  EXPECT_TRUE(newest_checkpoint("killed") == newest_checkpoint("whole"));
  // The index names the same snapshots.
  EXPECT_EQ(first_difference(text(folder_ / "killed" / "debris.particles.hdf.series"),
                             text(folder_ / "whole" / "debris.particles.hdf.series")),
            "");
}

TEST_F(Run, OneAndTwoThreadsGiveBitwiseTheSame) {
  ASSERT_EQ(run_in_child(options("one", 1)), 0);
  ASSERT_EQ(run_in_child(options("two", 2)), 0);
  EXPECT_EQ(first_difference(history("one"), history("two")), "");
  EXPECT_EQ(first_difference(gauges("one"), gauges("two")), "");
  EXPECT_TRUE(newest_checkpoint("one") == newest_checkpoint("two"));
}

TEST_F(Run, TerminationWritesACheckpointAndEndsCleanly) {
  const int status = run_in_child(options("stopped"), signal_at("stopped", 10, SIGTERM));
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
  EXPECT_FALSE(fs::is_empty(folder_ / "stopped" / "checkpoint"));
}

TEST_F(Run, EnergyOutOfBoundsStopsWithTheStateSaved) {
  // MUSL loses energy in the impact; with a tight limit the run must stop, name the step, and save the state.
  solver::RunOptions tight = options("tight");
  tight.overrides = {{"time.scheme", "musl"}, {"output.maximum_energy_error", "1e-6"}};
  const int status = run_in_child(tight);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  const std::string error = text(folder_ / "tight" / "error.txt");
  EXPECT_NE(error.find("relative error of the total energy"), std::string::npos) << error;
  EXPECT_NE(error.find("step "), std::string::npos) << error;
  EXPECT_FALSE(fs::is_empty(folder_ / "tight" / "failed"));
}

TEST_F(Run, NothingIsOverwritten) {
  ASSERT_EQ(run_in_child(options("whole")), 0);
  const std::string before = history("whole");
  const int status = run_in_child(options("whole"));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(first_difference(history("whole"), before), "");
}

}  // namespace
}  // namespace whipple
