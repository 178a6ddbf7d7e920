// SPDX-License-Identifier: BSD-3-Clause
// Measures of bodies and targets in made-up particle sets whose answers are known exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>

#include "src/analysis/bar.hpp"
#include "src/analysis/cloud.hpp"
#include "src/analysis/columns.hpp"
#include "src/analysis/fragments.hpp"
#include "src/analysis/measures.hpp"
#include "src/analysis/surfaces.hpp"
#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "tests/folders.hpp"
#include "tests/unit/analysis_support.hpp"

namespace whipple::analysis {
namespace {

TEST(Cloud, KnownSpeeds) {
  // Axial speeds uniform over 1 to 3 km/s, a tenth of it outward, from one point: everything is a quantile.
  Maker maker(1e-3);
  const int n = 20001;
  for (int i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / (n - 1), speed = 1000 + 2000 * u;
    const Vector3 v(0.1 * speed * std::cos(7 * u), 0.1 * speed * std::sin(7 * u), speed);
    maker.add(1e-5 * v, v);
  }
  Frame frame;
  frame.impact_speed = 3000;
  const Quantities row = cloud_measures(maker.snapshot, frame, Extent{.lower = -2e-3, .upper = 2e-3});
  EXPECT_NEAR(value(row, "front"), 0.02998, 1e-6);
  EXPECT_NEAR(value(row, "rear"), 0.01002, 1e-6);
  EXPECT_NEAR(value(row, "radius"), 0.002998, 1e-7);
  EXPECT_NEAR(value(row, "radial_speed"), 299.8, 0.01);
  EXPECT_NEAR(value(row, "mean_velocity"), 2000, 1e-6);
  EXPECT_NEAR(value(row, "half_angle"), std::atan(0.1), 1e-9);
  EXPECT_NEAR(value(row, "cloud_length_over_width"), (0.02998 - 0.002) / (2 * 0.002998), 1e-3);
  // Beyond 3 mm lies everything: 10 to 30 mm, uniformly.
  EXPECT_NEAR(value(row, "axial_50"), 0.02, 1e-6);
  EXPECT_NEAR(value(row, "axial_90"), 0.028, 1e-6);
  EXPECT_NEAR(value(row, "radius_99"), 0.00298, 1e-6);
  EXPECT_NEAR(value(row, "mass_behind"), n * density * 1e-9, 1e-9);
}

TEST(Cloud, BodiesPartsAndPhases) {
  Maker maker(1e-3);
  maker.add(Vector3::Zero(), {0, 0, 4000}, 0, 0.0);   // debris
  maker.add(Vector3::Zero(), {0, 0, -2000}, 1, 2.0);  // liquid ejecta
  maker.add(Vector3::Zero(), {0, 0, 0}, 1, 0.0);      // rests
  const std::vector<BodyInput> bodies = {{"disk", {0, 0, 6000}, 1e-3}, {"plate", {0, 0, 0}, 1e-3}};
  const Table table = body_table(maker.snapshot, quarter(), bodies);
  const auto row = [&](const std::string& label) {
    return static_cast<std::size_t>(std::ranges::find(table.labels, label) - table.labels.begin());
  };
  const double m = density * 1e-9;
  EXPECT_EQ(table.rows(), 21U);  // three groups of seven
  EXPECT_DOUBLE_EQ(table["mass"][row("disk whole")], 4 * m);
  EXPECT_DOUBLE_EQ(table["mass"][row("plate ejecta")], 4 * m);
  EXPECT_DOUBLE_EQ(table["axial_momentum"][row("all whole")], 4 * m * 2000);
  EXPECT_DOUBLE_EQ(table["kinetic_energy"][row("plate liquid")], 4 * 0.5 * m * 4e6);
  EXPECT_DOUBLE_EQ(table["liquid_fraction"][row("plate whole")], 0.5);
  EXPECT_DOUBLE_EQ(table["mass"][row("disk ejecta")], 0.0);
}

TEST(Surfaces, CraterOfAParaboloid) {
  // Block of 30 mm with a crater z = depth (1 - r^2 / R^2), a lip above the surface and fragmented material inside.
  constexpr double depth = 13.1e-3, radius = 12.4e-3, cell = 1e-3;
  Maker maker(0.5 * cell);
  maker.fill(
      {0, 0, -3e-3}, {30e-3, 30e-3, 30e-3},
      [&](const Vector3& p) {
        const double r = std::hypot(p.x(), p.y());
        const bool lip = p.z() < 0 && r > radius && r < radius + 3e-3;
        return lip || (p.z() > 0 && p.z() > depth * (1 - r * r / (radius * radius)));
      },
      Vector3::Zero(), 1);
  for (int i = 0; i < 50; ++i) maker.add({1e-4 * i, 1e-4 * i, 2e-3 + 1e-4 * i}, {0, 0, -500}, 0);
  // The remains of the projectile line the crater, two cells thick.
  maker.fill(
      {0, 0, 0}, {30e-3, 30e-3, 30e-3},
      [&](const Vector3& p) {
        const double floor = depth * (1 - (p.x() * p.x() + p.y() * p.y()) / (radius * radius));
        return p.z() < floor && p.z() > floor - 2 * cell;
      },
      Vector3::Zero(), 0);
  const Crater crater = measure_crater(maker.snapshot, quarter(), 1, 0.0, 30e-3, cell);
  EXPECT_NEAR(crater.depth, depth, 0.25 * cell);
  EXPECT_NEAR(crater.radius, radius, 0.25 * cell);
  // They have come down to the floor on the axis.
  EXPECT_NEAR(penetration_depth(maker.snapshot, quarter(), 0, 0.5 * cell, 0.0), depth, 0.6 * cell);
  EXPECT_EQ(penetration_depth(maker.snapshot, quarter(), 0, 0.5 * cell, 20e-3), 0.0);
  EXPECT_TRUE(std::isnan(penetration_depth(maker.snapshot, quarter(), 2, 0.5 * cell, 0.0)));
}

// A dished plate of the same thickness has a bulge and no crater; with material missing it has both.
TEST(Surfaces, ABulgeIsNoCrater) {
  constexpr double cell = 0.25e-3, thickness = 2e-3, sag = 1.7e-3;
  for (const double missing : {0.0, 1e-3}) {
    Maker maker(0.5 * cell);
    maker.fill(
        {0, 0, 0}, {10e-3, 10e-3, 6e-3},
        [&](const Vector3& p) {
          const double r = std::hypot(p.x(), p.y()),
                       dish = (missing > 0.0 ? 0.2 : 1.0) * sag * std::exp(-r * r / 16e-6);
          const double floor = dish + (r < 2e-3 ? missing : 0.0);
          return p.z() > floor && p.z() < thickness + dish;
        },
        Vector3::Zero());
    const Crater crater = measure_crater(maker.snapshot, quarter(), 0, 0.0, thickness, cell);
    EXPECT_EQ(crater.is_bulge, missing == 0.0) << crater.depth << " " << crater.bulge;
    EXPECT_NEAR(crater.bulge, (missing > 0.0 ? 0.2 : 1.0) * sag, 0.5 * cell);
    if (missing > 0.0) {
      EXPECT_NEAR(crater.depth, missing + 0.2 * sag, 0.5 * cell);
    }
  }
}

TEST(Surfaces, NoCraterBeforeTheImpact) {
  Maker maker(0.5e-3);
  maker.fill({0, 0, 0}, {20e-3, 20e-3, 20e-3}, [](const Vector3&) { return true; }, Vector3::Zero());
  const Crater crater = measure_crater(maker.snapshot, quarter(), 0, 0.0, 20e-3, 1e-3);
  EXPECT_EQ(crater.depth, 0.0);
  EXPECT_EQ(crater.radius, 0.0);
  EXPECT_NEAR(crater.bulge, 0.0, 0.05e-3);
  EXPECT_FALSE(crater.is_bulge);
}

TEST(Surfaces, HoleInAPlateThinnerThanTheCell) {
  constexpr double hole_radius = 8.3e-3, cell = 1e-3, thickness = 0.5e-3;
  Maker maker(0.25e-3);
  maker.fill(
      {0, 0, 0}, {25e-3, 25e-3, thickness},
      [&](const Vector3& p) { return std::hypot(p.x(), p.y()) > hole_radius; }, Vector3::Zero(), 1);
  maker.fill(
      {0, 0, 40e-3}, {4e-3, 4e-3, 44e-3}, [](const Vector3&) { return true; }, {0, 0, 3000}, 1);  // plug
  std::vector<std::uint8_t> plate(maker.snapshot.size());
  for (std::size_t i = 0; i < plate.size(); ++i) plate[i] = maker.snapshot.position[i].z() < 1e-3 ? 1 : 0;
  const Hole hole = measure_hole(maker.snapshot, quarter(), plate, thickness, cell);
  EXPECT_NEAR(hole.diameter, 2 * hole_radius, 0.3 * cell);
  EXPECT_LT(hole.left_on_axis, 0.1);
  Maker whole(0.25e-3);
  whole.fill({0, 0, 0}, {25e-3, 25e-3, thickness}, [](const Vector3&) { return true; }, Vector3::Zero(), 1);
  const std::vector<std::uint8_t> everything(whole.snapshot.size(), 1);
  const Hole none = measure_hole(whole.snapshot, quarter(), everything, thickness, cell);
  EXPECT_EQ(none.diameter, 0.0);
  EXPECT_NEAR(none.left_on_axis, 1.0, 0.1);
}

// Rings of a section: masses and volumes are those of whole rings, so nothing is multiplied.
TEST(Surfaces, HoleInASectionOfRings) {
  constexpr double hole_radius = 8.3e-3, cell = 1e-3, thickness = 2e-3, spacing = 0.25e-3, density = 2700.0;
  Frame frame;
  frame.dimension = grid::Dimension::axisymmetric;
  frame.axis = 0;
  frame.transverse = {1, 2};
  Snapshot rings;
  double volume = 0.0;
  for (double x = 0.5 * spacing; x < thickness; x += spacing) {
    for (double r = hole_radius + 0.5 * spacing; r < 25e-3; r += spacing) {
      rings.position.emplace_back(x, r, 0.0);
      rings.velocity.emplace_back(0.0, 0.0, 0.0);
      rings.mass.push_back(density * 2.0 * std::numbers::pi * r * spacing * spacing);
      rings.body.push_back(0);
      rings.id.push_back(rings.id.size());
      rings.scalars["density"].push_back(density);
      volume += rings.mass.back() / density;
    }
  }
  const std::vector<std::uint8_t> all(rings.size(), 1);
  const Hole hole = measure_hole(rings, frame, all, thickness, cell);
  EXPECT_NEAR(hole.diameter, 2 * hole_radius, 0.3 * cell);
  EXPECT_EQ(hole.left_on_axis, 0.0);
  EXPECT_NEAR(volume, frame.ring_area(hole_radius, 25.05e-3) * thickness, 1e-9 * volume);
  EXPECT_NEAR(frame.edge(rings.mass[7] / density, rings.position[7]), spacing, 1e-9);
  const Columns columns(rings, frame, 0, 2.0 * cell);
  EXPECT_TRUE(columns.any());
  EXPECT_NEAR(columns.least_left(rings, all, Vector3::Zero()), 1.0, 1e-12);
}

/// Measures of a bar of 20 mm that flies down to the wall z = 0, in cells of 0.5 mm.
/// @param radius_at  m, at a height
template <class Radius>
Quantities measures_of_bar(Radius&& radius_at) {
  constexpr double cell = 0.5e-3;
  Maker maker(0.5 * cell);
  maker.fill({0, 0, 0}, {8e-3, 8e-3, 20e-3},
             [&](const Vector3& p) { return std::hypot(p.x(), p.y()) < radius_at(p.z()); }, {0, 0, -200});
  Frame frame = quarter(200);
  frame.sign = -1.0;
  frame.wall = 0.0;
  return bar_measures(maker.snapshot, frame, 0, {"bar", {0, 0, -200}, 0.5 * cell}, cell, 5e-3, true);
}

TEST(Bar, LengthAndDiametersOfAConeOnACylinder) {
  // Against the wall z = 0, flying down: foot of 12 mm at the wall that narrows by 0.4 mm per mm to 8 mm.
  const Quantities row = measures_of_bar([](double z) { return std::max(4e-3, 6e-3 - 0.2 * z); });
  EXPECT_NEAR(value(row, "length.bar"), 20e-3, 1e-9);
  EXPECT_NEAR(value(row, "foot_diameter.bar"), 12e-3, 0.06e-3);
  EXPECT_NEAR(value(row, "diameter_at.bar"), 10e-3, 0.06e-3);
  EXPECT_DOUBLE_EQ(value(row, "foot_temperature.bar"), 300.0);
}

TEST(Bar, ARimThatCurlsOffTheWallIsItsLargestDiameterAndNoContact) {
  const Quantities row = measures_of_bar([](double z) { return z > 1e-3 && z < 1.5e-3 ? 6e-3 : 4e-3; });
  EXPECT_NEAR(value(row, "contact_diameter.bar"), 8e-3, 0.06e-3);
  EXPECT_NEAR(value(row, "largest_diameter.bar"), 12e-3, 0.2e-3);
}

TEST(Bar, AFootThatStandsBeforeTheWallIsAsWideAndTheBarAsLong) {
  constexpr double cell = 0.5e-3;
  for (const double gap : {0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95, 1.3, 4.0}) {
    Maker maker(0.25 * cell);
    maker.fill({0, 0, 0}, {8e-3, 8e-3, 20e-3},
               [](const Vector3& p) { return std::hypot(p.x(), p.y()) < 5e-3; }, {0, 0, -200});
    for (Vector3& position : maker.snapshot.position) position.z() += gap * cell;
    maker.add({0.1e-3, 0.1e-3, 0.1 * cell}, {0, 0, 0});  // left at the wall
    Frame frame = quarter(200);
    frame.sign = -1.0;
    frame.wall = 0.0;
    const Quantities row =
        bar_measures(maker.snapshot, frame, 0, {"bar", {0, 0, -200}, 0.25 * cell}, cell, 0.0, false);
    EXPECT_NEAR(value(row, "foot_diameter.bar"), 10e-3, 0.05e-3) << gap;
    EXPECT_NEAR(value(row, "length.bar"), 20e-3, 0.05 * cell) << gap;
  }
}

TEST(Bar, SpallLayerAndPullback) {
  Maker start(0.1e-3), end(0.1e-3);
  for (int i = 0; i < 40; ++i) {
    const double z = (i + 0.5) * 0.1e-3;
    start.add({0, 0, z}, Vector3::Zero());
    end.add({0, 0, z + (i < 26 ? 1e-3 : 1.7e-3)}, Vector3::Zero());  // 1.4 mm flies ahead
  }
  const Quantities row =
      spall_measures(start.snapshot, end.snapshot, quarter(), 0, {"target", Vector3::Zero(), 0.1e-3}, true);
  EXPECT_NEAR(value(row, "spall_thickness.target"), 1.4e-3, 1e-9);
  EXPECT_NEAR(value(row, "largest_gap.target"), 0.8e-3, 1e-9);
  // A second plane 0.5 mm behind, wider open: what flies off is still the layer ahead of the first.
  for (std::size_t i = 0; i < 21; ++i) end.snapshot.position[i].z() -= 0.9e-3;
  const Quantities planes =
      spall_measures(start.snapshot, end.snapshot, quarter(), 0, {"target", Vector3::Zero(), 0.1e-3}, true);
  EXPECT_NEAR(value(planes, "spall_thickness.target"), 1.4e-3, 1e-9);
  EXPECT_NEAR(value(planes, "largest_gap.target"), 1.0e-3, 1e-9);
  EXPECT_DOUBLE_EQ(pullback({0, 100, 480, 500, 500, 430, 345, 350, 410, 300}), 155.0);
  EXPECT_TRUE(std::isnan(pullback({0, 100, 500, 499, 498})));
}

TEST(Bar, ALayerNeedsMoreThanASingleParticle) {
  Maker start(0.1e-3);
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 4; ++j) start.add({j * 0.1e-3, 0, (i + 0.5) * 0.1e-3}, Vector3::Zero());
  }
  const BodyInput target{"target", Vector3::Zero(), 0.1e-3};
  const auto measure = [&](const Snapshot& end, bool planar = true) {
    return spall_measures(start.snapshot, end, quarter(), 0, target, planar);
  };
  EXPECT_TRUE(std::isnan(value(measure(start.snapshot), "spall_thickness.target")));  // no gap at all
  EXPECT_EQ(value(measure(start.snapshot), "largest_gap.target"), 0.0);
  Snapshot end = start.snapshot;
  end.position.back().z() += 5e-3;
  EXPECT_TRUE(std::isnan(value(measure(end), "spall_thickness.target")));  // one particle ahead of the gap
  for (std::size_t i = 120; i < 160; ++i) end.position[i].z() += 1e-3;     // and a layer of 1 mm
  EXPECT_NEAR(value(measure(end), "spall_thickness.target"), 1e-3, 1e-9);
  EXPECT_TRUE(std::isnan(value(measure(end, false), "spall_thickness.target")));
  EXPECT_TRUE(std::isnan(value(measure(end, false), "largest_gap.target")));
}

TEST(Bar, OnlyABodyThatFliesAtTheWallIsOneAndItKeepsItsLengthWhenItRebounds) {
  constexpr double cell = 0.5e-3;
  Maker maker(0.5 * cell);
  maker.fill({0, 0, 0}, {5e-3, 5e-3, 20e-3}, [](const Vector3& p) { return std::hypot(p.x(), p.y()) < 4e-3; },
             {0, 0, -200});
  Frame frame = quarter(200);
  frame.sign = -1.0;
  frame.wall = 0.0;
  EXPECT_TRUE(bar_measures(maker.snapshot, frame, 0, {"charge", Vector3::Zero(), 0.5 * cell}, cell, 0.0, true)
                  .empty());
  for (Vector3& position : maker.snapshot.position) position.z() += 3e-3;
  const Quantities row =
      bar_measures(maker.snapshot, frame, 0, {"bar", {0, 0, -200}, 0.5 * cell}, cell, 30e-3, false);
  EXPECT_NEAR(value(row, "length.bar"), 20e-3, 1e-9);
  EXPECT_NEAR(value(row, "foot_diameter.bar"), 8e-3, 0.06e-3);
  EXPECT_DOUBLE_EQ(value(row, "foot_temperature.bar"), 300.0);
  EXPECT_TRUE(std::isnan(value(row, "diameter_at.bar")));  // 30 mm from the end of a bar of 20 mm
}

TEST(Frame, AFaceIsAWallOnlyIfTheProjectileFliesAtIt) {
  analysis::Run bar;
  bar.bodies = {{"bar", Vector3(0, 0, -200), 1e-3}};
  bar.mirror_planes[2] = 0.0;
  bar.walls[2][0] = {.position = 0.0, .holds = true};
  Maker maker(1e-3);
  maker.add(Vector3(0, 0, 5e-3), bar.bodies[0].velocity);
  EXPECT_EQ(find_frame(bar, maker.snapshot).wall, 0.0);
  bar.mirror_planes[2].reset();
  bar.walls[2][0]->holds = false;  // a wall that only pushes is one all the same
  EXPECT_EQ(find_frame(bar, maker.snapshot).wall, 0.0);
  EXPECT_FALSE(find_frame(bar, maker.snapshot).wall_holds);
  bar.bodies[0].velocity.z() = 200.0;
  EXPECT_FALSE(find_frame(bar, maker.snapshot).wall.has_value());
  bar.bodies[0].velocity.z() = 0.0;  // a charge
  EXPECT_FALSE(find_frame(bar, maker.snapshot).wall.has_value());
}

TEST(Cloud, BodiesWithoutPhasesCountInNone) {
  Maker maker(1e-3);
  maker.add(Vector3::Zero(), {0, 0, 4000}, 0, 2.0);
  maker.add(Vector3::Zero(), {0, 0, 4000}, 1, 0.0, 3900.0);
  std::vector<BodyInput> bodies = {{"ball", {0, 0, 6000}, 1e-3}, {"wall", Vector3::Zero(), 1e-3}};
  bodies[1].phases = false;
  const Quantities wall = body_measures(maker.snapshot, quarter(), 1, bodies[1]);
  EXPECT_TRUE(std::isnan(value(wall, "solid_fraction.wall")));
  EXPECT_TRUE(std::isnan(value(wall, "melted_fraction.wall")));
  EXPECT_EQ(value(body_measures(maker.snapshot, quarter(), 0, bodies[0]), "liquid_fraction.ball"), 1.0);
  const Quantities cloud = cloud_measures(maker.snapshot, quarter(), {}, bodies);
  EXPECT_EQ(value(cloud, "debris_melted_fraction"), 1.0);
  EXPECT_TRUE(std::isnan(value(cloud, "cloud_length")));  // there is no target
  const Table table = body_table(maker.snapshot, quarter(), bodies);
  const auto row = std::ranges::find(table.labels, "wall whole") - table.labels.begin();
  EXPECT_TRUE(std::isnan(table["solid_fraction"][static_cast<std::size_t>(row)]));
}

// A slice counts once, a quarter four times, in the one as in the other.
TEST(Cloud, MassesOfBodiesAreThoseOfFragmentsAndWhatIsLoose) {
  for (const std::string planes : {"none", "quarter", "slice", "wall"}) {
    analysis::Run run;
    run.bodies = {{"ball", Vector3(0, 0, -1000), 1e-3}};
    const auto mirror = [&](std::size_t axis, std::size_t side, double position) {
      run.walls[axis][side] = {.position = position, .holds = true};
      run.mirror_planes[axis] = run.walls[axis][0] ? run.walls[axis][0]->position : position;
    };
    if (planes != "none") mirror(0, 0, 0.0);
    if (planes == "quarter") mirror(1, 0, 0.0);
    if (planes == "slice") mirror(0, 1, 4e-3);
    if (planes == "wall") mirror(2, 0, 0.0);
    Maker maker(1e-3);
    maker.fill(
        Vector3::Zero(), Vector3(4e-3, 3e-3, 3e-3), [](const Vector3&) { return true; },
        run.bodies[0].velocity);
    maker.add(Vector3(2.5e-3, 9.5e-3, 9.5e-3), run.bodies[0].velocity);  // alone: loose
    const Frame frame = find_frame(run, maker.snapshot);
    const Fragments found = find_fragments(maker.snapshot, run.bodies, frame, 1.5e-3);
    double sum = found.of_body[0].loose;
    EXPECT_GT(sum, 0.0);
    for (const Fragment& fragment : found.list) sum += fragment.copies * fragment.mass;
    EXPECT_NEAR(body_table(maker.snapshot, frame, run.bodies)["mass"][0], sum, 1e-12 * sum) << planes;
  }
}

TEST(Measures, TheTableOfTheManualIsThatOfTheProgram) {
  std::ifstream file(std::filesystem::path(whipple::tests::source_folder()) / "docs/manual/output.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  const std::string table = measures_as_markdown();
  EXPECT_NE(page.find(table), std::string::npos) << "docs/manual/output.md lacks the table\n" << table;
  std::set<std::string_view> names;
  for (const Measure& measure : measures()) EXPECT_TRUE(names.insert(measure.name).second) << measure.name;
  EXPECT_EQ(measured("length", "bar", 1.0).unit, "m");
  EXPECT_FALSE(measured("length", "bar", nan).reason.empty());
  EXPECT_THROW(measured("length", 1.0), InternalError);
}

TEST(Frame, AHalfModelIsSeenAcrossItsMirrorPlane) {
  analysis::Run rod;
  rod.bodies = {{"rod", Vector3(2000, 0, -1000), 1e-3}, {"plate", Vector3::Zero(), 1e-3}};
  rod.mirror_planes[1] = 0.0;
  Maker maker(1e-3);
  maker.add(Vector3(1e-3, 2e-3, 5e-3), rod.bodies[0].velocity);
  const Frame half = find_frame(rod, maker.snapshot);
  EXPECT_EQ(half.axis, 0);
  EXPECT_EQ(half.transverse, (std::array<int, 2>{2, 1}));
  EXPECT_TRUE(half.centre.isApprox(Vector3(0, 0, 5e-3)));
  EXPECT_EQ(half.copies(), 2.0);
  rod.mirror_planes[2] = 0.0;
  EXPECT_EQ(find_frame(rod, maker.snapshot).transverse, (std::array<int, 2>{1, 2}));
}

}  // namespace
}  // namespace whipple::analysis
