// SPDX-License-Identifier: BSD-3-Clause
// The size of fragments that failed points keep (docs/theory/cracks.md, eq. 8), at rates that are known.
#include <gtest/gtest.h>

#include "src/material/failure/fragment_size.hpp"
#include "src/material/failure/plastic_strain.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;

constexpr double dt = 1e-9, energy = 2e4;  // s, J/m^2

std::shared_ptr<const failure::Criterion> spall(failure::SpallResponse response) {
  return std::make_shared<failure::CriterionModel<failure::TensilePressure>>(
      failure::TensilePressure{{}, 1e9, response});
}

/// Copper that a criterion fails, and that keeps the size of its fragments.
Material keeping(const std::shared_ptr<const failure::Criterion>& criterion, const LinearInEnergy& eos = {}) {
  const failure::FragmentSize::Constants constants = {energy};
  return with(taylor_copper(), {criterion, std::make_shared<failure::FragmentSize>(constants)}, eos);
}

double size_of(const MaterialPoints& points) { return points.history.scalar("fragment_size")[0]; }

void step(const Material& material, MaterialPoints& points, double rate) {
  step_with_work(material, points, rate / 3.0 * Matrix3::Identity(), {.time_step = dt, .cell_size = 1e-3});
}

/// Expands a point at a volumetric rate (1/s) until it fails.
void expand(const Material& material, MaterialPoints& points, double rate) {
  for (int n = 0; points.failed[0] == failure::intact; ++n) {
    ASSERT_LT(n, 1000);
    step(material, points, rate);
  }
}

/// Density (kg/m^3) of a point without its void: of the step in which it failed.
double density_at_failure(const MaterialPoints& points) {
  return points.mass[0] / (points.volume[0] + points.void_volume[0]);
}

TEST(FragmentSize, IsGradysAtTheRateAndDensityOfTheStepOfFailure) {
  const Material material = keeping(spall(failure::SpallResponse::failure));
  for (const double rate : {1e5, 1e6}) {
    MaterialPoints points = points_of(material, 1);
    EXPECT_EQ(size_of(points), 0.0);
    expand(material, points, rate);
    const double expected = std::cbrt(24.0 * energy / (density_at_failure(points) * rate * rate));
    EXPECT_NEAR(size_of(points), expected, 1e-12 * expected);
    step(material, points, 10.0 * rate);  // it has failed: it stays
    EXPECT_NEAR(size_of(points), expected, 1e-12 * expected);
  }
}

TEST(FragmentSize, OfToughnessIsThatOfGrady1988) {
  // Aluminium of K_c = 30 MPa sqrt(m) at 1e6 1/s: (sqrt(24) K/(rho c rate))^(2/3).
  const double density = 2785.0, sound = 5328.0, toughness = 30e6, rate = 1e6;
  const double by_toughness = std::pow(std::sqrt(24.0) * toughness / (density * sound * rate), 2.0 / 3.0);
  EXPECT_NEAR(by_toughness, 0.461e-3, 1e-6);
  const failure::FragmentSize sizes({toughness * toughness / (density * sound * sound)});
  EXPECT_NEAR(sizes.size_of(density, 0.0, rate), by_toughness, 1e-12 * by_toughness);
  EXPECT_NEAR(sizes.size_of(density, 0.0, 8.0 * rate), by_toughness / 4.0, 1e-12 * by_toughness);
  EXPECT_EQ(sizes.size_of(density, 0.0, 0.0), 0.0);
  EXPECT_EQ(sizes.size_of(density, 0.0, -rate), 0.0);
}

TEST(FragmentSize, HealsWithThePointAndIsThatOfTheLastFailure) {
  const Material material = keeping(spall(failure::SpallResponse::opening));
  MaterialPoints points = points_of(material, 1);
  expand(material, points, 1e6);
  const double first = size_of(points);
  EXPECT_GT(first, 0.0);
  for (int n = 0; points.failed[0] != failure::intact; ++n) {
    ASSERT_LT(n, 1000);
    step(material, points, -1e6);
  }
  EXPECT_EQ(size_of(points), 0.0);
  expand(material, points, 8e6);
  EXPECT_NEAR(size_of(points), first / 4.0, 0.02 * first);  // 8^(-2/3); densities differ a little
}

TEST(FragmentSize, OfMaterialThatFailsInShearIsNone) {
  const Material material = keeping(
      std::make_shared<failure::CriterionModel<failure::PlasticStrain>>(failure::PlasticStrain{{}, 0.01}));
  for (const double expansion : {-1e3, 1e3}) {
    MaterialPoints points = points_of(material, 1);
    Matrix3 gradient = expansion / 3.0 * Matrix3::Identity();
    gradient(0, 1) = 1e6;
    for (int n = 0; points.failed[0] == failure::intact; ++n) {
      ASSERT_LT(n, 1000);
      step_with_work(material, points, gradient, {.time_step = dt, .cell_size = 1e-3});
    }
    EXPECT_EQ(size_of(points) > 0.0, expansion > 0.0) << expansion;
  }
}

TEST(FragmentSize, MeltTakesTheEnergyOfItsSolidAlone) {
  LinearInEnergy eos;
  eos.melting_starts = -1e5;  // half of the mass at e = 0
  eos.melting_ends = 1e5;
  const Material material = keeping(spall(failure::SpallResponse::failure), eos);
  MaterialPoints points = points_of(material, 1);
  expand(material, points, 1e6);
  const double solid = 1.0 - points.melted_fraction[0];
  EXPECT_GT(solid, 0.3);
  EXPECT_LT(solid, 0.7);
  const double expected = std::cbrt(24.0 * energy * solid / (density_at_failure(points) * 1e12));
  EXPECT_NEAR(size_of(points), expected, 1e-3 * expected);
}

TEST(FragmentSize, IsKeptOnlyWhereAskedForOnceByWhatFails) {
  const auto criterion = spall(failure::SpallResponse::failure);
  EXPECT_EQ(points_of(with(taylor_copper(), {criterion}), 1).history.find("fragment_size"), nullptr);
  const failure::FragmentSize::Constants constants = {energy};
  const auto sizes = std::make_shared<failure::FragmentSize>(constants);
  EXPECT_THROW(with(taylor_copper(), {sizes}), InputError);
  EXPECT_THROW(with(taylor_copper(), {sizes, criterion, sizes}), InputError);
}

}  // namespace
}  // namespace whipple
