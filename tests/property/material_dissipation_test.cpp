// SPDX-License-Identifier: BSD-3-Clause
// Irreversible energy of the update: artificial viscosity, and the dissipation that the models report.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/material_file.hpp"
#include "src/material/strength/viscous_fluid.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace {

using namespace material_test;

TEST(Viscosity, ActsInCompressionOnlyWithThePublishedForm) {
  const Material material = with(taylor_copper());
  MaterialPoints points = points_of(material, 2);
  const double sound = points.sound_speed[0];
  const UpdateSettings settings{
      .time_step = 1e-12, .cell_size = 2e-3, .linear_viscosity = 0.3, .quadratic_viscosity = 1.5};
  std::array<Matrix3, 2> gradients = {Matrix3::Zero(), Matrix3::Zero()};
  gradients[0](0, 0) = -1e5;
  gradients[1](0, 0) = 1e5;
  update_material(material, points, 0, 2, gradients, settings);
  const double closing = 2e-3 * 1e5;
  EXPECT_NEAR(points.artificial_viscosity[0], 8930.0 * closing * (1.5 * closing + 0.3 * sound),
              1e3);  // of 3 GPa
  EXPECT_EQ(points.artificial_viscosity[1], 0.0);
}

/// Tests that it dissipates and never turns pressure into tension.
TEST(Viscosity, InExpansionActsWhereAskedForAndNeverExceedsThePressure) {
  const Material material = with(taylor_copper());
  MaterialPoints points = points_of(material, 4);
  const double sound = points.sound_speed[0];
  points.pressure = {20e9, 1e8, 0.0, -1e9};
  const UpdateSettings settings{
      .time_step = 1e-12, .cell_size = 2e-3, .linear_viscosity = 0.3, .expansion_viscosity = 0.5};
  std::vector<Matrix3> gradients(4, Matrix3::Zero());
  for (Matrix3& gradient : gradients) gradient(1, 1) = 1e5;
  update_material(material, points, 0, 4, gradients, settings);
  EXPECT_NEAR(points.artificial_viscosity[0], -8930.0 * 2e-3 * 1e5 * 0.5 * sound, 1e3);  // of 4 GPa
  EXPECT_EQ(points.artificial_viscosity[1], -1e8);
  EXPECT_EQ(points.artificial_viscosity[2], 0.0);
  EXPECT_EQ(points.artificial_viscosity[3], 0.0);

  MaterialPoints closing = points_of(material, 1), usual = closing;
  gradients[0](1, 1) = -1e5;
  UpdateSettings without = settings;
  without.expansion_viscosity = 0.0;
  update_material(material, closing, 0, 1, gradients, settings);
  update_material(material, usual, 0, 1, gradients, without);
  EXPECT_EQ(closing.artificial_viscosity[0], usual.artificial_viscosity[0]);
}

/// Tests that a length for every point of the set replaces the cell size, in ranges and in lists.
TEST(Viscosity, TakesTheLengthOfEachPoint) {
  const Material material = with(taylor_copper());
  const std::size_t n = 300;
  std::vector<double> lengths(n);
  for (std::size_t i = 0; i < n; ++i) lengths[i] = 1e-3 + 1e-6 * static_cast<double>(i);
  const std::vector<Matrix3> gradients(n, Matrix3(Vector3(-1e4, 0.0, 0.0).asDiagonal()));
  MaterialPoints range = points_of(material, n), list = range;
  UpdateSettings settings{.time_step = 1e-8};
  settings.lengths = lengths;
  update_material(material, range, 10, n, std::span(gradients).subspan(10), settings);
  const std::vector<std::uint32_t> indices = {299, 3, 150};
  update_material(material, list, indices, std::span(gradients).first(3), settings);
  for (const std::uint32_t i : {3U, 150U, 299U}) {
    MaterialPoints one = points_of(material, n);
    update_material(material, one, i, i + 1, std::span(gradients).first(1),
                    {.time_step = 1e-8, .cell_size = lengths[i]});
    EXPECT_GT(one.artificial_viscosity[i], 0.0);
    EXPECT_EQ(list.artificial_viscosity[i], one.artificial_viscosity[i]);
    if (i >= 10) {
      EXPECT_EQ(range.artificial_viscosity[i], one.artificial_viscosity[i]);
    }
  }
}

/// Returns the heating part of the viscosity over the whole, for one step of uniform closing of a point at `density`.
/// @param of_field  rate of the affine field over that of the grid
double share_that_heats(double density, double of_field, std::uint8_t failed = 0) {
  const Material material = make_material("fluid", std::make_shared<LinearInEnergy>());
  MaterialPoints points = points_of(material, 1);
  points.volume[0] = points.mass[0] / density;
  points.failed[0] = failed;
  points.heating_viscosity.assign(1, 0.0);
  const double rate = 1e5;  // 1/s
  const Matrix3 gradient = -rate / 3.0 * Matrix3::Identity();
  const std::vector<double> affine = {-of_field * rate};
  const UpdateSettings settings{.time_step = 1e-9,
                                .cell_size = 1e-3,
                                .linear_viscosity = 0.0,
                                .heating = HeatingViscosity::of_affine_field,
                                .affine_divergence = affine,
                                .affine_gain = 1.5,
                                .affine_compression = 0.25,
                                .initial_density = material.reference.density};
  update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
  EXPECT_GT(points.artificial_viscosity[0], 0.0);
  return points.heating_viscosity[0] / points.artificial_viscosity[0];
}

// docs/theory/dissipation.md, eq. 5, 6; with c1 = 0 the viscosity is proportional to the square of the rate.
TEST(HeatingViscosity, FollowsTheAffineFieldWhereMatterMeetsAndIsAllOfItInShocks) {
  const double start = make_material("fluid", std::make_shared<LinearInEnergy>()).reference.density;
  EXPECT_NEAR(share_that_heats(1.0001 * start, 0.0), 0.0, 1e-6);
  EXPECT_NEAR(share_that_heats(1.0001 * start, 0.4), 0.36, 1e-3);
  EXPECT_EQ(share_that_heats(1.0001 * start, 1.0), 1.0);  // uniform compression
  EXPECT_NEAR(share_that_heats(1.125 * start, 0.0), 0.25, 1e-3);
  EXPECT_EQ(share_that_heats(1.3 * start, 0.0), 1.0);
  EXPECT_EQ(share_that_heats(0.99 * start, 0.0), 1.0);  // thinner than at the start: voids close
}

TEST(HeatingViscosity, IsStoredAsTheModeOfTheUpdateSaysWhateverThePointsHold) {
  const Material material = make_material("fluid", std::make_shared<LinearInEnergy>());
  const Matrix3 gradient = -3e4 * Matrix3::Identity();
  for (const HeatingViscosity mode : {HeatingViscosity::not_distinguished, HeatingViscosity::whole}) {
    MaterialPoints points = points_of(material, 1);
    points.heating_viscosity.assign(1, -7.0);
    update_material(material, points, 0, 1, std::span(&gradient, 1),
                    {.time_step = 1e-9, .cell_size = 1e-3, .heating = mode});
    EXPECT_GT(points.artificial_viscosity[0], 0.0);
    EXPECT_EQ(points.heating_viscosity[0],
              mode == HeatingViscosity::whole ? points.artificial_viscosity[0] : -7.0);
  }
}

/// Steps a point through random motions and calls check(report, points) after each of them.
template <class Check>
void wander(const Material& material, std::uint64_t seed, Check check) {
  std::mt19937_64 generator(seed);
  MaterialPoints points = points_of(material, 100);
  for (int step = 0; step < 40; ++step) {
    std::vector<Matrix3> gradients;
    for (std::size_t i = 0; i < points.mass.size(); ++i) gradients.push_back(random_matrix(generator, 3e5));
    for (double& e : points.specific_internal_energy)
      e = std::max(0.0, e + 1e4 * random_matrix(generator, 1.0)(0, 0));
    UpdateSettings settings = without_viscosity(1e-8);
    settings.time = step * 1e-8;
    check(update_material(material, points, 0, points.mass.size(), gradients, settings), points);
  }
}

// The second law for every kind of model of the library: flow laws, damage, brittle strength, pores, voids, fluids.
TEST(Dissipation, IsNeverNegativeInAnyStateOfAnyModel) {
  for (const char* name :
       {"copper", "copper_johnson_cook", "copper_taylor", "tantalum", "lead", "steel_4340_mie_gruneisen",
        "tungsten_nickel_iron", "basalt_tillotson", "concrete_35mpa_rht", "concrete_48mpa_hjc",
        "alumina_99_5_jh2", "float_glass_jh2", "ballistic_gelatin_10", "polycarbonate", "water"}) {
    const Material material = read_material(std::string(name));
    double sum = 0.0;
    for (const std::uint64_t seed : {1U, 2U}) {
      wander(material, seed, [&](const MaterialReport& report, const MaterialPoints&) {
        EXPECT_GE(report.dissipation, 0.0) << name;
        EXPECT_GE(report.dissipation, report.plastic_work * (1.0 - 1e-12)) << name;
        sum += report.dissipation;
      });
    }
    EXPECT_EQ(sum > 0.0, material.strength->carries_deviator() || material.strength->viscosity() > 0.0)
        << name;
  }
}

TEST(Dissipation, IsThePlasticWorkOfAMetalAndTheViscousWorkOfAFluid) {
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 1) = 1e5;
  MaterialPoints metal = points_of(with(taylor_copper()), 1);
  const UpdateSettings settings = without_viscosity(1e-6);
  const MaterialReport of_metal =
      update_material(with(taylor_copper()), metal, 0, 1, std::span(&gradient, 1), settings);
  EXPECT_GT(of_metal.dissipation, 0.0);
  EXPECT_EQ(of_metal.dissipation, of_metal.plastic_work);

  const Material oil =
      make_material("oil", std::make_shared<LinearInEnergy>(),
                    std::make_shared<strength::ViscousFluidModel>(strength::ViscousFluid{50.0}));
  MaterialPoints fluid = points_of(oil, 1);
  const MaterialReport of_fluid = update_material(oil, fluid, 0, 1, std::span(&gradient, 1), settings);
  const double expected = 50.0 * 1e10 * 1e-6 * 1e-9;  // eta (dv/dy)^2 dt V
  EXPECT_NEAR(of_fluid.dissipation, expected, 1e-12 * expected);
}

// Failing material loses the elastic energy of its deviator.
TEST(Dissipation, OfAFailingPointIsItsElasticEnergy) {
  failure::TensilePressure spall;
  spall.spall_strength = 1e9;
  const Material material =
      with(taylor_copper(), {std::make_shared<failure::CriterionModel<failure::TensilePressure>>(spall)});
  MaterialPoints points = points_of(material, 1);
  points.deviatoric_stress[0] = {60e6, -30e6, -30e6, 0.0, 0.0, 0.0};
  const Matrix3 opening = 1e-2 / 1e-9 * Matrix3::Identity();
  const MaterialReport report =
      update_material(material, points, 0, 1, std::span(&opening, 1), without_viscosity(1e-9));
  ASSERT_EQ(points.failed[0], failure::tensile);
  const double stored = 1.5 * 60e6 * 60e6 / (4.0 * taylor_copper().shear_modulus) * 1e-9;
  EXPECT_NEAR(report.dissipation, stored, 0.04 * stored);  // the volume grows by 3 %
}

// A rupturing fluid has no elastic energy to lose.
TEST(Dissipation, OfAFailingFluidIsNone) {
  failure::TensilePressure rupture;
  rupture.spall_strength = 1e8;
  const Material fluid =
      make_material("fluid", std::make_shared<LinearInEnergy>(), nullptr,
                    {std::make_shared<failure::CriterionModel<failure::TensilePressure>>(rupture)});
  MaterialPoints points = points_of(fluid, 1);
  const Matrix3 opening = 1e-2 / 1e-9 * Matrix3::Identity();
  const MaterialReport report =
      update_material(fluid, points, 0, 1, std::span(&opening, 1), without_viscosity(1e-9));
  ASSERT_EQ(points.failed[0], failure::tensile);
  EXPECT_EQ(report.dissipation, 0.0);
}

}  // namespace
}  // namespace whipple
