// SPDX-License-Identifier: BSD-3-Clause
// Response of the constitutive update to invalid or nearly invalid states.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
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
  EXPECT_EQ(report.first_squeezed, 17U);  // compressed to twice the density, the limit of this model
  EXPECT_EQ(report.squeezed, 1U);
  EXPECT_TRUE(MaterialReport::is_too_dense(report.squeezed_mass, report.mass));
  EXPECT_FALSE(report.valid());
  EXPECT_NEAR(points.volume[17], 0.5e-9 / 0.999, 1e-20);
}

/// Tests that a thousandth of the mass may be compressed beyond the end of its equation of state: it is limited there,
/// with a finite pressure, and counted. More mass means that the material itself is too dense, which ends the run.
/// Points that were split weigh less.
TEST(Report, HoldsSinglePointsAtTheEndOfTheEquationOfState) {
  const Material material = with(taylor_copper());
  const double volume = 1e-9 * material.reference.density / (0.999 * material.eos->maximum_density());
  for (const auto& [squeezed, share] : {std::pair(1U, 1.0), std::pair(3U, 1.0), std::pair(20U, 1.0 / 16.0)}) {
    MaterialPoints points = points_of(material, 2000);
    for (std::size_t k = 0; k < squeezed; ++k) {
      points.mass[700 + k] *= share;
      points.volume[700 + k] *= share;
    }
    std::vector<Matrix3> gradients(2000, Matrix3::Zero());
    for (std::size_t k = 0; k < squeezed; ++k) gradients[700 + k](0, 0) = -0.9e8;
    const MaterialReport report =
        update_material(material, points, 0, 2000, gradients, {.time_step = 1e-8, .cell_size = 1e-3});
    EXPECT_EQ(report.points, 2000U);
    EXPECT_EQ(report.squeezed, squeezed);
    EXPECT_EQ(report.first_squeezed, 700U);
    EXPECT_NEAR(report.squeezed_mass / report.mass, squeezed * share / 2000.0, 1e-5);
    EXPECT_EQ(report.valid(), squeezed != 3U);
    EXPECT_NEAR(points.volume[700], share * volume, 1e-12 * volume);
    EXPECT_TRUE(std::isfinite(points.pressure[700]) && points.pressure[700] > 0.0);
  }
}

/// An isolated particle of vapour, whose pressure meets no resistance, fills more of the grid in every step.
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
