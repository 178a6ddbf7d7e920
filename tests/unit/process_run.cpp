// SPDX-License-Identifier: BSD-3-Clause
// Starting of other programs: exit codes, environment, and signals that must reach them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "src/core/base/error.hpp"
#include "src/core/base/machine.hpp"
#include "src/core/process/mpirun.hpp"
#include "src/core/process/process.hpp"

namespace whipple::process {
namespace {

TEST(RunProcess, ReturnsTheExitCodeOfTheProgram) {
  EXPECT_EQ(run_process({"sh", "-c", "exit 0"}), 0);
  EXPECT_EQ(run_process({"sh", "-c", "exit 3"}), 3);
}

TEST(RunProcess, AProgramThatIsNotThereIsAnInputError) {
  EXPECT_THROW(run_process({"/nonexistent/program"}), InputError);
}

TEST(RunProcess, ACrashOfTheProgramIsReported) {
  EXPECT_THROW(run_process({"sh", "-c", "kill -KILL $$"}), InternalError);
}

TEST(RunProcess, VariablesAreAddedAndReplaced) {
  ASSERT_EQ(setenv("WHIPPLE_TEST_OLD", "old", 1), 0);
  const Environment environment = {{"WHIPPLE_TEST_OLD", "new"}, {"WHIPPLE_TEST_ADDED", "a b"}};
  EXPECT_EQ(
      run_process({"sh", "-c", "test \"$WHIPPLE_TEST_OLD $WHIPPLE_TEST_ADDED\" = 'new a b'"}, environment),
      0);
  EXPECT_EQ(run_process({"sh", "-c", "test \"$WHIPPLE_TEST_OLD\" = old"}), 0);
}

TEST(RunProcess, StandardInputIsEmpty) { EXPECT_EQ(run_process({"sh", "-c", "! read line"}), 0); }

/// Sends a signal to this process as soon as the file exists (the program is ready for it then).
std::jthread signal_when_ready(const std::filesystem::path& ready, int signal) {
  return std::jthread([ready, signal] {
    while (!std::filesystem::exists(ready)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(getpid(), signal);
  });
}

class Signals : public ::testing::TestWithParam<std::pair<int, const char*>> {};

// A checkpoint is written by the program that is told of the signal: it must not end with this one.
TEST_P(Signals, ReachTheProgram) {
  const auto [signal, name] = GetParam();
  const std::filesystem::path ready =
      std::filesystem::temp_directory_path() / ("whipple_signal_" + std::to_string(getpid()) + name);
  std::filesystem::remove(ready);
  const std::string script = std::string("trap 'exit 7' ") + name + "; : > '" + ready.string() +
                             "'; i=0; while [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done; exit 1";
  {
    const std::jthread sender = signal_when_ready(ready, signal);
    EXPECT_EQ(run_process({"sh", "-c", script}), 7);
  }
  std::filesystem::remove(ready);
}

INSTANTIATE_TEST_SUITE_P(RunProcess, Signals,
                         ::testing::Values(std::pair(SIGINT, "INT"), std::pair(SIGTERM, "TERM"),
                                           std::pair(SIGUSR1, "USR1")));

TEST(RunProcess, AProgramEndedByASignalPassedOnGivesTheCodeOfShells) {
  const std::filesystem::path ready =
      std::filesystem::temp_directory_path() / ("whipple_signal_" + std::to_string(getpid()) + "default");
  std::filesystem::remove(ready);
  const std::jthread sender = signal_when_ready(ready, SIGTERM);
  EXPECT_EQ(run_process({"sh", "-c", ": > '" + ready.string() + "'; exec sleep 20"}), 128 + SIGTERM);
  std::filesystem::remove(ready);
}

// mpirun would kill its ranks after SIGTERM: it is told to end by another signal.
TEST(RunProcess, ASupervisorEndsByASignalOfItsOwnInAProcessGroupOfItsOwn) {
  const std::filesystem::path ready =
      std::filesystem::temp_directory_path() / ("whipple_signal_" + std::to_string(getpid()) + "end");
  std::filesystem::remove(ready);
  const std::string script = "trap 'exit 8' USR2; test $(cut -d' ' -f5 /proc/$$/stat) = $$ || exit 9; : > '" +
                             ready.string() +
                             "'; i=0; while [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done; exit 1";
  {
    const std::jthread sender = signal_when_ready(ready, SIGTERM);
    EXPECT_EQ(run_process({"sh", "-c", script}, {}, {.end_signal = SIGUSR2}), 8);
  }
  EXPECT_EQ(last_signal(), SIGTERM);
  std::filesystem::remove(ready);
  EXPECT_EQ(run_process({"sh", "-c", "kill -KILL $$"}, {}, {.may_be_killed = true}), 128 + SIGKILL);
}

TEST(RunProcess, ASupervisorThatDoesNotNoticeTheEndOfItsChildIsKilled) {
  // exec: the sleeping program inherits a child of the shell that it knows nothing of.
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(
      run_process({"sh", "-c", "sleep 0.1 & exec sleep 20"}, {}, {.may_be_killed = true, .patience = 0.5}),
      128 + SIGKILL);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  // One that waits for its children is left alone.
  EXPECT_EQ(
      run_process({"sh", "-c", "sleep 0.8 & wait; exit 3"}, {}, {.may_be_killed = true, .patience = 0.5}), 3);
}

// Ranks may wait for one another in a library, where no signal but KILL ends them.
TEST(RunProcess, ASupervisorThatDoesNotEndWhenAskedIsKilledWithWhatItStarted) {
  const std::filesystem::path ready =
      std::filesystem::temp_directory_path() / ("whipple_signal_" + std::to_string(getpid()) + "deaf");
  std::filesystem::remove(ready);
  const std::string script = "trap '' USR2 TERM; sleep 30 & echo $! > '" + ready.string() + ".new'; mv '" +
                             ready.string() + ".new' '" + ready.string() + "'; wait; sleep 30";
  const auto begin = std::chrono::steady_clock::now();
  {
    const std::jthread sender = signal_when_ready(ready, SIGTERM);
    EXPECT_EQ(run_process({"sh", "-c", script}, {},
                          {.end_signal = SIGUSR2, .may_be_killed = true, .patience_with_end = 0.5}),
              128 + SIGKILL);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(15));
  pid_t started = 0;
  std::ifstream(ready) >> started;
  ASSERT_GT(started, 0);
  // What it started belongs to init now, which may take notice of its end a little later.
  const auto is_alive = [&] {
    std::ifstream file("/proc/" + std::to_string(started) + "/stat");
    std::string number, name, state;
    file >> number >> name >> state;
    return !state.empty() && state != "Z";
  };
  for (int i = 0; i < 200 && is_alive(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(is_alive());
  std::filesystem::remove(ready);
}

TEST(Mpirun, FarMoreRanksThanProcessorsAreRefused) {
  const int most = std::max(16, 4 * usable_processors());
  try {
    mpirun(most + 1, {"whipple", "run"});
    ADD_FAILURE() << "started";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("at most " + std::to_string(most)), std::string::npos);
  }
}

TEST(RunProcess, HandlersAreRestored) {
  struct sigaction before = {}, after = {};
  sigaction(SIGTERM, nullptr, &before);
  run_process({"true"});
  sigaction(SIGTERM, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
}

TEST(PhysicalCores, AreAtLeastOneAndNoMoreThanTheThreads) {
  EXPECT_GE(physical_cores(), 1);
  EXPECT_LE(physical_cores(), static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace whipple::process
