// SPDX-License-Identifier: BSD-3-Clause
// Crushing of pores: the three regions of Holmquist, Johnson and Cook, the power of RHT, bulked material.
#include <gtest/gtest.h>

#include <cmath>

#include "eos/identities.hpp"
#include "eos/loci/hugoniot.hpp"
#include "eos/loci/isentrope.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/holmquist_johnson_cook.hpp"
#include "eos/modifiers/distended.hpp"
#include "eos/modifiers/p_alpha.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using Concrete = ModelEquationOfState<HolmquistJohnsonCook>;

/// Concrete of 48 MPa, Holmquist, Johnson and Cook (1993).
HolmquistJohnsonCookConstants concrete() {
  return {.reference_density = 2440,
          .crush_pressure = 16e6,
          .crush_compression = 0.001,
          .lock_pressure = 0.8e9,
          .lock_compression = 0.1,
          .K1 = 85e9,
          .K2 = -171e9,
          .K3 = 208e9,
          .heat_capacity = 880};
}

/// One point that keeps its past.
struct Point {
  const EquationOfState& eos;
  double distension = eos.initial_distension(), energy = 0;
  double pressure = 0, temperature = 0, sound_speed = 0;

  RangeReport at(double mu) {
    const double density = 2440 * (1 + mu);
    return eos.evaluate({{&density, 1},
                         {&energy, 1},
                         {&pressure, 1},
                         {&temperature, 1},
                         {&sound_speed, 1},
                         {},
                         {},
                         {&distension, 1}});
  }
};

TEST(EosConcrete, VirginLoadingPassesThePublishedCornersAndEndsOnTheCurveOfTheGrains) {
  const Concrete eos(concrete());
  const double lock = eos.underlying().locked_compression();
  EXPECT_EQ(eos.initial_distension(), 1.1);
  EXPECT_NEAR(eos.state(2440 * 1.0005, 0).pressure, 8e6, 1);
  EXPECT_NEAR(eos.state(2440 * 1.001, 0).pressure, 16e6, 1);
  EXPECT_NEAR(eos.state(2440 * (1 + lock), 0).pressure, 0.8e9, 10);
  EXPECT_NEAR(eos.state(2440 * (1 + 0.5 * (0.001 + lock)), 0).pressure, 0.5 * (16e6 + 0.8e9), 10);
  const double m = 0.05, mu = 0.1 + m * 1.1;
  EXPECT_NEAR(eos.state(2440 * (1 + mu), 0).pressure, 85e9 * m - 171e9 * m * m + 208e9 * m * m * m, 1);
  EXPECT_NEAR(eos.state(2440 * 0.999, 0).pressure, -16e6, 1);  // elastic in tension
  EXPECT_EQ(eos.state(2440 * 1.0005, 0).phase, "solid");
  EXPECT_EQ(eos.state(2440 * 1.05, 0).phase, "compacting");
  EXPECT_EQ(eos.state(2440 * (1 + mu), 0).distension, 1.0);
  double before = -1e9;
  for (double x = -0.002; x < 0.3; x += 1e-4) {
    const double p = eos.state(2440 * (1 + x), 0).pressure;
    ASSERT_GT(p, before) << x;
    before = p;
  }
}

TEST(EosConcrete, UnloadsOnTheInterpolatedLineAndReloadsToWhereItLeft) {
  const Concrete eos(concrete());
  const double lock = eos.underlying().locked_compression(), last = 0.8e9 / (lock - 0.1);
  for (const double share : {0.1, 0.5, 0.9}) {
    Point point{eos};
    const double mu = 0.001 + share * (lock - 0.001), greatest = 16e6 + share * (0.8e9 - 16e6);
    point.at(mu);
    EXPECT_NEAR(point.pressure, greatest, 1);
    const double modulus = (1 - share) * 16e9 + share * last;
    const double crushed = point.distension;
    EXPECT_NEAR(1.1 / crushed - 1, mu - greatest / modulus, 1e-12);  // compression at rest
    EXPECT_NEAR(point.sound_speed, std::sqrt(modulus / 2440), 1e-6);
    for (const double back : {0.2, 0.7, 1.0, 1.3}) {
      const double at = mu - back * greatest / modulus;
      point.at(at);
      EXPECT_NEAR(point.pressure, (1 - back) * greatest, 1e-6 * greatest) << share << " " << back;
      EXPECT_EQ(point.distension, crushed);
    }
    point.at(mu);
    EXPECT_NEAR(point.pressure, greatest, 1e-6 * greatest);
    point.at(mu + 1e-3);  // and further along the line of crushing
    EXPECT_NEAR(point.pressure, greatest + 1e-3 * (0.8e9 - 16e6) / (lock - 0.001), 1e-6 * greatest);
    EXPECT_LT(point.distension, crushed);
  }
  Point point{eos};
  point.at(0.3);
  point.at(0.1);  // the grains unload along their own curve
  EXPECT_NEAR(point.pressure, 0, 1e-3);
}

TEST(EosConcrete, ACycleHeatsByItsAreaAndReturnsTheRest) {
  const Concrete eos(concrete());
  Point point{eos};
  const int steps = 40000;
  const double top = 0.14;  // locked
  double work = 0, before = 0, volume = 1 / 2440.0;
  const auto go = [&](double mu) {
    const double next = 1 / (2440 * (1 + mu));
    point.at(mu);
    work -= 0.5 * (point.pressure + before) * (next - volume);
    before = point.pressure;
    volume = next;
    point.energy = work;
  };
  for (int i = 1; i <= steps; ++i) go(top * i / steps);
  const double stored = work;
  for (int i = 1; i <= steps; ++i) go(top + (0.1 - top) * i / steps);
  point.at(0.1);
  EXPECT_NEAR(point.pressure, 0, 1);
  EXPECT_NEAR(point.temperature, 300 + work / 880, 1e-6);
  EXPECT_GT(work, 0.3 * stored);
  // Trapezoids of the loading below the grains' curve: what unloading does not give back.
  const double lock = eos.underlying().locked_compression();
  double area = 0;
  for (int i = 0; i < steps; ++i) {
    const double mu = lock * (i + 0.5) / steps;
    const double p = mu < 0.001 ? 16e9 * mu : 16e6 + (mu - 0.001) * (0.8e9 - 16e6) / (lock - 0.001);
    area += p / (2440 * (1 + mu) * (1 + mu)) * lock / steps;
  }
  for (int i = 0; i < steps; ++i) {
    const double m = (lock - 0.1) / 1.1 * (i + 0.5) / steps;
    area -= (85e9 * m - 171e9 * m * m + 208e9 * m * m * m) / (2684 * (1 + m) * (1 + m)) * (lock - 0.1) / 1.1 /
            steps;
  }
  EXPECT_NEAR(work, area, 1e-4 * area);
}

TEST(EosConcrete, KeepsTheIdentitiesAwayFromCrushing) {
  const Concrete eos(concrete());
  for (const double mu : {-0.0005, 0.0004, 0.15, 0.25}) {
    const State s = eos.state_at_temperature(2440 * (1 + mu), 400);
    EXPECT_LT(check_identities(eos, s.density, s.specific_internal_energy).largest(), 1e-6) << mu;
  }
  const State half = eos.state_at_temperature(2440 * 1.05, 400);
  const auto released = eos.unloading(half);
  ASSERT_NE(released, nullptr);
  const State s = released->state(half.density * 0.995, half.specific_internal_energy);
  EXPECT_LT(s.pressure, half.pressure);
  EXPECT_EQ(s.distension, half.distension);
  EXPECT_LT(check_identities(*released, s.density, s.specific_internal_energy).largest(), 1e-6);
  EXPECT_NEAR(released->state(released->reference_density(), 0).pressure, 0, 1e-3);
}

TEST(EosConcrete, HugoniotFollowsThePressureCurveAndHeatsByTheJump) {
  // The pressure does not depend on the energy: the Hugoniot is the loading curve, in closed form.
  const Concrete eos(concrete());
  const Hugoniot hugoniot(eos);
  for (const double mu : {0.02, 0.08, 0.2}) {
    const ShockState shock = hugoniot.at_density(2440 * (1 + mu));
    const double p = eos.state(2440 * (1 + mu), 0).pressure, jump = mu / (1 + mu) / 2440;
    EXPECT_NEAR(shock.state.pressure, p, 1e-9 * p);
    EXPECT_NEAR(shock.particle_velocity, std::sqrt(p * jump), 1e-9);
    EXPECT_NEAR(shock.shock_velocity, std::sqrt(p / jump) / 2440, 1e-6);
    EXPECT_GT(shock.state.temperature, 300);
  }
  // Release of the locked shock ends at the density of the grains.
  const auto end = release(eos, hugoniot.at_density(2440 * 1.2).state, 0);
  EXPECT_NEAR(end.end.state.density, 2440 * 1.1, 1e-3);
}

TEST(EosConcrete, BatchAgreesWithStatesAndReportsWhatIsOutOfRange) {
  const Concrete eos(concrete());
  std::vector<double> rho, e, p, T, c, melted, vapour;
  for (int i = 0; i < 600; ++i) {
    rho.push_back(2440 * (0.99 + 0.0008 * i));
    e.push_back(1e4 * (i % 7));
  }
  for (auto* v : {&p, &T, &c, &melted, &vapour}) v->resize(600, -1);
  EXPECT_EQ(eos.evaluate({rho, e, p, T, c, melted, vapour}).out_of_range, 0u);
  for (std::size_t i = 0; i < 600; i += 37) {
    const State s = eos.state(rho[i], e[i]);
    EXPECT_EQ(p[i], s.pressure);
    EXPECT_EQ(T[i], s.temperature);
    EXPECT_EQ(c[i], s.sound_speed);
    EXPECT_EQ(melted[i] + vapour[i], 0.0);
  }
  rho[7] = 1e5;
  rho[3] = std::nan("");
  const RangeReport report = eos.evaluate({rho, e, p, T, c, melted, vapour});
  EXPECT_EQ(report.out_of_range, 2u);
  EXPECT_EQ(report.first, 3u);
  EXPECT_TRUE(std::isnan(p[7]));
  EXPECT_THROW(static_cast<void>(eos.state(1e5, 0)), StateError);
  EXPECT_THROW(static_cast<void>(eos.state_at_temperature(2440, 0)), StateError);
  Point cold{eos, 1.1, -1e9};
  EXPECT_EQ(cold.at(0).below_cold_curve, 1u);
  EXPECT_EQ(cold.temperature, 1.0);
}

TEST(EosConcrete, RefusesConstantsThatContradictOneAnother) {
  const auto with = [](double HolmquistJohnsonCookConstants::* member, double value) {
    HolmquistJohnsonCookConstants c = concrete();
    c.*member = value;
    return c;
  };
  using C = HolmquistJohnsonCookConstants;
  EXPECT_NO_THROW(Concrete{concrete()});
  EXPECT_THROW(Concrete(with(&C::lock_pressure, 1e6)), InputError);       // below the crush pressure
  EXPECT_THROW(Concrete(with(&C::crush_compression, 0.2)), InputError);   // beyond the lock compression
  EXPECT_THROW(Concrete(with(&C::crush_compression, 0.05)), InputError);  // softer than the line of crushing
  EXPECT_THROW(Concrete(with(&C::K2, -1e13)), InputError);                // never reaches the lock pressure
}

TEST(EosPAlphaPower, TheExponentTwoIsTheQuadraticCurveAndThreeIsThatOfRht) {
  const auto solid = std::make_shared<DebyeEos>(debye_copper());
  const PAlphaConstants square = {.distension = 1.2, .elastic_pressure = 1e8, .solid_pressure = 2e9};
  PAlphaConstants power = square;
  power.compaction = CompactionCurve::power;
  EXPECT_THROW(PAlpha(solid, power), InputError);  // needs the exponent
  power.compaction_exponent = 2;
  PAlphaConstants wrong = square;
  wrong.compaction_exponent = 3;
  EXPECT_THROW(PAlpha(solid, wrong), InputError);  // belongs to the power
  const PAlpha a(solid, square), b(solid, power);
  power.compaction_exponent = 3;
  const PAlpha cubic(solid, power);
  for (const double p : {0.05e9, 0.3e9, 1e9, 1.9e9, 2.5e9}) {
    EXPECT_EQ(a.distension_at(p), b.distension_at(p));
    const double open = std::clamp((2e9 - p) / 1.9e9, 0.0, 1.0);
    EXPECT_NEAR(cubic.distension_at(p), 1 + 0.2 * open * open * open, 1e-14);
    if (p > 0.1e9 && p < 2e9) {
      EXPECT_NEAR(cubic.PAlpha::crush_pressure(cubic.distension_at(p)), p, 1e-6 * p);
    }
  }
  const std::vector<double> distension = {1.2, 1.05, 1.0};
  std::vector<double> pressure(3);
  static_cast<const EquationOfState&>(cubic).crush_pressure(distension, pressure);
  EXPECT_EQ(pressure[0], 1e8);
  EXPECT_EQ(pressure[1], cubic.PAlpha::crush_pressure(1.05));
  EXPECT_TRUE(std::isinf(pressure[2]));
}

TEST(EosDistended, BulkedMatterHasThePressureOfItsMatterOverTheDistension) {
  const auto solid = std::make_shared<DebyeEos>(debye_copper());
  const Distended eos(solid);
  EXPECT_EQ(eos.initial_distension(), 1.0);
  std::vector<double> rho(600, 8900), e(600, 1e5), p(600), T(600), c(600), melted(600), vapour(600),
      alpha(600);
  for (std::size_t i = 0; i < 600; ++i) alpha[i] = 1 + 1e-5 * static_cast<double>(i);
  const std::vector<double> kept = alpha;
  EXPECT_EQ(eos.evaluate({rho, e, p, T, c, melted, vapour, alpha}).out_of_range, 0u);
  EXPECT_EQ(alpha, kept);
  for (std::size_t i : {0u, 255u, 256u, 599u}) {
    const State s = solid->state(8900 * alpha[i], 1e5);
    EXPECT_NEAR(p[i], s.pressure / alpha[i], 1e-9 * std::abs(s.pressure) + 1);
    EXPECT_NEAR(T[i], s.temperature, 1e-9 * s.temperature);
  }
}

}  // namespace
}  // namespace whipple::eos::test
