// SPDX-License-Identifier: BSD-3-Clause
// Failed points: spall, free liquid, plastic failure, voids that open and close without changing the energy.
#include <gtest/gtest.h>

#include <random>

#include "src/core/base/linear_algebra.hpp"
#include "src/material/failure/plastic_strain.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/material_file.hpp"
#include "src/material/principal.hpp"
#include "tests/unit/material_support.hpp"

namespace whipple {
namespace failure_test {

using namespace material_test;

TEST(PrincipalValue, IsTheGreatestEigenvalueOfEveryDeviator) {
  std::mt19937_64 generator(5);
  for (int i = 0; i < 2000; ++i) {
    Matrix3 m = random_matrix(generator, 1e9);
    m = (0.5 * (m + m.transpose())).eval();
    if (i % 3 == 0) m = (Vector3(2, -1, -1) * (i % 2 == 0 ? 1e8 : -1e8)).asDiagonal();  // double values
    m -= m.trace() / 3.0 * Matrix3::Identity();
    const double expected = symmetric_eigen(m).values[2];
    const SymmetricTensor s = SymmetricTensor::from(m);
    ASSERT_NEAR(material::greatest_principal_value(s), expected, 1e-7 * m.norm());
    ASSERT_LE(expected, material::greatest_principal_bound(s) * (1 + 1e-12));
  }
  EXPECT_EQ(material::greatest_principal_value({}), 0.0);
}

std::shared_ptr<const failure::Criterion> spall(double strength) {
  return std::make_shared<failure::CriterionModel<failure::TensilePressure>>(
      failure::TensilePressure{{}, strength});
}
std::shared_ptr<const failure::Criterion> ductile(double strain) {
  return std::make_shared<failure::CriterionModel<failure::PlasticStrain>>(
      failure::PlasticStrain{{}, strain});
}

constexpr double dt = 1e-8;
const UpdateSettings settings{.time_step = dt, .cell_size = 1e-3};
const UpdateSettings without_viscosity{
    .time_step = dt, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};

/// Returns a uniform volume change by `ratio` in one step.
Matrix3 dilation(double ratio) { return (std::cbrt(ratio) - 1.0) / dt * Matrix3::Identity(); }

double total_volume(const MaterialPoints& points) { return points.volume[0] + points.void_volume[0]; }

void expect_void_rules(const MaterialPoints& points, double total) {
  ASSERT_NEAR(total_volume(points), total, 1e-12 * total);
  ASSERT_GE(points.void_volume[0], 0.0);
  if (points.failed[0] != failure::intact) {
    ASSERT_GE(points.pressure[0], 0.0);
    ASSERT_EQ(points.deviatoric_stress[0].squared_norm(), 0.0);
  }
  if (points.void_volume[0] > 0.0) {
    ASSERT_EQ(points.pressure[0], 0.0);
    ASSERT_EQ(points.artificial_viscosity[0], 0.0);
  }
}

TEST(Spall, FailsAtTheStrengthTimesScatterAndOpensAVoid) {
  const Material material = with(taylor_copper(), {spall(1e9)});
  for (const double factor : {1.0, 0.7, 1.3}) {
    MaterialPoints points = points_of(material, 1);
    points.failure_threshold_factor.assign(points.mass.size(), factor);
    double lowest = 0.0, total = 1e-9;
    int steps = 0;
    while (points.failed[0] == failure::intact) {
      ASSERT_LT(++steps, 1000);
      step_with_work(material, points, dilation(1.0001), settings);
      total *= std::pow(1.0 + dt * dilation(1.0001)(0, 0), 3.0);
      lowest = std::min(lowest, points.pressure[0]);
    }
    EXPECT_EQ(points.failed[0], failure::tensile);
    EXPECT_NEAR(lowest, -factor * 1e9, 0.02e9);
    EXPECT_GT(points.void_volume[0], 0.0);
    expect_void_rules(points, total);
  }
}

TEST(Spall, MatterBesideTheVoidComesToZeroPressureAtConstantEnergy) {
  const Material material = with(taylor_copper(), {spall(1e9)});
  MaterialPoints points = points_of(material, 1);
  while (points.failed[0] == failure::intact) step_with_work(material, points, dilation(1.0001), settings);
  const double energy = points.specific_internal_energy[0];
  const double total = total_volume(points);
  const Matrix3 rest = Matrix3::Zero();
  for (int n = 0; n < 6; ++n) step_with_work(material, points, rest, settings);
  EXPECT_EQ(points.specific_internal_energy[0], energy);
  expect_void_rules(points, total);
  const LinearInEnergy eos;
  const double density = points.mass[0] / points.volume[0];
  EXPECT_NEAR(eos.pressure(density, energy), 0.0, 1e-9 * eos.rho0 * eos.c0 * eos.c0);
  // The energy stored by 1 GPa of tension, p^2 / (2 K rho), has become heat: at least that energy above the cold curve.
  EXPECT_GT(energy, 0.9 * 1e18 / (2.0 * eos.rho0 * eos.rho0 * eos.c0 * eos.c0));
}

TEST(Void, CycleOfOpeningAndClosingIsNeutralAndPressureReturnsAtTheZeroPressureVolume) {
  const Material material = with(taylor_copper(), {spall(1e9)});
  MaterialPoints points = points_of(material, 1);
  points.failed[0] = failure::tensile;
  double total = 1e-9;
  const auto strain_to = [&](double target, int steps) {
    const double ratio = std::pow(target / total_volume(points), 1.0 / steps);
    for (int n = 0; n < steps; ++n) {
      const Matrix3 gradient = dilation(ratio);
      step_with_work(material, points, gradient, without_viscosity);
      total *= volume_ratio(gradient, dt);
      expect_void_rules(points, total);
    }
  };
  double opened = 0.0;
  for (int cycle = 0; cycle < 3; ++cycle) {
    const double before = points.specific_internal_energy[0];
    strain_to(2e-9, 500);
    opened = points.specific_internal_energy[0];
    EXPECT_NEAR(opened, before,
                cycle == 0 ? 1.0 : 20.0);  // J/kg; the step that crosses p = 0 costs one step's work
    EXPECT_NEAR(points.void_volume[0], 1e-9, 1e-12);
    strain_to(1.001e-9, 500);
    EXPECT_EQ(points.specific_internal_energy[0], opened);  // no work while the void is open
    EXPECT_GT(points.void_volume[0], 0.0);
    strain_to(0.98e-9, 500);  // closed and compressed by 2 %
    EXPECT_EQ(points.void_volume[0], 0.0);
    const LinearInEnergy eos;
    EXPECT_NEAR(points.pressure[0], eos.pressure(8930.0 / 0.98, points.specific_internal_energy[0]),
                1e-3 * points.pressure[0]);
    strain_to(1.0005e-9, 500);
  }
}

TEST(Void, HotMatterGrowsIntoItsVoidAndThenCarriesPressure) {
  const Material material = with(taylor_copper(), {spall(1e9)});
  MaterialPoints points = points_of(material, 1);
  points.failed[0] = failure::tensile;
  points.void_volume[0] = 0.02e-9;
  points.specific_internal_energy[0] =
      500e3;  // p = rho Gamma e = 8.8 GPa, expansion at p = 0 is more than 2 %
  const Matrix3 rest = Matrix3::Zero();
  double previous = points.volume[0];
  for (int n = 0; n < 20; ++n) {
    step_with_work(material, points, rest, settings);
    expect_void_rules(points, 1.02e-9);
    ASSERT_GE(points.volume[0], previous);
    previous = points.volume[0];
  }
  EXPECT_EQ(points.void_volume[0], 0.0);
  const LinearInEnergy eos;
  EXPECT_NEAR(points.pressure[0], eos.pressure(8930.0 / 1.02, 500e3), 1e-9 * eos.rho0 * eos.c0 * eos.c0);
  EXPECT_EQ(points.specific_internal_energy[0], 500e3);
}

TEST(Void, MatterGrowsIntoItsVoidByATenthOfItsVolumeInAStepAtMostAndTheLimitIsCounted) {
  const Material material = with(taylor_copper(), {spall(1e9)});
  MaterialPoints points = points_of(material, 1);
  points.failed[0] = failure::tensile;
  points.void_volume[0] = 1e-9;
  points.specific_internal_energy[0] = 2e6;  // 35 GPa: expansion at p = 0 is a quarter
  const Matrix3 rest = Matrix3::Zero();
  const MaterialReport first = update_material(material, points, 0, 1, std::span(&rest, 1), settings);
  EXPECT_NEAR(points.volume[0], 1.1e-9, 1e-15);
  EXPECT_EQ(first.limited_void_steps, 1U);
  std::size_t later = 0;
  for (int n = 0; n < 20; ++n) {
    later = update_material(material, points, 0, 1, std::span(&rest, 1), settings).limited_void_steps;
  }
  EXPECT_EQ(later, 0U);
  expect_void_rules(points, 2e-9);
}

TEST(Void, FailedMatterAtZeroPressureHasTheLeastSoundSpeed) {
  const Material material = with(taylor_copper(), {spall(1e9)});
  MaterialPoints points = points_of(material, 1);
  points.failed[0] = failure::tensile;
  step_with_work(material, points, dilation(1.01), settings);
  EXPECT_NEAR(points.sound_speed[0], 0.1 * 3940.0, 1e-9 * 3940.0);
  points = points_of(material, 1);
  points.failed[0] = failure::tensile;
  step_with_work(material, points, dilation(0.99),
                 without_viscosity);  // compressed: bulk sound speed, no shear
  const LinearInEnergy eos;
  EXPECT_NEAR(points.sound_speed[0],
              std::sqrt(eos.sound_squared(8930.0 / 0.99, points.specific_internal_energy[0])), 1e-6);
}

TEST(FreeLiquid, FullyMeltedMatterPartsAtAnyTensionAndHalfMeltedAtHalfTheStrength) {
  LinearInEnergy eos;
  eos.gamma = 0.0;  // pressure of the density alone
  eos.melting_starts = 400e3;
  eos.melting_ends = 600e3;
  const Material material = with(taylor_copper(), {spall(1e9)}, eos);
  const double modulus = eos.rho0 * eos.c0 * eos.c0;
  for (const auto& [energy, threshold] : {std::pair{300e3, 1e9}, {500e3, 0.5e9}, {700e3, 0.0}}) {
    for (const double offset : {-0.05e9, 0.05e9}) {
      MaterialPoints points = points_of(material, 1);
      points.specific_internal_energy[0] = energy;
      const double tension = threshold + offset;
      const Matrix3 gradient = dilation(1.0 / (1.0 - tension / modulus));
      update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
      EXPECT_EQ(points.failed[0] != failure::intact, offset > 0.0) << energy << " J/kg, " << tension << " Pa";
    }
  }
}

TEST(PlasticStrain, FailsWithItsOwnCodeAndKeepsTheEquationOfState) {
  const Material material = with(taylor_copper(), {spall(1e9), ductile(0.1)});
  MaterialPoints points = points_of(material, 1);
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 1) = 0.01 / dt;
  MaterialReport report;
  int steps = 0;
  while (points.failed[0] == failure::intact) {
    ASSERT_LT(++steps, 100);
    report.merge(step_with_work(material, points, gradient, settings));
  }
  EXPECT_EQ(points.failed[0], failure::plastic);
  EXPECT_EQ(report.failed[failure::plastic], 1U);
  EXPECT_NEAR(points.plastic_strain[0], 0.1, 0.007);
  for (int n = 0; n < 10; ++n) step_with_work(material, points, dilation(0.999), settings);
  const LinearInEnergy eos;
  EXPECT_NEAR(points.pressure[0],
              eos.pressure(points.mass[0] / points.volume[0], points.specific_internal_energy[0]),
              0.02 * points.pressure[0]);
  EXPECT_EQ(points.deviatoric_stress[0].squared_norm(), 0.0);
}

TEST(Failure, WithoutCriteriaMatterHoldsAnyTension) {
  const Material material = with(taylor_copper());
  MaterialPoints points = points_of(material, 1);
  for (int n = 0; n < 100; ++n) step_with_work(material, points, dilation(1.001), settings);
  EXPECT_EQ(points.failed[0], failure::intact);
  EXPECT_LT(points.pressure[0], -5e9);
}

TEST(Failure, EnergyIntegratingSchemeDoesNoWorkOnAnOpenVoid) {
  const Material material = with(taylor_copper(), {spall(1e9)});
  MaterialPoints points = points_of(material, 1);
  points.failed[0] = failure::tensile;
  const auto step = [&](double ratio) {
    const Matrix3 gradient = dilation(ratio);
    update_material_and_energy(material, points, 0, 1, std::span(&gradient, 1), settings);
  };
  step(1.001);
  const double opened = points.specific_internal_energy[0];
  EXPECT_NEAR(opened, 0.0, 1.0);  // from p = 0 to p = 0: the tension that was cut off did no work
  for (int n = 0; n < 100; ++n) step(1.005);
  for (int n = 0; n < 99; ++n) step(1.0 / 1.005);
  EXPECT_GT(points.void_volume[0], 0.0);
  EXPECT_EQ(points.specific_internal_energy[0], opened);
}

TEST(Void, RulesHoldOnRandomWalksThroughSolidLiquidAndVapour) {
  // Copper with its three-phase equation of state, failed, from cold to vapour, volume varying between 1/1.2 and 20 of
  // the initial one: the total volume follows J, void and pressure exclude each other, the energy is constant while a
  // void is open, and no state leaves the range of the model.
  const Material material = read_material("copper");
  std::mt19937_64 generator(17);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int open = 0, pressed = 0;
  for (const double initial_energy : {0.0, 0.3e6, 0.8e6, 2e6, 5e6, 9e6}) {
    SCOPED_TRACE(initial_energy);
    MaterialPoints points = points_of(material, 1);
    points.failed[0] = failure::tensile;
    points.specific_internal_energy[0] = initial_energy;
    const double initial = points.volume[0];
    double total = initial;
    double drift = 0.0;
    for (int n = 0; n < 3000; ++n) {
      drift = 0.95 * drift + 0.003 * uniform(generator);
      if (total > 20.0 * initial) drift = -std::abs(drift);
      if (total < initial / 1.2) drift = std::abs(drift);
      const Matrix3 gradient = dilation(std::exp(drift));
      const double before = points.specific_internal_energy[0];
      const bool was_open = points.void_volume[0] > 0.0;
      ASSERT_TRUE(step_with_work(material, points, gradient, settings).valid()) << "step " << n;
      total *= volume_ratio(gradient, dt);
      ASSERT_NO_FATAL_FAILURE(expect_void_rules(points, total)) << "step " << n;
      ASSERT_TRUE(std::isfinite(points.temperature[0]) && points.temperature[0] > 0.0);
      if (was_open) {
        ASSERT_EQ(points.specific_internal_energy[0], before);
      }
      ++(points.void_volume[0] > 0.0 ? open : pressed);
    }
  }
  EXPECT_GT(open, 1000);
  EXPECT_GT(pressed, 1000);
}

TEST(FreeLiquid, CopperMeltedByTheEquationOfStateFailsAtTheFirstTension) {
  const Material material = read_material("copper");
  MaterialPoints points = points_of(material, 1);
  points.specific_internal_energy[0] = 1.2e6;  // liquid at its reference volume, under pressure
  step_with_work(material, points, Matrix3::Zero(), without_viscosity);
  ASSERT_EQ(points.melted_fraction[0], 1.0);
  ASSERT_GT(points.pressure[0], 10e9);
  double last_pressure = points.pressure[0];
  int steps = 0;
  while (points.failed[0] == failure::intact) {
    ASSERT_LT(++steps, 2000);
    ASSERT_GE(points.pressure[0], 0.0);
    last_pressure = points.pressure[0];
    step_with_work(material, points, dilation(1.0005), without_viscosity);
  }
  EXPECT_LT(last_pressure, 0.2e9);  // the pressure decreased to zero before it broke
  EXPECT_EQ(points.pressure[0], 0.0);
  EXPECT_GT(points.void_volume[0], 0.0);
}

}  // namespace failure_test
}  // namespace whipple
