// SPDX-License-Identifier: BSD-3-Clause
// Records of made-up particle sets: radiographs, views, witness plates, arrivals, peaks of shocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/analysis/arrivals.hpp"
#include "src/analysis/canvas.hpp"
#include "src/analysis/columns.hpp"
#include "src/analysis/peaks.hpp"
#include "src/analysis/radiograph.hpp"
#include "src/analysis/views.hpp"
#include "src/analysis/witness.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/analysis_support.hpp"

namespace whipple::analysis {
namespace {

TEST(Radiograph, ArealDensityOfASlabAndTheMassOfAll) {
  // Slab of 4 mm in the line of sight (y), quarter model cut at x = 0 and y = 0: 2 mm of it are in the model.
  Maker maker(0.25e-3);
  maker.fill({0, 0, 0}, {10e-3, 2e-3, 20e-3}, [](const Vector3&) { return true; }, Vector3::Zero());
  const Frame frame = quarter();
  PictureLimits limits;
  limits.include(maker.snapshot, frame);
  const double attenuation = 0.05;
  const Radiograph picture = take_radiograph(maker.snapshot, frame, limits,
                                             {.pixel = 0.5e-3, .spot = 1e-3, .attenuation = {attenuation}});
  const double total =
      std::accumulate(picture.areal_density[0].begin(), picture.areal_density[0].end(), 0.0) * 0.25e-6;
  EXPECT_NEAR(total, density * 20e-3 * 4e-3 * 20e-3, 1e-6 * total);
  const auto row = static_cast<std::size_t>((0.0 - picture.lower_up) / picture.pixel);
  const auto column = static_cast<std::size_t>((10e-3 - picture.lower_axial) / picture.pixel);
  const double middle = picture.areal_density[0][row * picture.columns + column];
  EXPECT_NEAR(middle, density * 4e-3, 1e-3 * middle);
  EXPECT_NEAR(picture.transmission[row * picture.columns + column], std::exp(-attenuation * middle), 1e-12);
  EXPECT_EQ(picture.transmission[0], 1.0);
}

TEST(Radiograph, AParticleOfVapourFillsItsVolume) {
  Maker maker(1e-3);
  maker.add(Vector3(0.3e-3, 0.1e-3, 0.2e-3), Vector3::Zero());
  maker.snapshot.scalars["density"][0] = density / 64;  // a cube of 4 mm
  Frame frame;
  PictureLimits limits{.lower_axial = -3e-3, .upper_axial = 3e-3, .lower_up = -3e-3, .upper_up = 3e-3};
  const Radiograph picture =
      take_radiograph(maker.snapshot, frame, limits, {.pixel = 0.25e-3, .spot = 0.0, .attenuation = {1.0}});
  const double m = density * 1e-9;
  const std::vector<double>& image = picture.areal_density[0];
  EXPECT_NEAR(std::accumulate(image.begin(), image.end(), 0.0) * 0.25e-3 * 0.25e-3, m, 1e-9 * m);
  EXPECT_NEAR(*std::ranges::max_element(image), m / (4e-3 * 4e-3), 1e-9 * m / 16e-6);
}

TEST(Radiograph, TheImageBeyondAMirrorPlaneLooksTheSame) {
  Maker maker(1e-3);
  maker.add(Vector3(3e-3, 1e-3, 0), Vector3::Zero());
  maker.snapshot.scalars["density"][0] = density / 27;  // a cube of 3 mm
  PictureLimits limits{.lower_axial = -4e-3, .upper_axial = 4e-3, .lower_up = -6e-3, .upper_up = 6e-3};
  const Radiograph picture = take_radiograph(maker.snapshot, quarter(), limits,
                                             {.pixel = 0.5e-3, .spot = 0.0, .attenuation = {1.0}});
  const std::vector<double>& image = picture.areal_density[0];
  EXPECT_NEAR(std::accumulate(image.begin(), image.end(), 0.0) * 0.25e-6, 4 * density * 1e-9, 1e-15);
  for (std::size_t row = 0; row < picture.rows; ++row) {
    for (std::size_t column = 0; column < picture.columns; ++column) {
      EXPECT_NEAR(image[row * picture.columns + column],
                  image[(picture.rows - 1 - row) * picture.columns + column], 1e-12);
    }
  }
}

TEST(Radiograph, BlurOfALineHasTheWidthOfTheSpot) {
  // A thin rod across the picture: after the blur it is a Gaussian of the given full width at half maximum.
  Maker maker(0.1e-3);
  for (int i = -200; i < 200; ++i) maker.add({1e-4 * (i + 0.5), 0, 0}, Vector3::Zero());
  Frame frame;  // a whole model
  PictureLimits limits;
  limits.include(maker.snapshot, frame);
  const Radiograph picture =
      take_radiograph(maker.snapshot, frame, limits, {.pixel = 0.1e-3, .spot = 2e-3, .attenuation = {1.0}});
  const std::size_t row = picture.rows / 2;
  double sum = 0, moment = 0, mean = 0;
  for (std::size_t c = 0; c < picture.columns; ++c) {
    const double x = (static_cast<double>(c) + 0.5) * picture.pixel + picture.lower_axial;
    const double s = picture.areal_density[0][row * picture.columns + c];
    sum += s;
    mean += s * x;
    moment += s * x * x;
  }
  EXPECT_NEAR(mean / sum, 0.0, 1e-6);
  // The pixels themselves add a little to the variance.
  EXPECT_NEAR(std::sqrt(moment / sum) * 2.3548, 2e-3, 0.02e-3);
}

TEST(Canvas, SpheresHideWhatIsBehindWhicheverIsDrawnFirst) {
  for (const std::uint32_t nearer : {0U, 1U}) {
    Canvas canvas(40, 40);
    canvas.sphere({20.0, 20.0, nearer == 0 ? 50.0 : 0.0}, 8.0, 0);
    canvas.sphere({22.0, 20.0, nearer == 0 ? 0.0 : 50.0}, 5.0, 1);
    EXPECT_EQ(canvas.seen()[20 * 40 + 21], nearer);
    EXPECT_EQ(canvas.seen()[0], Canvas::nothing);
  }
}

// Two hexahedra, the right one with a slanted front; a sphere between the viewer and the left one.
TEST(Canvas, ElementsAreDrawnByTheirFaces) {
  std::vector<Vector3> nodes;
  for (const double z : {0.0, 20.0}) {
    for (const double y : {10.0, 30.0}) {
      for (const double x : {10.0, 20.0, 30.0}) nodes.emplace_back(x, y, x == 30.0 ? z - 4.0 : z);
    }
  }
  const std::vector<Corners> elements = {{0, 1, 4, 3, 6, 7, 10, 9}, {1, 2, 5, 4, 7, 8, 11, 10}};
  const std::vector<Face> faces = surface_faces(elements);
  ASSERT_EQ(faces.size(), 10U) << "the face between both is no surface";
  EXPECT_EQ(std::ranges::count(faces, 0U, &Face::element), 5);
  std::vector<std::array<Vector3, 4>> corners;
  std::vector<std::uint32_t> labels;
  for (const Face& face : faces) {
    corners.push_back(
        {nodes[face.corners[0]], nodes[face.corners[1]], nodes[face.corners[2]], nodes[face.corners[3]]});
    labels.push_back(face.element);
  }
  Canvas canvas(40, 40);
  canvas.faces(corners, labels);
  canvas.sphere({14.0, 20.0, 22.0}, 2.0, 7);
  canvas.sphere({26.0, 20.0, 10.0}, 2.0, 8);  // inside an element
  const auto seen = [&](std::size_t row, std::size_t column) { return canvas.seen()[row * 40 + column]; };
  const auto light = [&](std::size_t row, std::size_t column) { return canvas.light()[row * 40 + column]; };
  EXPECT_EQ(std::ranges::count(canvas.seen(), Canvas::nothing), 40 * 40 - 400)
      << "20 by 20 pixels are covered";
  EXPECT_EQ(seen(12, 12), 0U);
  EXPECT_EQ(seen(12, 28), 1U);
  EXPECT_EQ(seen(20, 14), 7U);
  EXPECT_EQ(std::ranges::count(canvas.seen(), 8U), 0);
  EXPECT_NEAR(light(10, 15), Canvas::edge_darkness * light(15, 15), 1e-6);
  EXPECT_NE(light(15, 25), light(15, 15)) << "light by the slope";
}

TEST(Canvas, ShadingDarkensTheFarAndWhatIsBesideTheNear) {
  Canvas canvas(60, 60);
  canvas.sphere({15.0, 15.0, 100.0}, 6.0, 0);
  canvas.sphere({15.0, 45.0, 0.0}, 6.0, 1);
  canvas.sphere({45.0, 45.0, 0.0}, 6.0, 2);
  canvas.sphere({45.0, 55.0, 100.0}, 4.0, 3);
  const std::vector<float> before = canvas.light();
  canvas.shade(0.5);
  const auto left = [&](std::size_t row, std::size_t column) {
    return canvas.light()[row * 60 + column] / before[row * 60 + column];
  };
  EXPECT_NEAR(left(15, 15), 1.0, 0.02);  // of the nearest
  EXPECT_NEAR(left(45, 15), 0.5, 0.03);
  EXPECT_LT(left(49, 45), 0.9 * left(41, 45)) << "beside what is nearer";
  EXPECT_EQ(canvas.light()[0], 0.0F);
}

TEST(Views, SpheresReachTheirNeighboursInThinDebrisOnly) {
  std::vector<Vector3> positions;
  std::vector<double> edges(1001, 1.0);
  for (int k = 0; k < 1000; ++k) positions.emplace_back(2.0 * (k % 10), 2.0 * (k / 10 % 10), 2.0 * (k / 100));
  positions.emplace_back(100.0, 0.0, 0.0);
  const std::vector<double> spread = drawn_diameters(positions, edges, false);
  EXPECT_NEAR(spread[555], 2.0, 0.25);
  EXPECT_EQ(spread[1000], 1.0) << "a particle alone keeps the size of its material";
  for (Vector3& x : positions) x *= 10.0;
  EXPECT_EQ(drawn_diameters(positions, edges, false)[555], 1.0) << "particles that are apart";
  for (Vector3& x : positions) x *= 0.05;
  EXPECT_NEAR(drawn_diameters(positions, edges, false)[555], 1.0, 0.25) << "dense material";
  EXPECT_EQ(drawn_diameters({}, {}, true).size(), 0U);
  for (Vector3& x : positions) x[2] = 0.0;
  edges[1000] = 8.0;
  EXPECT_EQ(drawn_diameters(positions, edges, false)[1000], 8.0) << "thin material in space";
  EXPECT_EQ(drawn_diameters(positions, edges, true)[1000], 1.0) << "a ring alone";
}

TEST(Views, AreCloserTogetherAtTheBeginning) {
  std::vector<SnapshotEntry> entries;
  for (int k = 0; k <= 8; ++k) entries.push_back({.file = {}, .time = 1e-6 * k});
  EXPECT_EQ(shown_snapshots(entries, 3), (std::vector<std::size_t>{0, 2, 8}));
  EXPECT_EQ(shown_snapshots(entries, 1), (std::vector<std::size_t>{0}));
  EXPECT_EQ(shown_snapshots(entries, 100).back(), 8U);
  EXPECT_TRUE(shown_snapshots({}, 3).empty());
}

TEST(Witness, FreeFlightToARingAtAKnownTime) {
  Maker maker(1e-3);
  const double m = density * 1e-9;
  maker.add({1e-3, 0, 10e-3}, {500, 0, 2000});   // 90 mm in 45 us, lands at 1 + 22.5 mm
  maker.add({0, 2e-3, 110e-3}, {0, 100, 1000});  // beyond: was there 10 us before, at 1 mm
  maker.add({0, 0, 0}, {0, 0, 10});              // no debris
  maker.snapshot.time = 20e-6;
  const Loads witness = witness_plate(maker.snapshot, quarter(), {.position = 100e-3, .ring = 2e-3});
  EXPECT_DOUBLE_EQ(value(witness.totals, "witness_mass"), 4 * 2 * m);
  EXPECT_DOUBLE_EQ(value(witness.totals, "witness_momentum"), 4 * m * 3000);
  EXPECT_NEAR(value(witness.totals, "witness_first"), 10e-6, 1e-15);
  EXPECT_NEAR(value(witness.totals, "witness_last"), 65e-6, 1e-15);
  ASSERT_EQ(witness.rings.rows(), 12U);
  EXPECT_NEAR(witness.rings["mass_per_area"][0], 4 * m / (pi * 4e-6), 1e-9);
  EXPECT_NEAR(witness.rings["energy_per_area"][11] * pi * (24e-3 * 24e-3 - 22e-3 * 22e-3),
              4 * 0.5 * m * (500.0 * 500 + 2000.0 * 2000), 1e-9);
  const std::vector<double>& flux = witness.flux["mass_flux"];
  EXPECT_NEAR(std::accumulate(flux.begin(), flux.end(), 0.0) * 1.1e-6, 8 * m, 1e-12);
}

TEST(Arrivals, CountWhatPassesThePlaneOnceWithItsMotionBefore) {
  const double m = density * 1e-9;
  const auto at = [](double time, const std::vector<std::pair<std::uint64_t, Vector3>>& places,
                     double speed) {
    Maker maker(1e-3);
    for (const auto& [id, place] : places) {
      maker.add(place, {0, 0, speed}, id == 9 ? 1 : 0);
      maker.snapshot.id.back() = id;
    }
    maker.snapshot.time = time;
    return maker.snapshot;
  };
  Arrivals arrivals(quarter(), 10e-3, 1);
  // 1 passes in the middle of an interval and is slowed behind; 2 returns and passes again; 3 has left the domain beyond
  // the plane; 4 is under way; 5 begins beyond; 9 is of the wall.
  arrivals.add(at(0.0,
                  {{1, {3e-3, 0, 9e-3}},
                   {2, {0, 1e-3, 9e-3}},
                   {3, {5e-3, 0, 8e-3}},
                   {4, {0, 0, -9e-3}},
                   {5, {0, 0, 11e-3}},
                   {9, {0, 0, 9e-3}}},
                  2000));
  arrivals.add(at(1e-6,
                  {{1, {5e-3, 0, 11e-3}},
                   {2, {0, 1e-3, 10.5e-3}},
                   {3, {5e-3, 0, 9e-3}},
                   {4, {0, 0, -7e-3}},
                   {5, {0, 0, 9e-3}},
                   {9, {0, 0, 11e-3}}},
                  1000));
  arrivals.add(at(3e-6, {{1, {5e-3, 0, 12e-3}}, {2, {0, 1e-3, 9.5e-3}}, {4, {0, 0, -5e-3}}}, 1000));
  arrivals.add(at(4e-6, {{2, {0, 1e-3, 10.5e-3}}, {4, {0, 0, -4e-3}}}, 1000));
  const Loads loads = arrivals.loads(2e-3);
  EXPECT_DOUBLE_EQ(value(loads.totals, "loads_mass"), 4 * 3 * m);
  EXPECT_DOUBLE_EQ(value(loads.totals, "loads_momentum"), 4 * m * (2000 + 2000 + 1000));
  EXPECT_NEAR(value(loads.totals, "loads_energy"), 4 * 0.5 * m * (2 * 4e6 + 1e6), 1e-9);
  EXPECT_NEAR(value(loads.totals, "loads_first"), 0.5e-6, 1e-15);
  EXPECT_NEAR(value(loads.totals, "loads_last"), 2e-6, 1e-15);
  EXPECT_DOUBLE_EQ(value(loads.totals, "loads_under_way"), 4 * m);
  ASSERT_EQ(loads.rings.rows(), 3U);
  EXPECT_DOUBLE_EQ(loads.rings["mass"][0], 4 * m);        // 2, at 1 mm
  EXPECT_NEAR(loads.rings["mass"][2], 4 * 2 * m, 1e-18);  // 1 and 3, at 4 and 5 mm
  EXPECT_NEAR(loads.rings["momentum_per_area"][0], 4 * m * 2000 / (pi * 4e-6), 1e-9);
  EXPECT_TRUE(std::isnan(value(Arrivals(quarter(), 1.0).loads(1e-3).totals, "loads_first")));
}

TEST(PeakDecay, PowerLawFront) {
  // A front that passes with P = 40 GPa (depth / 10 mm)^-1.3: every snapshot holds the peak of one layer.
  Maker maker(1e-3);
  for (int k = 0; k < 60; ++k) maker.add({0.5e-3, 0.5e-3, (k + 0.5) * 1e-3}, Vector3::Zero(), 1);
  PeakDecay peaks(maker.snapshot, quarter(), 1, 1e-3, 0.0);
  for (int k = 0; k < 60; ++k) {
    std::vector<double>& pressure = maker.snapshot.scalars["pressure"];
    pressure.assign(60, 1e8);
    pressure[static_cast<std::size_t>(k)] = 40e9 * std::pow((k + 0.5) / 10.0, -1.3);
    peaks.add(maker.snapshot);
  }
  const Quantities row = peaks.measures(10e-3);
  EXPECT_NEAR(value(row, "peak_pressure_exponent"), 1.3, 1e-9);
  EXPECT_NEAR(value(row, "peak_pressure_4_diameters"), 40e9 * std::pow(4.0, -1.3), 1.0);
  const Table profile = peaks.profile(1e-3);
  ASSERT_EQ(profile.rows(), 60U);
  EXPECT_NEAR(profile["peak_pressure"][20], 40e9 * std::pow(2.05, -1.3), 1.0);
  const auto mean_of = [](int layers) {
    double sum = 0.0;
    for (int k = 0; k < layers; ++k) sum += 40e9 * std::pow((k + 0.5) / 10.0, -1.3);
    return sum / layers;
  };
  EXPECT_NEAR(value(row, "peak_pressure_contact"), mean_of(3), 1.0);
  EXPECT_NEAR(value(row, "peak_pressure_contact_wide"), mean_of(6), 1.0);
}

TEST(PeakDecay, FrontBetweenTwoSnapshots) {
  // The front has passed every layer before the only snapshot: the pressure is back to 0.1 GPa, the greatest
  // of all steps still tells the peak.
  Maker maker(1e-3);
  for (int k = 0; k < 60; ++k) maker.add({0.5e-3, 0.5e-3, (k + 0.5) * 1e-3}, Vector3::Zero(), 1);
  PeakDecay peaks(maker.snapshot, quarter(), 1, 1e-3, 0.0);
  maker.snapshot.scalars["pressure"].assign(60, 1e8);
  std::vector<double>& greatest = maker.snapshot.scalars["maximum_pressure"];
  for (int k = 0; k < 60; ++k) greatest.push_back(40e9 * std::pow((k + 0.5) / 10.0, -1.3));
  peaks.add(maker.snapshot);
  const Quantities row = peaks.measures(10e-3);
  EXPECT_NEAR(value(row, "peak_pressure_exponent"), 1.3, 1e-9);
  EXPECT_NEAR(value(row, "peak_pressure_4_diameters"), 40e9 * std::pow(4.0, -1.3), 1.0);
}

}  // namespace
}  // namespace whipple::analysis
