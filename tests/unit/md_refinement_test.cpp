// SPDX-License-Identifier: BSD-3-Clause
// Points that are continued until they are as exact as wanted: nothing is lost, nothing is computed twice,
// and the stated errors are honest.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "md_fitting/protocols/campaign.hpp"
#include "md_fitting/protocols/refinement.hpp"
#include "md_fitting/protocols/replicas.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/log.hpp"
#include "tests/unit/md_mpi_environment.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::md {
namespace {

PointRecord part(double pressure, double error, double correlation = 0.0) {
  PointRecord point;
  point.key = "key";
  point.protocol = "isotherm";
  point.status = PointStatus::done;
  point.results = {{"pressure", {pressure, error}},
                   {"specific_internal_energy", {2.0 * pressure, 3.0 * error}},
                   {"error_correlation", {correlation, 0.0}},
                   {"solid", {1.0, 0.0}}};
  point.blocks = {{"pressure", {pressure, pressure}}};
  point.provenance = {{"lammps_commands", "run 1\n"}};
  return point;
}

TEST(Join, IsTheMeanOfAllSegmentsWhateverTheOrder) {
  PointRecord all = join(join(part(1.0, 0.3), part(1.1, 0.3)), part(1.2, 0.3));
  EXPECT_NEAR(all.result("pressure").value, 1.1, 1e-12);
  EXPECT_NEAR(all.result("pressure").error, 0.3 / std::sqrt(3.0), 1e-12);
  EXPECT_EQ(all.segments(), 3);
  EXPECT_EQ(all.origin("lammps_commands"), "run 1\nrun 1\nrun 1\n");
  EXPECT_EQ(all.blocks.at("pressure"), (std::vector<double>{1.0, 1.0, 1.1, 1.1, 1.2, 1.2}));
}

TEST(Join, KeepsTheCorrelationOfEqualPartsAndTheWorseFlag) {
  PointRecord molten = part(1.0, 0.1, 0.6);
  molten.results["solid"].value = 0.0;
  molten.message = "the crystal melted";
  const PointRecord joined = join(part(1.0, 0.1, 0.6), molten);
  EXPECT_NEAR(joined.result("error_correlation").value, 0.6, 1e-12);
  EXPECT_EQ(joined.result("solid").value, 0.0);
  EXPECT_EQ(joined.message, "the crystal melted");
}

// Two runs that disagree by ten standard errors are no measurement with a small error.
TEST(Join, DisagreementWidensTheError) {
  const double agreeing = join(part(1.0, 0.1), part(1.1, 0.1)).result("pressure").error;
  EXPECT_NEAR(agreeing, 0.1 / std::sqrt(2.0), 1e-12);
  const double disagreeing = join(part(1.0, 0.1), part(1.0 + std::sqrt(2.0), 0.1)).result("pressure").error;
  EXPECT_NEAR(disagreeing, 5.0 * agreeing, 1e-12);
}

TEST(Join, RefusesSegmentsOfAnotherPoint) {
  PointRecord other = part(1.0, 0.1);
  other.key = "other";
  EXPECT_THROW(join(part(1.0, 0.1), other), InternalError);
}

// Independent values about 10 with a standard deviation of 2 in each of many points: the mean square of the
// stated errors is the variance of the means, at any number of runs, and also of points that were continued.
TEST(Replicas, ErrorsAreTheScatterOfTheMeans) {
  for (const int replicas : {2, 3, 4, 8}) {
    constexpr int points = 4000;
    double stated = 0.0;
    double scatter = 0.0;
    std::mt19937_64 generator(static_cast<unsigned>(replicas));
    std::normal_distribution<double> run(10.0, 2.0);
    std::vector<double> values(static_cast<std::size_t>(replicas));
    for (int k = 0; k < points; ++k) {
      for (double& value : values) value = run(generator);
      const Estimate mean = replica_mean(values);
      stated += mean.error * mean.error / points;
      scatter += (mean.value - 10.0) * (mean.value - 10.0) / points;
    }
    EXPECT_NEAR(stated, 4.0 / replicas, 0.3 / replicas) << replicas;
    EXPECT_NEAR(scatter, 4.0 / replicas, 0.3 / replicas) << replicas;
  }
  EXPECT_THROW(replica_mean(std::vector<double>{1.0}), InternalError);
}

// What one run alone would bring does not depend on how many others there are, or on their failures.
TEST(Replicas, RunsThatFailAreNamedAndLeftOut) {
  std::vector<std::int64_t> seeds;
  const auto with_failures = [&](std::int64_t wanted, const std::set<std::size_t>& failing) {
    seeds.clear();
    return run_replicas<LiquidVapourPoint>(
        wanted, 5, [&](std::int64_t seed, std::string& transcript) -> LiquidVapourPoint {
          seeds.push_back(seed);
          transcript += "run\n";
          if (failing.contains(seeds.size())) {
            if (seeds.size() % 2 == 0) throw LammpsError("LAMMPS: Lost atoms");
            throw StateError("the melt froze");
          }
          return {.vapour_pressure = {static_cast<double>(seeds.size()), 0.0}};
        });
  };
  const ReplicaSet<LiquidVapourPoint> all = with_failures(4, {});
  EXPECT_EQ(all.values(&LiquidVapourPoint::vapour_pressure), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(all.remark, "");
  EXPECT_EQ(all.transcript, "run\nrun\nrun\nrun\n");
  EXPECT_EQ(std::set(seeds.begin(), seeds.end()).size(), 4U);
  const std::vector<std::int64_t> undisturbed = seeds;

  const ReplicaSet<LiquidVapourPoint> rest = with_failures(4, {2});
  EXPECT_EQ(seeds, undisturbed);
  EXPECT_EQ(rest.remark, "1 of 4 runs left out: run 2: LAMMPS: Lost atoms");
  const TaskResult result = to_result<LiquidVapourPoint>(rest);
  EXPECT_EQ(result.message, rest.remark);
  EXPECT_EQ(result.blocks.at("vapour_pressure"), (std::vector<double>{1, 3, 4}));
  EXPECT_NEAR(result.results.at("vapour_pressure").value, 8.0 / 3.0, 1e-12);

  // More than half must be left, and two at least; it ends as soon as that cannot be.
  const auto message = [&](std::int64_t wanted, const std::set<std::size_t>& failing) -> std::string {
    try {
      with_failures(wanted, failing);
    } catch (const StateError& error) {
      return error.what();
    }
    return "no StateError";
  };
  EXPECT_EQ(message(4, {1, 2}),
            "2 of 4 runs failed, at least 3 are needed: run 1: the melt froze; run 2: LAMMPS: Lost atoms");
  EXPECT_EQ(seeds.size(), 2U);
  EXPECT_EQ(message(2, {1}), "1 of 2 runs failed, at least 2 are needed: run 1: the melt froze");
  EXPECT_EQ(message(5, {1, 4}), "no StateError");
}

// Segments of replicas become one larger set, weighted by the runs that each brought.
TEST(Join, OfReplicasIsTheMeanOfAllRuns) {
  const auto point = [](const std::vector<double>& runs) {
    PointRecord made;
    made.key = "key";
    made.protocol = "coexistence";
    made.status = PointStatus::done;
    made.results = {{"melting_temperature", replica_mean(runs)}};
    made.blocks = {{"melting_temperature", runs}};
    made.provenance = {{"replicas", "3"}};
    return made;
  };
  const PointRecord joined = join(point({1300.0, 1310.0, 1320.0}), point({1340.0, 1350.0}));
  const std::vector<double> all = {1300.0, 1310.0, 1320.0, 1340.0, 1350.0};
  EXPECT_EQ(joined.blocks.at("melting_temperature"), all);
  EXPECT_NEAR(joined.result("melting_temperature").value, 1324.0, 1e-9);
  EXPECT_NEAR(joined.result("melting_temperature").error, replica_mean(all).error, 1e-12);
  EXPECT_EQ(joined.segments(), 2);
}

// Sets of four replicas until the target is met: the errors of the means are then as small as was asked for,
// though the sets that happen to agree end first.
TEST(WantsMore, TargetIsMetByTheTrueErrorOfReplicas) {
  constexpr int points = 2000;
  for (const double target : {0.7, 0.35, 0.15}) {  // of runs that scatter by 1
    double scatter = 0.0;
    for (unsigned k = 0; k < points; ++k) {
      std::mt19937_64 generator(k);
      std::normal_distribution<double> run(10.0, 1.0);
      const auto segment = [&] {
        PointRecord point = part(0.0, 0.0);
        point.provenance["replicas"] = "4";
        point.blocks = {{"pressure", {run(generator), run(generator), run(generator), run(generator)}}};
        point.results = {{"pressure", replica_mean(point.blocks["pressure"])}};
        return point;
      };
      PointRecord point = segment();
      while (wants_more(point, {"pressure", target, false, 50})) point = join(point, segment());
      scatter += std::pow(point.result("pressure").value - 10.0, 2) / points;
    }
    EXPECT_LT(std::sqrt(scatter), 1.05 * target) << target;
  }
}

class Continued : public ::testing::Test {
 protected:
  void SetUp() override { log::set_level(log::Level::quiet); }
  /// A point whose segments scatter about 10 with the error that they state.
  Task task(double target, std::int64_t segments) {
    Task made;
    made.key = sha256("continued");
    made.protocol = "isotherm";
    made.conditions = {{"temperature", 300.0}};
    made.precision = {"pressure", target, false, segments};
    const auto segment = [this](int number) {
      computed.push_back(number);
      if (number == failing) throw LammpsError("LAMMPS: Lost atoms");
      std::mt19937 generator(static_cast<unsigned>(number));
      return TaskResult{
          {{"pressure", {10.0 + std::normal_distribution<double>(0.0, 1.0)(generator), 1.0}}}, "", "run\n"};
    };
    made.compute = [segment](const PointRecord*) { return segment(0); };
    made.extend = [segment](const PointRecord*, int number) { return segment(number); };
    return made;
  }
  CampaignSummary run(double target, std::int64_t segments) {
    const std::vector<Task> tasks = {task(target, segments)};
    return run_campaign(tasks, store, MPI_COMM_WORLD, false);
  }
  PointRecord point() { return read_store(store).at(0); }

  TemporaryFolder folder;
  std::filesystem::path store = folder.path() / "points.md.h5";
  std::vector<int> computed;
  int failing = -1;
};

TEST_F(Continued, UntilTheTargetIsMet) {
  run(0.34, 100);
  EXPECT_LE(point().result("pressure").error, 0.34);
  EXPECT_GE(point().segments(), 9);  // 1/sqrt(9) is the first below
  EXPECT_NEAR(point().result("pressure").value, 10.0, 3.0 * point().result("pressure").error);
}

// A later call with a sharper target continues with the next segment; what is there stays, the key too.
TEST_F(Continued, ByALaterCallWithoutRepeatingAnything) {
  EXPECT_EQ(run(0.0, 1).computed, 1);
  const double first = point().result("pressure").value;
  EXPECT_EQ(run(0.0, 1).present, 1);
  EXPECT_EQ(run(0.75, 100).computed, 1);
  const int after_second = point().segments();
  EXPECT_GT(after_second, 1);
  run(0.4, 100);
  std::vector<int> once(static_cast<std::size_t>(point().segments()));
  for (std::size_t i = 0; i < once.size(); ++i) once[i] = static_cast<int>(i);
  EXPECT_EQ(computed, once);
  EXPECT_EQ(run(0.4, 100).present, 1);
  // The same numbers as in one call, to the last bit.
  const PointRecord in_steps = point();
  store = folder.path() / "at_once.md.h5";
  run(0.4, 100);
  EXPECT_EQ(point().result("pressure").value, in_steps.result("pressure").value);
  EXPECT_EQ(point().result("pressure").error, in_steps.result("pressure").error);
  EXPECT_NE(point().result("pressure").value, first);
  EXPECT_EQ(read_store(store).size(), 1U);
}

TEST_F(Continued, EndsAtTheBudget) {
  run(1e-6, 4);
  EXPECT_EQ(point().segments(), 4);
  EXPECT_EQ(run(1e-6, 4).present, 1);
  EXPECT_EQ(computed.size(), 4U);
  EXPECT_EQ(run(1e-6, 5).computed, 1);
  EXPECT_EQ(point().segments(), 5);
}

TEST_F(Continued, FailureOfASegmentKeepsThePoint) {
  failing = 2;
  run(1e-6, 5);
  EXPECT_EQ(point().segments(), 2);
  EXPECT_TRUE(point().done());
  failing = -1;
  run(1e-6, 5);
  EXPECT_EQ(point().segments(), 5);
}

}  // namespace
}  // namespace whipple::md
