// SPDX-License-Identifier: BSD-3-Clause
// The campaign: nothing is computed twice, a failure stays alone, what depends on a failure waits.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <vector>

#include "md_fitting/protocols/campaign.hpp"
#include "md_fitting/protocols/coexistence.hpp"
#include "md_fitting/protocols/point_text.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/log.hpp"
#include "tests/unit/md_mpi_environment.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::md {
namespace {

class Campaign : public ::testing::Test {
 protected:
  void SetUp() override { log::set_level(log::Level::quiet); }

  Task task(const std::string& name, const std::string& dependency = {}) {
    Task made;
    made.key = sha256(name);
    made.protocol = "isotherm";
    made.conditions = {{"temperature", static_cast<double>(name.size())}};
    made.provenance = {{"name", name}};
    if (!dependency.empty()) made.dependency = sha256(dependency);
    made.compute = [this, name](const PointRecord* needed) {
      ++calls[name];
      if (failing == name) throw LammpsError("LAMMPS: Lost atoms: original 256 current 255");
      double value = 1.0;
      if (needed != nullptr) value += needed->result("pressure").value;
      return TaskResult{{{"pressure", {value, 0.25}}}, "", "units metal\n"};
    };
    return made;
  }
  CampaignSummary run(const std::vector<Task>& tasks, bool retry = false) {
    return run_campaign(tasks, store, MPI_COMM_WORLD, retry);
  }

  TemporaryFolder folder;
  std::filesystem::path store = folder.path() / "points.md.h5";
  std::map<std::string, int> calls;
  std::string failing;
};

TEST_F(Campaign, SecondCallComputesNothing) {
  const std::vector<Task> tasks = {task("a"), task("bb"), task("ccc", "a")};
  EXPECT_EQ(run(tasks).computed, 3);
  const CampaignSummary again = run(tasks);
  EXPECT_EQ(again.computed, 0);
  EXPECT_EQ(again.present, 3);
  EXPECT_EQ(calls["a"], 1);
  // The point that depends on another was given its numbers.
  EXPECT_EQ(read_store(store).at(2).result("pressure").value, 2.0);
  EXPECT_EQ(read_store(store).at(0).origin("lammps_commands"), "units metal\n");
}

TEST_F(Campaign, CountsSolidsThatMelted) {
  const auto state = [&](const std::string& name, const std::string& protocol, double solid) {
    Task made = task(name);
    made.protocol = protocol;
    made.compute = [solid](const PointRecord*) {
      return TaskResult{{{"pressure", {1.0, 0.25}}, {"solid", {solid, 0.0}}}, "", "units metal\n"};
    };
    return made;
  };
  const std::vector<Task> tasks = {state("a", "isochore", 0.0), state("bb", "isotherm", 0.0),
                                   state("ccc", "isochore", 1.0), state("dddd", "hugoniot", 0.0)};
  EXPECT_EQ(run(tasks).molten, 2);
  EXPECT_EQ(run(tasks).molten, 2);  // found in the store
}

/// The greatest size of a file that this process may write, while the object lives no more than `bytes`.
class FileSizeLimit {
 public:
  FileSizeLimit() { getrlimit(RLIMIT_FSIZE, &former_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &former_); }
  void set(std::uintmax_t bytes) const {
    const rlimit limit{static_cast<rlim_t>(bytes), former_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }

 private:
  rlimit former_{};
};

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A disk that is full, simulated by the greatest size of a file, while the store is copied or while the point
// is written: named, the summary carries the exit code of an incomplete plan, the points so far are safe, and
// the next call goes on to the store of an undisturbed one.
TEST_F(Campaign, FullDiskIsNamedAndLosesNothing) {
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  std::vector<Task> tasks = {task("a"), task("bb"), task("ccc", "a")};
  EXPECT_EQ(run(tasks).computed, 3);
  const std::string whole = bytes_of(store);
  for (const double room : {0.5, 1.02}) {
    std::filesystem::remove(store);
    const auto compute = tasks[1].compute;
    CampaignSummary stopped;
    ::testing::internal::CaptureStderr();
    {
      const FileSizeLimit limit;
      tasks[1].compute = [&](const PointRecord* needed) {
        limit.set(static_cast<std::uintmax_t>(room * static_cast<double>(std::filesystem::file_size(store))));
        return compute(needed);
      };
      stopped = run(tasks);
    }
    const std::string words = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(stopped.code, static_cast<int>(ExitCode::state));
    EXPECT_EQ(stopped.computed, 1);
    EXPECT_NE(words.find("the work stopped before its end: "), std::string::npos) << words;
    EXPECT_NE(words.find("File too large; the points stored so far are safe"), std::string::npos) << words;
    EXPECT_EQ(read_store(store).size(), 1U);
    tasks[1].compute = compute;
    const CampaignSummary rest = run(tasks);
    EXPECT_EQ(rest.code, 0);
    EXPECT_EQ(rest.computed, 2);
    EXPECT_EQ(bytes_of(store), whole);
  }
  std::signal(SIGXFSZ, former);
}

TEST_F(Campaign, MorePointsAreAdded) {
  run({task("a")});
  const CampaignSummary summary = run({task("a"), task("bb"), task("ccc", "a")});
  EXPECT_EQ(summary.present, 1);
  EXPECT_EQ(summary.computed, 2);
  EXPECT_EQ(calls["a"], 1);
  EXPECT_EQ(read_store(store).size(), 3U);
}

TEST_F(Campaign, FailureIsRecordedAndTheOthersGoOn) {
  failing = "bb";
  const std::vector<Task> tasks = {task("a"), task("bb"), task("ccc"), task("dddd", "bb")};
  const CampaignSummary first = run(tasks);
  EXPECT_EQ(first.computed, 2);
  EXPECT_EQ(first.failed, 1);
  EXPECT_EQ(first.blocked, 1);
  const std::vector<PointRecord> points = read_store(store);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1].status, PointStatus::failed);
  EXPECT_NE(points[1].message.find("Lost atoms"), std::string::npos);
  EXPECT_TRUE(points[1].results.empty());
  EXPECT_NE(summarize(points[1]).find("isotherm at temperature = 2 K FAILED: LAMMPS: Lost atoms"),
            std::string::npos)
      << summarize(points[1]);

  // Left alone until asked for; then only what is missing is computed.
  failing.clear();
  const CampaignSummary second = run(tasks);
  EXPECT_EQ(second.left, 1);
  EXPECT_EQ(second.blocked, 1);
  EXPECT_EQ(calls["bb"], 1);
  const CampaignSummary third = run(tasks, true);
  EXPECT_EQ(third.computed, 2);
  EXPECT_EQ(third.left, 0);
  EXPECT_EQ(calls["a"], 1);
  EXPECT_EQ(calls["bb"], 2);
  EXPECT_EQ(select(read_store(store), "isotherm").size(), 4U);
}

// A chain of dependencies behind a failure ends instead of waiting for points that never come.
TEST_F(Campaign, ChainBehindAFailureIsBlocked) {
  failing = "a";
  const std::vector<Task> tasks = {task("a"), task("bb", "a"), task("ccc", "bb"), task("dddd", "ccc"),
                                   task("other")};
  const CampaignSummary summary = run(tasks);
  EXPECT_EQ(summary.failed, 1);
  EXPECT_EQ(summary.blocked, 3);
  EXPECT_EQ(summary.computed, 1);
  failing.clear();
  EXPECT_EQ(run(tasks, true).computed, 4);
}

TEST_F(Campaign, ResultsThatAreNotFiniteAreFailures) {
  std::vector<Task> tasks = {task("a")};
  tasks[0].compute = [](const PointRecord*) {
    return TaskResult{{{"pressure", {std::nan(""), 0.0}}}, "", ""};
  };
  EXPECT_EQ(run(tasks).failed, 1);
  EXPECT_EQ(read_store(store).at(0).message, "pressure is not finite");
}

TEST_F(Campaign, StoreThatIsSomethingElseIsReportedBeforeWork) {
  store = "/proc/self/status";
  EXPECT_THROW(run({task("a")}), InputError);
  EXPECT_EQ(calls["a"], 0);
}

TEST(FormatResult, UsesUsualUnitsAndTheDigitsOfTheError) {
  EXPECT_EQ(format_result("pressure", {45.3124e9, 0.0111e9}), "pressure = 45.312 +- 0.011 GPa");
  EXPECT_EQ(format_result("shock_velocity", {5418.2, 0.94}), "shock_velocity = 5.41820 +- 0.00094 km/s");
  EXPECT_EQ(format_result("specific_volume", {1.13465e-4, 1.1e-8}),
            "specific_volume = 0.113465 +- 0.000011 cm^3/g");
  EXPECT_EQ(format_result("temperature", {293.0, 0.0}), "temperature = 293 K");
  EXPECT_EQ(format_result("lattice_constant", {3.615e-10, 1e-19}), "lattice_constant = 3.615 angstrom");
}

// The acceptance of a two-phase run: end states that have lost a phase look as steady as coexistence.
TEST(Coexistence, AcceptsOnlyTwoPhasesAtRest) {
  const CoexistenceRun good{{1325.0, 2.0}, {1327.0, 2.0}, 0.50, 0.52, 0.40, 0.60, 0.05, 0.95};
  EXPECT_EQ(refusal(good), "");
  CoexistenceRun run = good;
  run.largest_share = 0.97;
  EXPECT_NE(refusal(run).find("the melt froze"), std::string::npos);
  run = good;
  run.least_share = 0.05;
  EXPECT_NE(refusal(run).find("the crystal melted"), std::string::npos);
  // Frozen as a whole and hot: the share alone looks like two phases.
  run = good;
  run.first_share = run.second_share = 0.76;
  run.largest_share = 0.79;
  run.least_order = 0.60;
  EXPECT_NE(refusal(run).find("the melt froze"), std::string::npos);
  run = good;
  run.largest_order = 0.30;
  EXPECT_NE(refusal(run).find("the crystal melted"), std::string::npos);
  run = good;
  run.second_share = 0.70;
  EXPECT_NE(refusal(run).find("the fraction of crystal drifts"), std::string::npos);
  run = good;
  run.second_half.value = 1340.0;
  EXPECT_NE(refusal(run).find("the temperature drifts"), std::string::npos);
  run.whole = {1332.5, 8.0};  // the slow exchange of the phases explains it
  EXPECT_EQ(refusal(run), "");
}

// Starts between the coldest that melted and the hottest that froze.
TEST(Coexistence, NextStartLiesBetweenThoseThatLostAPhase) {
  StartingTemperature start(1200.0);
  start.froze();
  EXPECT_NEAR(start.next(), 1248.0, 1e-9);
  start.froze();
  EXPECT_NEAR(start.next(), 1297.92, 1e-9);
  start.melted();
  EXPECT_NEAR(start.next(), 0.5 * (1248.0 + 1297.92), 1e-9);
  StartingTemperature hot(1400.0);
  hot.melted();
  EXPECT_NEAR(hot.next(), 1344.0, 1e-9);
  hot.froze();  // by chance of a small cell: the two meet in the middle
  EXPECT_NEAR(hot.next(), 1372.0, 1e-9);
  hot.ended_at(1330.0);
  EXPECT_EQ(hot.next(), 1330.0);
}

// Temperature of crystal and melt at constant enthalpy: fast vibrations (60 % of the variance 2 T^2/(3 N)) on
// slow exchange of the phases. Runs shorter than that motion, as long, and much longer: the means scatter by
// the stated errors, while the error of the series alone is up to 2.4 times too small.
TEST(Coexistence, ErrorHoldsTheSlowExchangeOfThePhases) {
  constexpr double atoms = 1000.0;
  constexpr double melting = 1300.0;
  constexpr double variance = 2.0 * melting * melting / (3.0 * atoms);
  constexpr double slow_time = 200.0;  // of relaxation, in samples
  constexpr double fast_time = 5.0;
  for (const std::size_t length : {200u, 1000u, 4000u, 20000u}) {
    constexpr int runs = 100;
    double stated = 0.0;
    double scatter = 0.0;
    for (unsigned seed = 0; seed < runs; ++seed) {
      std::mt19937_64 generator(seed);
      std::normal_distribution<double> normal;
      const auto step = [&](double x, double share, double time) {
        const double memory = std::exp(-1.0 / time);
        return memory * x + std::sqrt((1.0 - memory * memory) * share * variance) * normal(generator);
      };
      double slow = std::sqrt(0.4 * variance) * normal(generator);
      double fast = 0.0;
      std::vector<double> series(length);
      for (double& sample : series) {
        slow = step(slow, 0.4, slow_time);
        fast = step(fast, 0.6, fast_time);
        sample = melting + slow + fast;
      }
      const SeriesMean mean = series_statistics(series);
      const double error = coexistence_error(mean, atoms);
      EXPECT_GE(error, mean.estimate.error);
      stated += error * error / runs;
      scatter += (mean.estimate.value - melting) * (mean.estimate.value - melting) / runs;
    }
    const double ratio = std::sqrt(scatter / stated);
    EXPECT_GT(ratio, 1.0 / 1.5) << length;
    EXPECT_LT(ratio, 1.5) << length;
  }
}

}  // namespace
}  // namespace whipple::md
