// SPDX-License-Identifier: BSD-3-Clause
// Measures of impacts that are not normal, not on the axis, or that leave the domain.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "src/analysis/cloud.hpp"
#include "src/analysis/columns.hpp"
#include "src/analysis/outflow.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::analysis::paths {
namespace {

constexpr double density = 2700.0, spacing = 0.5e-3, cell = 1e-3;

void add(Snapshot& snapshot, const Vector3& position, const Vector3& velocity, std::uint16_t body) {
  snapshot.id.push_back(snapshot.id.size());
  snapshot.position.push_back(position);
  snapshot.velocity.push_back(velocity);
  snapshot.mass.push_back(density * spacing * spacing * spacing);
  snapshot.body.push_back(body);
  snapshot.scalars["density"].push_back(density);
}

/// A plate of 30 mm by 20 mm, 2 mm thick, without the matter within `radius` of a point, where only `left` of
/// the thickness stays.
Snapshot plate(const Vector3& centre, double radius, double left, double lower_x = 0.0) {
  Snapshot snapshot;
  for (double x = lower_x + 0.5 * spacing; x < 30e-3; x += spacing) {
    for (double y = 0.5 * spacing; y < 20e-3; y += spacing) {
      for (double z = 0.5 * spacing; z < 2e-3; z += spacing) {
        if (std::hypot(x - centre.x(), y - centre.y()) < radius && z > left * 2e-3) continue;
        add(snapshot, {x, y, z}, Vector3::Zero(), 1);
      }
    }
  }
  return snapshot;
}

Frame free_flight() {
  Frame frame;
  frame.impact_speed = 5000.0;
  return frame;
}

TEST(Columns, FindAHoleWhereverItIs) {
  const Snapshot whole = plate(Vector3::Zero(), 0.0, 0.0);
  const Columns columns(whole, free_flight(), 1, 2.0 * cell);
  EXPECT_NEAR(columns.least_left(whole), 1.0, 1e-12);
  EXPECT_LT(columns.least_left(plate({22e-3, 7e-3, 0}, 3e-3, 0.0)), 0.02);
  EXPECT_NEAR(columns.least_left(plate({22e-3, 7e-3, 0}, 4e-3, 0.5)), 0.5, 0.02);
}

TEST(Columns, AreWholeAtAMirrorPlane) {
  Frame frame = free_flight();
  frame.planes = {{0, 0.0}, {1, 0.0}};
  const Snapshot whole = plate(Vector3::Zero(), 0.0, 0.0);
  const Columns columns(whole, frame, 1, 2.0 * cell);
  EXPECT_NEAR(columns.least_left(whole), 1.0, 1e-12);
  EXPECT_LT(columns.least_left(plate(Vector3::Zero(), 4e-3, 0.0)), 0.02);
}

TEST(Columns, LeaveOutWhatFliesAndTheRim) {
  Snapshot part = plate({22e-3, 7e-3, 0}, 3e-3, 0.0);
  const Columns columns(plate(Vector3::Zero(), 0.0, 0.0), free_flight(), 1, 2.0 * cell);
  add(part, {22e-3, 7e-3, 1e-3}, {0, 0, 3000}, 1);
  EXPECT_LT(columns.least_left(part), 0.02);
  EXPECT_NEAR(columns.least_left(plate(Vector3::Zero(), 0.0, 0.0, 0.6e-3)), 1.0, 0.05);  // a rim worn off
}

analysis::Run oblique() {
  analysis::Run run;
  run.bodies = {{"ball", Vector3(2500, 0, 4330), spacing}, {"wall", Vector3::Zero(), spacing}};
  return run;
}

TEST(Flight, AnObliqueImpactHasItsWholeSpeedAndMeetsThePlateBesideTheStart) {
  Snapshot first;
  add(first, {1e-3, 0, -4e-3}, {2500, 0, 4330}, 0);
  const Frame frame = find_frame(oblique(), first);
  EXPECT_EQ(frame.axis, 2);
  EXPECT_NEAR(frame.impact_speed, 4999.89, 0.01);
  EXPECT_NEAR(frame.impact_angle, std::atan2(2500, 4330), 1e-12);
  EXPECT_NEAR(frame.at_face(10e-3).centre.x(), 1e-3 + 14e-3 * 2500 / 4330, 1e-12);
  const Frame turned = find_frame(oblique(), first, 0);
  EXPECT_EQ(turned.axis, 0);
}

TEST(Flight, WhereNothingMovesAtFirstTheAxisIsThatOfTheParting) {
  analysis::Run run = oblique();
  run.bodies[0].velocity.setZero();
  Snapshot first, last;
  add(first, Vector3::Zero(), Vector3::Zero(), 0);
  add(first, Vector3::Zero(), Vector3::Zero(), 1);
  add(last, Vector3::Zero(), {0, -300, 10}, 0);
  add(last, Vector3::Zero(), {0, 1100, 0}, 1);
  const Frame frame = find_frame(run, first, {}, &last);
  EXPECT_EQ(frame.axis, 1);
  EXPECT_EQ(frame.projectile, 1U);
  EXPECT_EQ(frame.sign, 1.0);
  EXPECT_EQ(frame.impact_speed, 0.0);
}

double size_of(const std::string& shape) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "run.toml")
      << "title = \"sizes\"\n[domain]\nlower = [0, 0, 0]\nupper = [\"1 mm\", \"1 mm\", \"1 mm\"]\n"
         "cell_size = \"0.1 mm\"\n[[body]]\nname = \"ball\"\nvelocity = [0, 0, \"-3 km/s\"]\nshape = { "
      << shape << " }\n";
  return read_run(folder.path()).bodies.at(0).size;
}

TEST(Run, TheSizeOfABodyIsTheSmallestExtentOfItsShape) {
  const std::string centre = "center = [0, 0, 0], ";
  EXPECT_DOUBLE_EQ(size_of("sphere = { " + centre + "radius = \"2 mm\" }"), 4e-3);
  EXPECT_DOUBLE_EQ(size_of("cylinder = { " + centre + "radius = \"2 mm\", height = \"1 mm\" }"), 1e-3);
  EXPECT_DOUBLE_EQ(size_of("cylinder = { " + centre + "radius = \"2 mm\", height = \"1 cm\" }"), 4e-3);
  // Thickness along the velocity, not the width of the column.
  EXPECT_DOUBLE_EQ(size_of("box = { lower = [0, 0, \"-3 mm\"], upper = [\"1 um\", \"1 um\", 0] }"), 3e-3);
  EXPECT_DOUBLE_EQ(size_of("moved = { angle = \"30 degree\", shape = { ogive = { " + centre +
                           "radius = \"3.5 mm\", nose_length = \"9 mm\" } } }"),
                   7e-3);
  EXPECT_TRUE(std::isnan(size_of("union = [{ sphere = { " + centre + "radius = \"2 mm\" } }]")));
}

TEST(OutflowOfBodies, CountsInTheMeanVelocityOfItsBody) {
  analysis::Run run = oblique();
  run.folder = std::filesystem::path(testing::TempDir()) / "whipple_outflow";
  std::filesystem::create_directories(run.folder);
  std::ofstream(run.folder / "history.csv")
      << "step,time [s],outflow_mass.ball [kg],outflow_momentum_x.ball [kg m/s],outflow_momentum_y.ball [kg m/s],"
         "outflow_momentum_z.ball [kg m/s],outflow_mass.wall [kg],outflow_momentum_x.wall [kg m/s],"
         "outflow_momentum_y.wall [kg m/s],outflow_momentum_z.wall [kg m/s]\n"
         "0,0,0,0,0,0,0,0,0,0\n5,1e-6,0.002,0,0,8,0,0,0,0\n6,2e-6,0.002,0,0,8,0.001,0,0,-1\n";
  const OutflowHistory outflow(run);
  EXPECT_EQ(outflow.at(0, 0.5e-6).mass, 0.0);
  EXPECT_EQ(outflow.at(0, 1.5e-6).mass, 0.002);
  EXPECT_EQ(outflow.at(1, 2e-6).momentum.z(), -1.0);
  Snapshot snapshot;
  add(snapshot, Vector3::Zero(), {0, 0, 2000}, 0);
  snapshot.mass[0] = 0.002;
  const Quantities row = body_measures(snapshot, free_flight(), 0, run.bodies[0], outflow.at(0, 2e-6));
  const auto value = [&](const std::string& name) { return std::ranges::find(row, name, &Quantity::name)->value; };
  EXPECT_DOUBLE_EQ(value("mean_velocity.ball"), 3000.0);  // 2 g at 2 km/s here, 2 g at 4 km/s gone
  EXPECT_DOUBLE_EQ(value("outflow_mass.ball"), 0.002);
}

}  // namespace
}  // namespace whipple::analysis::paths
