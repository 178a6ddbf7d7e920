// SPDX-License-Identifier: BSD-3-Clause
// Points that are continued until they are as exact as wanted: nothing is lost, nothing is computed twice,
// and the stated errors are honest.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "md_fitting/protocols/campaign.hpp"
#include "md_fitting/protocols/refinement.hpp"
#include "src/base/error.hpp"
#include "src/base/hash.hpp"
#include "src/base/log.hpp"
#include "tests/unit/md_mpi_environment.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::md {
namespace {

PointRecord part(double pressure, double error, double correlation = 0.0) {
  PointRecord point;
  point.key = "key";
  point.protocol = "isotherm";
  point.status = "done";
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
