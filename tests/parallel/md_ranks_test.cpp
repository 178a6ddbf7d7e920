// SPDX-License-Identifier: BSD-3-Clause
// whipple-md as its users start it: the numbers do not depend on the ranks, a killed run goes on where it
// stood, and the exit codes say what happened.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>

#include "md_fitting/data_set/data_set.hpp"
#include "tests/folders.hpp"
#include "tests/parallel/md_program.hpp"

namespace whipple::md {
namespace {

using testing::expect_same_points;
using testing::mpirun;
using testing::Outcome;
using testing::plan_text;
using testing::run;
using testing::WhippleMd;

TEST_F(WhippleMd, NumbersDoNotDependOnTheRanks) {
  const Outcome alone = run(command("one.md.h5"));
  ASSERT_EQ(alone.code, 0) << alone.text;
  for (const int ranks : {2, 3}) {
    const std::string store = std::to_string(ranks) + ".md.h5";
    const Outcome together = run(mpirun(ranks, command(store)));
    ASSERT_EQ(together.code, 0) << together.text;
    expect_same_points(read_store(path("one.md.h5")), read_store(path(store)));
  }
  const Outcome again = run(mpirun(2, command("one.md.h5")));
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.text.find("nothing to compute: all 7 points are in"), std::string::npos) << again.text;
}

TEST_F(WhippleMd, KilledRunGoesOnWhereItStood) {
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
    const std::string program = whipple::tests::program("whipple-md");
    execl(program.c_str(), program.c_str(), path("plan.toml").c_str(), "-o", path("killed.md.h5").c_str(),
          nullptr);
    _exit(1);
  }
  const auto store = folder.path() / "killed.md.h5";
  std::size_t before = 0;
  for (int i = 0; i < 6000 && before < 2; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (std::filesystem::exists(store)) before = read_store(store).size();
  }
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  before = read_store(store).size();
  ASSERT_GE(before, 2U);
  const Outcome rest = run(command("killed.md.h5"));
  EXPECT_EQ(rest.code, 0) << rest.text;
  if (before < 7) {
    EXPECT_NE(rest.text.find(std::to_string(7 - before) + " points computed, " + std::to_string(before) +
                             " were there"),
              std::string::npos)
        << rest.text;
  }
  ASSERT_EQ(run(command("whole.md.h5")).code, 0);
  expect_same_points(read_store(store), read_store(path("whole.md.h5")));
}

TEST_F(WhippleMd, ExitCodesTellWhatHappened) {
  // The user's input: every rank ends with code 2, one of them speaks.
  write("plan.toml", "element = \"Cu\"\npotential = \"nothing\"\n");
  const Outcome unknown = run(mpirun(2, command("x.md.h5")));
  EXPECT_EQ(unknown.code, 2) << unknown.text;
  EXPECT_NE(unknown.text.find("there is no potential 'nothing'"), std::string::npos) << unknown.text;
  EXPECT_EQ(unknown.text.find("there is no potential"), unknown.text.rfind("there is no potential"));
  EXPECT_EQ(run(whipple::tests::program("whipple-md") + " /does/not/exist.toml").code, 2);
  EXPECT_EQ(run(whipple::tests::program("whipple-md") + " --no-such-option").code, 2);

  write("plan.toml",
        "element = \"Cu\"\npotential = \"Cu_mishin1.eam.alloy\"\n[[isotherm]]\nvolume_ratio = [0.65]\n");
  const Outcome range = run(command("x.md.h5"));
  EXPECT_EQ(range.code, 2);
  EXPECT_NE(range.text.find("density table ends at V/V0 = 0.719"), std::string::npos) << range.text;
  EXPECT_FALSE(std::filesystem::exists(path("x.md.h5")));

  write("plan.toml", plan_text);
  const Outcome unwritable =
      run(whipple::tests::program("whipple-md") + " " + path("plan.toml") + " -o /proc/whipple/x.md.h5");
  EXPECT_EQ(unwritable.code, 2);
  EXPECT_EQ(unwritable.text.find("lattice"), std::string::npos) << unwritable.text;

  // The physics: one point fails, the others are there, a second call leaves it alone and still says so.
  write(
      "plan.toml",
      "element = \"Cu\"\npotential = \"copper_universal_3\"\n[[isotherm]]\nvolume_ratio = [1.0]\ncells = 3\n"
      "temperature = \"5000 K\"\nequilibration_steps = 200\nsteps = 200\ntime_step = \"80 fs\"\n");
  const Outcome failed = run(mpirun(2, command("failed.md.h5")));
  EXPECT_EQ(failed.code, 3) << failed.text;
  EXPECT_NE(failed.text.find("FAILED: LAMMPS: "), std::string::npos) << failed.text;
  EXPECT_EQ(read_store(path("failed.md.h5")).size(), 2U);
  const Outcome again = run(command("failed.md.h5"));
  EXPECT_EQ(again.code, 3);
  EXPECT_NE(again.text.find("--retry-failed"), std::string::npos) << again.text;
  const Outcome retried = run(command("failed.md.h5") + " --retry-failed");
  EXPECT_NE(retried.text.find("FAILED: LAMMPS: "), std::string::npos) << retried.text;

  const Outcome quiet = run(command("failed.md.h5") + " --quiet --retry-failed");
  EXPECT_EQ(quiet.text.find("points, potential"), std::string::npos) << quiet.text;
  EXPECT_NE(run(whipple::tests::program("whipple-md") + " --describe").text.find("[hugoniot]"),
            std::string::npos);
}

// A number of ranks that makes no whole teams is refused before any work.
TEST_F(WhippleMd, RanksMustMakeWholeTeams) {
  write("plan.toml", std::string("ranks_per_point = 2\n") + plan_text);
  const Outcome odd = run(mpirun(3, command("odd.md.h5")));
  EXPECT_EQ(odd.code, 2) << odd.text;
  EXPECT_NE(odd.text.find("ranks_per_point = 2 needs a multiple of 2 ranks, not 3"), std::string::npos)
      << odd.text;
}

// Store and fit do not know when, how often and with how many ranks they were computed.
TEST_F(WhippleMd, StoreIsTheSameByteForByte) {
  ASSERT_EQ(run(command("one.md.h5")).code, 0);
  ASSERT_EQ(run(command("two.md.h5")).code, 0);
  ASSERT_EQ(run(mpirun(2, command("three.md.h5"))).code, 0);
  const std::string bytes = testing::bytes_of(path("one.md.h5"));
  EXPECT_FALSE(bytes.empty());
  EXPECT_EQ(testing::bytes_of(path("two.md.h5")), bytes);
  EXPECT_EQ(testing::bytes_of(path("three.md.h5")), bytes);
}

// SIGKILL for a worker, then for the driver, at random moments: nothing lost, nothing doubled.
TEST_F(WhippleMd, SurvivesKillsOfWorkerAndDriver) { testing::kill_at_random(*this, 2); }

// An instance on two ranks where one rank alone reports an error: the job ends with the message instead of
// hanging.
TEST(ErrorGuard, AbortsWhenOneRankOfSeveralReportsAnError) {
  const Outcome outcome = run("timeout 60 " + mpirun(2, whipple::tests::test_program("md_guard_abort")));
  EXPECT_NE(outcome.code, 0);
  EXPECT_NE(outcome.code, 124) << "the ranks hang";
  EXPECT_NE(outcome.text.find("reported by one of 2 ranks: aborting"), std::string::npos) << outcome.text;
  EXPECT_EQ(outcome.text.find("no error was reported"), std::string::npos);
}

}  // namespace
}  // namespace whipple::md
