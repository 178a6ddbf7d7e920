// SPDX-License-Identifier: BSD-3-Clause
// Measures of impacts that are not normal, not on the axis, or that leave the domain; walls that are perforated or not.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "src/analysis/cloud.hpp"
#include "src/analysis/outflow.hpp"
#include "src/analysis/wall.hpp"
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
  snapshot.scalars["failed"].push_back(0.0);
}

/// A plate of 30 mm by 20 mm, 2 mm thick, without the material within `radius` of a point, where only `left` of
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

/// Measures what becomes of the plate in a run whose line of flight meets it at its middle, or on mirror planes at
/// x = 0 and y = 0.
struct Struck {
  analysis::Run run;
  Frame frame = free_flight();
  Snapshot whole = plate(Vector3::Zero(), 0.0, 0.0);

  explicit Struck(bool quarter = false) {
    run.cell_size = cell;
    run.lower = Vector3(0, 0, -20e-3);
    run.upper = Vector3(40e-3, 30e-3, 40e-3);
    run.bodies = {{"ball", Vector3(0, 0, 5000), spacing}, {"wall", Vector3::Zero(), spacing}};
    frame.centre = quarter ? Vector3::Zero() : Vector3(15e-3, 10e-3, 0);
    if (quarter) frame.planes = {{0, 0.0}, {1, 0.0}};
  }
  [[nodiscard]] Quantity operator()(const Snapshot& now, const std::string& name) const {
    const Quantities row = Wall(run, whole, frame, 1).measure(now);
    return *std::ranges::find(row, name + ".wall", &Quantity::name);
  }
};

TEST(Wall, ThatBulgesAndStaysWholeIsNotPerforatedHoweverFast) {
  const Struck struck;
  Snapshot now = struck.whole;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Vector3 offset = now.position[i] - struck.frame.centre;
    const double bulge = std::exp(-std::pow(std::hypot(offset.x(), offset.y()) / 5e-3, 2));
    now.position[i].z() += 4e-3 * bulge;
    now.velocity[i].z() = 600.0 * bulge;  // debris is what exceeds 250 m/s
  }
  EXPECT_EQ(struck(now, "perforated").value, 0.0);
  EXPECT_NEAR(struck(now, "least_left").value, 1.0, 0.02);
  EXPECT_NEAR(struck(now, "left_on_axis").value, 1.0, 0.1);
  EXPECT_TRUE(std::isnan(struck(now, "hole_diameter").value));
  EXPECT_EQ(struck(now, "damaged_area").value, 0.0);
  EXPECT_EQ(struck(now, "spall_mass").value, 0.0);
  // The bulge has parted in two layers, each of which is whole; then the front one has a hole.
  for (std::size_t i = 0; i < now.size(); ++i)
    now.position[i].z() += struck.whole.position[i].z() > 1e-3 ? 2e-3 : 0.0;
  EXPECT_EQ(struck(now, "perforated").value, 0.0);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Vector3 offset = struck.whole.position[i] - struck.frame.centre;
    const bool front = struck.whole.position[i].z() < 1e-3 && std::hypot(offset.x(), offset.y()) < 3e-3;
    now.scalars["failed"][i] = front ? 1.0 : 0.0;
  }
  EXPECT_EQ(struck(now, "perforated").value, 0.0);
  EXPECT_NEAR(struck(now, "least_left").value, 0.5, 0.02);
  const double hole = std::numbers::pi * 9e-6;
  EXPECT_GT(struck(now, "damaged_area").value, 10 * hole);  // the layer with the hole closes nothing any more
}

TEST(Wall, MaterialThatHasComeOffBehindIsSpall) {
  const Struck struck;
  Snapshot now = struck.whole;
  double gone = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const Vector3 offset = struck.whole.position[i] - struck.frame.centre;
    if (now.position[i].z() < 1.2e-3 || std::hypot(offset.x(), offset.y()) > 4e-3) continue;
    now.position[i].z() += 5e-3;
    gone += now.mass[i];
  }
  EXPECT_GT(gone, 0.0);
  EXPECT_EQ(struck(now, "perforated").value, 0.0);
  EXPECT_NEAR(struck(now, "spall_mass").value, gone, 1e-3 * gone);
  EXPECT_GT(struck(now, "damaged_area").value, 0.5 * std::numbers::pi * 16e-6);
}

TEST(Wall, IsPerforatedWhereverThePathLeadsThroughIt) {
  const Struck struck, quarter(true);
  EXPECT_EQ(struck(struck.whole, "perforated").value, 0.0);
  EXPECT_NEAR(struck(struck.whole, "least_left").value, 1.0, 1e-12);
  const Snapshot beside = plate({22e-3, 7e-3, 0}, 3e-3, 0.0);
  EXPECT_EQ(struck(beside, "perforated").value, 1.0);
  EXPECT_LT(struck(beside, "least_left").value, 0.02);
  EXPECT_NEAR(struck(plate({22e-3, 7e-3, 0}, 4e-3, 0.5), "least_left").value, 0.5, 0.02);
  EXPECT_EQ(struck(plate({22e-3, 7e-3, 0}, 4e-3, 0.5), "perforated").value, 0.0);
  const Snapshot middle = plate(struck.frame.centre, 4e-3, 0.0);
  EXPECT_NEAR(struck(middle, "hole_diameter").value, 8e-3, 0.3 * cell);
  EXPECT_LT(struck(middle, "left_on_axis").value, 0.1);
  EXPECT_EQ(quarter(quarter.whole, "perforated").value, 0.0);
  EXPECT_NEAR(quarter(quarter.whole, "least_left").value, 1.0, 1e-12);
  const Snapshot corner = plate(Vector3::Zero(), 4e-3, 0.0);
  EXPECT_EQ(quarter(corner, "perforated").value, 1.0);
  EXPECT_NEAR(quarter(corner, "hole_diameter").value, 8e-3, 0.3 * cell);
  // A rim that is worn off is no hole; a crack from rim to rim is.
  EXPECT_EQ(struck(plate(Vector3::Zero(), 0.0, 0.0, 0.6e-3), "perforated").value, 0.0);
  Snapshot halves = struck.whole;
  for (Vector3& position : halves.position) position.x() += position.x() > 12e-3 ? 2.5e-3 : 0.0;
  EXPECT_EQ(struck(halves, "perforated").value, 1.0);
}

TEST(Wall, WhosePlugIsShearedOffIsPerforatedEvenWhereThePlugIsStillInPlace) {
  const Struck struck;
  Snapshot now = struck.whole;
  const auto plug = [&](std::size_t i, double radius) {
    const Vector3 offset = struck.whole.position[i] - struck.frame.centre;
    return std::hypot(offset.x(), offset.y()) < radius;
  };
  for (std::size_t i = 0; i < now.size(); ++i)
    now.scalars["failed"][i] = plug(i, 5e-3) && !plug(i, 3.5e-3) ? 2.0 : 0.0;
  EXPECT_EQ(struck(now, "perforated").value, 1.0);
  EXPECT_LT(struck(now, "left_on_axis").value, 0.1);
  EXPECT_NEAR(struck(now, "hole_diameter").value, 10e-3, 0.5 * cell);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (plug(i, 3.5e-3)) now.position[i].z() += 8e-3;
  }
  EXPECT_EQ(struck(now, "perforated").value, 1.0);
  // The same ring half through the thickness leaves the plug on the wall.
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (struck.whole.position[i].z() < 1e-3) now.scalars["failed"][i] = 0.0;
  }
  now.position = struck.whole.position;
  EXPECT_EQ(struck(now, "perforated").value, 0.0);
}

TEST(Wall, OfAnObliqueFlightIsMeasuredAcrossItsThinDirection) {
  // The flight is 70 degrees from the normal of the plate: its axis is x, along the plate.
  Struck struck;
  struck.frame.axis = 0;
  struck.frame.transverse = {1, 2};
  struck.frame.direction = Vector3(1, 0, std::tan(20 * std::numbers::pi / 180));
  struck.frame.impact_angle = 20 * std::numbers::pi / 180;
  struck.frame.centre = Vector3(0, 10e-3, 0);  // meets the face z = 0 at x = 10 mm
  struck.frame.start = 10e-3;
  EXPECT_EQ(struck(struck.whole, "perforated").value, 0.0);
  const Snapshot open = plate({10e-3, 10e-3, 0}, 4e-3, 0.0);
  EXPECT_EQ(struck(open, "perforated").value, 1.0);
  EXPECT_NEAR(struck(open, "hole_diameter").value, 8e-3, 0.3 * cell);
}

TEST(Wall, SaysWhyItCannotBeDecided) {
  Struck struck;
  Snapshot now = struck.whole;
  now.scalars.erase("failed");
  EXPECT_TRUE(std::isnan(struck(now, "perforated").value));
  EXPECT_EQ(struck(now, "perforated").reason, "the snapshots lack the field failed");
  EXPECT_EQ(struck(now, "hole_diameter").reason, "the snapshots lack the field failed");
  now = struck.whole;
  for (Vector3& position : now.position) position.z() += 37.5e-3;
  EXPECT_EQ(struck(now, "perforated").reason, "the wall has come to the border of the domain");
  Wall perforated(struck.run, struck.whole, struck.frame, 1);
  EXPECT_EQ(perforated.measure(plate(struck.frame.centre, 4e-3, 0.0)).front().value, 1.0);
  Snapshot later = plate(struck.frame.centre, 4e-3, 0.0);
  for (Vector3& position : later.position) position.z() += 37.5e-3;
  EXPECT_EQ(perforated.measure(later).front().value, 1.0);  // it was so before it came to the border
  struck.run.bodies[1].condensed = false;
  EXPECT_EQ(struck(struck.whole, "perforated").reason, "the body is a gas");
  Struck open;
  open.whole = plate(open.frame.centre, 4e-3, 0.0);
  EXPECT_EQ(open(open.whole, "perforated").value, 0.0);  // a hole of the drawing is part of the rim
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
  EXPECT_NEAR(frame.debris_speed(), 0.05 * 1400, 0.01);
}

TEST(Flight, RingsThatExpandFlyAlongTheirAxis) {
  analysis::Run run = oblique();
  run.dimension = grid::Dimension::axisymmetric;
  run.bodies[0].velocity.setZero();
  Snapshot first, last;
  add(first, {0, 1e-3, 0}, Vector3::Zero(), 0);
  add(first, {0, 2e-3, 0}, Vector3::Zero(), 1);
  add(last, {0, 1e-3, 0}, {-200, 500, 0}, 0);
  add(last, {0, 2e-3, 0}, {300, 1500, 0}, 1);
  const Frame frame = find_frame(run, first, {}, &last);
  EXPECT_EQ(frame.impact_angle, 0.0);
  EXPECT_EQ(frame.at_face(50e-3).centre, Vector3(0, 0, 0)) << "rings stay about their axis";
  EXPECT_NEAR(frame.parting_speed, std::hypot(500, 1000), 1e-9);
}

double size_of(const std::string& shape) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "run.toml")
      << "title = \"sizes\"\n[domain]\nlower = [0, 0, 0]\nupper = [\"1 mm\", \"1 mm\", \"1 mm\"]\n"
         "cell_size = \"0.1 mm\"\n[time]\nend = \"1 us\"\n[[body]]\nname = \"ball\"\nmaterial = "
         "\"copper\"\nvelocity = [0, 0, \"-3 km/s\"]\nshape = { "
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
  EXPECT_DOUBLE_EQ(
      size_of("moved = { angle = \"90 degree\", axis = [1, 0, 0], shape = { box = { lower = [0, 0, 0], "
              "upper = [\"9 mm\", \"2 mm\", \"9 mm\"] } } }"),
      2e-3);
  EXPECT_DOUBLE_EQ(size_of("moved = { angle = \"30 degree\", shape = { ogive = { base = [0, 0, 0], "
                           "radius = \"3.5 mm\", nose_length = \"9 mm\" } } }"),
                   7e-3);
  EXPECT_TRUE(std::isnan(size_of("union = [{ sphere = { " + centre + "radius = \"2 mm\" } }]")));
}

TEST(OutflowOfBodies, CountsInTheMeanVelocityOfItsBody) {
  analysis::Run run = oblique();
  run.folder = std::filesystem::path(testing::TempDir()) / "whipple_outflow";
  std::filesystem::create_directories(run.folder);
  std::ofstream(run.folder / "history.csv")
      << "step,time [s],outflow_mass.ball [kg],outflow_momentum_x.ball [kg m/s],outflow_momentum_y.ball [kg "
         "m/s],"
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
  const auto value = [&](const std::string& name) {
    return std::ranges::find(row, name, &Quantity::name)->value;
  };
  EXPECT_DOUBLE_EQ(value("mean_velocity.ball"), 3000.0);  // 2 g at 2 km/s here, 2 g at 4 km/s gone
  EXPECT_DOUBLE_EQ(value("outflow_mass.ball"), 0.002);
}

}  // namespace
}  // namespace whipple::analysis::paths
