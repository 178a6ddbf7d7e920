// SPDX-License-Identifier: BSD-3-Clause
// What the constitutive update does with states that make no sense, or almost none.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "src/material/material_file.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;

TEST(Report, NamesTheFirstUndefinedPointAndCountsLimitedVolumeChanges) {
  const Material material = with(taylor_copper());
  MaterialPoints points = points_of(material, 600);
  std::vector<Matrix3> gradients(600, Matrix3::Zero());
  gradients[17](0, 0) = -0.9e8;  // J = 0.1 in one step
  gradients[400](1, 1) = std::nan("");
  gradients[555](1, 2) = std::nan("");
  points.specific_internal_energy[520] = std::nan("");
  const MaterialReport report =
      update_material(material, points, 0, 600, gradients, {.time_step = 1e-8, .cell_size = 1e-3});
  EXPECT_EQ(report.undefined, 3U);
  EXPECT_EQ(report.first_undefined, 400U);
  EXPECT_EQ(report.limited_volume_changes, 1U);
  EXPECT_EQ(report.limited_densities, 0U);
  EXPECT_EQ(report.equation_of_state.first, 17U);  // compressed to twice the density, the limit of this model
  EXPECT_FALSE(report.valid());
  EXPECT_NEAR(points.volume[17], 0.5e-9, 1e-20);
}

/// A lone particle of vapour, whose pressure nothing resists, fills more of the grid in every step.
TEST(ThinMatter, StopsExpandingAtABillionthOfItsDensityAndCanBeCompressedAgain) {
  const Material material = read_material("copper.toml");
  MaterialPoints points = points_of(material, 1);
  points.specific_internal_energy[0] += 12e6;
  const double least = 1e-9 * material.reference.density;
  const auto density = [&] { return points.mass[0] / points.volume[0]; };
  std::size_t limited = 0;
  const auto advance = [&](double rate, int steps) {
    const Matrix3 gradient = rate * Matrix3::Identity();
    for (int step = 0; step < steps; ++step) {
      const MaterialReport report = update_material(material, points, 0, 1, std::span(&gradient, 1),
                                                    {.time_step = 1e-8, .cell_size = 1e-4});
      ASSERT_TRUE(report.valid());
      limited += report.limited_densities;
      ASSERT_TRUE(std::isfinite(points.sound_speed[0]));
    }
  };
  advance(1e7, 30);
  EXPECT_GT(density(), 1e3 * least) << "not yet";
  EXPECT_EQ(limited, 0U);
  EXPECT_EQ(points.vaporised_fraction[0], 1.0);
  advance(1e7, 3000);
  EXPECT_NEAR(density(), least, 1e-6 * least);
  EXPECT_GT(limited, 2000U);
  limited = 0;
  advance(-1e6, 100);
  EXPECT_EQ(limited, 0U);
  EXPECT_NEAR(density(), least / std::pow(0.99, 300), 1e-3 * density()) << "follows J again";
}

}  // namespace
}  // namespace whipple
