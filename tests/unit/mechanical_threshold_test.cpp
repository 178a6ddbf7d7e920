// SPDX-License-Identifier: BSD-3-Clause
// Mechanical threshold stress: the published formula, its closed integral, the number of steps, and the path as a state.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "src/material/material_file.hpp"
#include "src/material/strength/mechanical_threshold_model.hpp"
#include "src/material/update.hpp"

namespace whipple {
namespace {

using strength::MechanicalThreshold;
using strength::MechanicalThresholdModel;

/// Annealed copper: Follansbee and Kocks, Acta Metall. 36 (1988) 81.
MechanicalThreshold annealed_copper() {
  MechanicalThreshold c;
  c.reference_density = 8930.0;
  c.shear_modulus = 47.7e9;
  c.modulus_drop = 3.0e9;
  c.modulus_temperature = 180.0;
  c.melting_temperature = 1356.0;
  c.boltzmann_per_volume = 0.823e6;
  c.athermal_stress = 40e6;
  c.forest = {.energy = 1.6, .rate = 1e7, .p = 2.0 / 3.0, .q = 1.0};
  c.hardening = 2390e6;
  c.hardening_by_log_rate = 12e6;
  c.hardening_by_root_rate = 1.696e6;
  c.hardening_shape = 2.0;
  c.saturation = 770e6;
  c.saturation_energy = 0.2625;
  c.saturation_rate = 1e7;
  return c;
}

/// Steel HY-100, which has an intrinsic threshold and stage IV: Goto et al. (1999).
MechanicalThreshold hy100() {
  MechanicalThreshold c;
  c.reference_density = 7830.0;
  c.shear_modulus = 71.46e9;
  c.modulus_drop = 2.9e9;
  c.modulus_temperature = 204.0;
  c.melting_temperature = 1793.0;
  c.boltzmann_per_volume = 0.905e6;
  c.athermal_stress = 40e6;
  c.intrinsic_threshold = 1341e6;
  c.intrinsic = {.energy = 1.161, .rate = 1e13, .p = 0.5, .q = 1.5};
  c.forest = {.energy = 1.6, .rate = 1e7, .p = 2.0 / 3.0, .q = 1.0};
  c.hardening = 6000e6;
  c.hardening_by_temperature = 2.0758e6;
  c.last_hardening = 200e6;
  c.hardening_shape = 3.0;
  c.saturation = 822e6;
  c.saturation_energy = 0.112;
  c.saturation_rate = 1e7;
  return c;
}

TEST(MechanicalThreshold, ABarrierNeedsAllOfItsConstantsAndItsThreshold) {
  MechanicalThreshold c = hy100();
  EXPECT_NO_THROW(c.require_consistent());
  c.intrinsic.q = 0.0;
  EXPECT_THROW(c.require_consistent(), InputError);
  c = hy100();
  c.intrinsic_threshold = 0.0;
  EXPECT_THROW(c.require_consistent(), InputError);
  c.intrinsic = {};
  EXPECT_NO_THROW(c.require_consistent());
}

// With theta_IV, (31) hardens on beyond saturation at a slope between 0 and theta_IV.
TEST(MechanicalThreshold, HardensOnBeyondSaturationWithALastHardening) {
  const MechanicalThreshold c = hy100();
  const auto at = c.condition(600.0, c.modulus(c.reference_density, 0.0, 600.0));
  const double slow = c.log_rate(1e-3), end = c.saturation_of(slow, at);
  const auto beyond = c.threshold(3.0 * end, 1e-3, slow, at);
  EXPECT_GT(beyond.slope, 0.0);
  EXPECT_LT(beyond.slope, c.last_hardening);
  EXPECT_NEAR(beyond.value, 3.0 * end + 1e-3 * beyond.slope, 1e-6 * end);
}

/// A point at constant temperature, at rest, that is strained.
struct Point {
  MechanicalThresholdModel model;
  std::array<double, 1> density, pressure = {0.0}, temperature, strain = {0.0}, threshold = {0.0};

  Point(const MechanicalThreshold& constants, double kelvin)
      : model(constants), density{constants.reference_density}, temperature{kelvin} {}
  [[nodiscard]] strength::State state() const { return {density, pressure, temperature, strain, threshold}; }
  void deform(double by, double rate, int steps) {
    const std::array increment = {by / steps};
    for (int i = 0; i < steps; ++i)
      model.advance_threshold(state(), increment, increment[0] / rate, threshold);
  }
  /// MPa
  [[nodiscard]] double flow(double rate) const {
    const std::array at = {rate};
    std::array<double, 1> stress{};
    model.flow_stress(state(), at, stress);
    return 1e-6 * stress[0];
  }
};

double flow_after(const MechanicalThreshold& constants, double strain, double rate, double kelvin,
                  int steps = 2000) {
  Point point(constants, kelvin);
  if (strain > 0.0) point.deform(strain, rate, steps);
  return point.flow(rate);
}

// The published formulas with the published constants, the hardening integrated apart by an adaptive Runge-Kutta method.
TEST(MechanicalThreshold, GivesThePublishedFormulaWithAndWithoutAnIntrinsicThreshold) {
  const MechanicalThreshold copper = annealed_copper(), steel = hy100();
  EXPECT_NEAR(flow_after(copper, 0.05, 1e-3, 300.0), 114.088, 0.01);
  EXPECT_NEAR(flow_after(copper, 0.3, 1e3, 300.0), 327.831, 0.01);
  EXPECT_NEAR(flow_after(copper, 0.3, 1e4, 800.0), 228.030, 0.01);
  EXPECT_NEAR(flow_after(copper, 0.3, 1e6, 300.0), 444.241, 0.01);
  EXPECT_NEAR(flow_after(copper, 1.0, 1e4, 300.0), 504.454, 0.01);
  EXPECT_NEAR(flow_after(steel, 0.0, 1e-3, 300.0), 760.816, 0.01);
  EXPECT_NEAR(flow_after(steel, 0.1, 1e-3, 300.0), 914.716, 0.01);
  EXPECT_NEAR(flow_after(steel, 0.1, 1e3, 300.0), 1110.027, 0.01);
  EXPECT_NEAR(flow_after(steel, 0.3, 1e3, 600.0), 855.633, 0.01);
  EXPECT_EQ(flow_after(copper, 0.3, 1e3, 1400.0), 0.0);  // molten
}

// Without stage IV, v = alpha (1 - sigma_e/sigma_es) obeys
//   alpha theta_0 ep/sigma_es = sinh(alpha) {cosh(alpha) ln[sinh(alpha)/sinh(v)] - sinh(alpha) (alpha - v)}.
TEST(MechanicalThreshold, HardensAlongTheClosedIntegralInAnyNumberOfSteps) {
  const MechanicalThreshold c = annealed_copper();
  const double rate = 1e3, strain = 0.5, a = c.hardening_shape;
  const MechanicalThreshold::Condition at = c.condition(300.0, c.modulus(8930.0, 0.0, 300.0));
  const double end = c.saturation_of(std::log(rate), at), theta = c.hardening +
                                                                  c.hardening_by_log_rate * std::log(rate) +
                                                                  c.hardening_by_root_rate * std::sqrt(rate);
  const auto strain_of = [&](int steps) {
    Point point(c, 300.0);
    point.deform(strain, rate, steps);
    const double v = a * (1.0 - point.threshold[0] / end);
    return end / (a * theta) * std::sinh(a) *
           (std::cosh(a) * std::log(std::sinh(a) / std::sinh(v)) - std::sinh(a) * (a - v));
  };
  EXPECT_NEAR(strain_of(2000), strain, 1e-6 * strain);
  EXPECT_NEAR(strain_of(5), strain, 0.03 * strain);
  EXPECT_NEAR((strain_of(20) - strain) / (strain_of(40) - strain), 4.0, 0.5);  // second order
  Point once(c, 300.0);
  once.deform(100.0, rate, 1);  // one step of any size stays below saturation
  EXPECT_LE(once.threshold[0], end);
}

TEST(MechanicalThreshold, RemembersTheRateAtWhichItHardened) {
  // Copper strained by 0.15 at 1e4 1/s and at 1e-3 1/s, both tested at 1e-3 1/s: the fast one is harder, as no
  // function of strain, rate and temperature can have it (Follansbee and Kocks 1988).
  Point fast(annealed_copper(), 300.0), slow(annealed_copper(), 300.0);
  fast.deform(0.15, 1e4, 500);
  slow.deform(0.15, 1e-3, 500);
  EXPECT_GT(fast.flow(1e-3), 1.05 * slow.flow(1e-3));
  EXPECT_GT(fast.flow(1e4), fast.flow(1e-3));
  // Above the saturation of a slower rate it softens to it, and not further.
  fast.threshold[0] = 760e6;
  fast.deform(50.0, 1e-3, 1);
  const MechanicalThreshold c = annealed_copper();
  EXPECT_DOUBLE_EQ(fast.threshold[0],
                   c.saturation_of(std::log(1e-3), c.condition(300.0, c.modulus(8930.0, 0.0, 300.0))));
}

TEST(MechanicalThreshold, YieldConditionHoldsAfterTheReturn) {
  std::mt19937_64 generator(13);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int yielding = 0;
  for (int i = 0; i < 4000; ++i) {
    MechanicalThreshold c = i % 2 == 0 ? annealed_copper() : hy100();
    if (i % 4 < 2) c.pressure_coefficient = 2.83e-11;
    Point point(c, 200.0 + 1100.0 * unit(generator));
    point.threshold[0] = i % 5 == 0 ? 0.0 : 900e6 * unit(generator);
    point.density[0] *= 0.9 + 0.5 * unit(generator);
    point.pressure[0] = -2e9 + 1e11 * unit(generator);
    const std::array solid = {i % 3 == 0 ? unit(generator) + 1e-3 : 1.0};
    std::array<double, 1> modulus{}, increment{};
    point.model.shear_modulus(point.state(), modulus);
    const MechanicalThreshold::Condition at = c.condition(point.temperature[0], modulus[0]);
    modulus[0] *= solid[0];
    const double dt = std::pow(10.0, -9.0 + 3.0 * unit(generator));
    const std::array trial = {std::pow(10.0, 6.0 + 4.0 * unit(generator))};
    point.model.plastic_increment(point.state(), trial, modulus, solid, dt, increment);
    const double x = increment[0];
    ASSERT_GE(x, 0.0);
    if (x > 0.0) {
      ++yielding;
      const double y = solid[0] * c.flow(point.threshold[0], x, dt, at).value;
      ASSERT_NEAR(trial[0] - 3.0 * modulus[0] * x, y, 1e-9 * trial[0]) << "state " << i;
      // what the next step begins with
      const double before = point.threshold[0];
      point.model.advance_threshold(point.state(), increment, dt, point.threshold);
      ASSERT_EQ(point.threshold[0], c.threshold(before, x, c.log_rate(x / dt), at).value);
    } else {
      ASSERT_LE(trial[0], solid[0] * c.flow(point.threshold[0], 1e-30, dt, at).value * (1.0 + 1e-12))
          << "state " << i;
    }
  }
  EXPECT_GT(yielding, 1000);
}

TEST(MechanicalThreshold, RefusesConstantsThatContradictOneAnother) {
  MechanicalThreshold wrong = annealed_copper();
  wrong.modulus_drop = 8e9;  // no stiffness left at 1356 K
  EXPECT_THROW(MechanicalThresholdModel{wrong}, InputError);
  wrong = annealed_copper();
  wrong.last_hardening = 3e9;
  EXPECT_THROW(MechanicalThresholdModel{wrong}, InputError);
}

/// Shears a point of a library material at a rate of the equivalent strain and returns it.
MaterialPoints sheared(const Material& material, double rate, double strain, int steps) {
  MaterialPoints points;
  resize(points, 1);
  points.mass[0] = 1e-6;
  initialise(material, points, 0, 1);
  Matrix3 gradient = Matrix3::Zero();
  gradient(0, 1) = std::sqrt(3.0) * rate;
  const UpdateSettings settings{.time_step = strain / (rate * steps), .cell_size = 1e-3};
  for (int i = 0; i < steps; ++i) update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
  return points;
}

TEST(MechanicalThreshold, ThresholdOfAPointStartsFromTheTemperAndEvolvesWithIt) {
  const Material annealed = read_material("copper_ofhc_annealed_mts_mie_gruneisen.toml"),
                 worked = read_material("copper_ofhc_half_hard_mts_mie_gruneisen.toml");
  const auto of = [](MaterialPoints& points) { return points.history.scalar("threshold_stress")[0]; };
  const auto equivalent = [](const MaterialPoints& points) {
    return std::sqrt(1.5 * points.deviatoric_stress[0].squared_norm());
  };
  MaterialPoints soft = sheared(annealed, 1e4, 0.1, 1000), hard = sheared(worked, 1e4, 0.1, 1000),
                 elastic = sheared(worked, 1e4, 1e-4, 10), coarse = sheared(annealed, 1e4, 0.1, 100);
  EXPECT_EQ(elastic.plastic_strain[0], 0.0);
  EXPECT_DOUBLE_EQ(of(elastic), 254e6);
  EXPECT_GT(of(soft), 100e6);
  EXPECT_GT(of(hard), of(soft) + 100e6);
  EXPECT_LT(of(hard), of(soft) + 254e6);  // work hardens less what is harder
  EXPECT_GT(equivalent(hard), equivalent(soft) + 80e6);
  EXPECT_NEAR(of(coarse), of(soft), 2e-3 * of(soft));  // rate and temperature change within the path
}

}  // namespace
}  // namespace whipple
