// SPDX-License-Identifier: BSD-3-Clause
// The loci take no solid for granted: an ideal gas, against closed forms (Courant and Friedrichs, Supersonic
// Flow and Shock Waves, 1948).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "eos/audit.hpp"
#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_impact_constants.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using Gas = ModelEquationOfState<IdealGas>;

const double g = air().heat_capacity_ratio;
const double rho0 = air().reference_density;

TEST(EosGasLoci, HugoniotFollowsTheMachNumber) {
  const Gas gas(air());
  const Hugoniot hugoniot(gas);
  const double c = hugoniot.initial().sound_speed, p0 = hugoniot.initial().pressure;
  for (const double mach : {1.0001, 1.1, 2.0, 5.0, 30.0}) {
    const double up = 2 * c / (g + 1) * (mach - 1 / mach);
    const double p = p0 * (1 + 2 * g / (g + 1) * (mach * mach - 1));
    const double rho = rho0 * (g + 1) * mach * mach / ((g - 1) * mach * mach + 2);
    for (const ShockState& s :
         {hugoniot.at_particle_velocity(up), hugoniot.at_pressure(p), hugoniot.at_density(rho)}) {
      EXPECT_NEAR(s.shock_velocity / (mach * c), 1.0, 1e-7) << mach;
      EXPECT_NEAR(s.state.pressure / p, 1.0, 1e-7) << mach;
      EXPECT_NEAR(s.state.density / rho, 1.0, 1e-7) << mach;
    }
  }
  // No shock compresses beyond (gamma + 1)/(gamma - 1) = 6.
  EXPECT_THROW(static_cast<void>(hugoniot.at_density(6.01 * rho0)), StateError);
}

TEST(EosGasLoci, ReflectionOffAWall) {
  // p3/p2 = [(3 gamma - 1) p2 - (gamma - 1) p1]/[(gamma - 1) p2 + (gamma + 1) p1]
  const Gas gas(air());
  const Hugoniot hugoniot(gas);
  const double p1 = hugoniot.initial().pressure;
  for (const double ratio : {1.01, 3.0, 100.0}) {
    const ShockState first = hugoniot.at_pressure(ratio * p1);
    const double p2 = ratio * p1;
    const double p3 = p2 * ((3 * g - 1) * p2 - (g - 1) * p1) / ((g - 1) * p2 + (g + 1) * p1);
    EXPECT_NEAR(reflected_at_wall(gas, first).state.pressure / p3, 1.0, 1e-7) << ratio;
  }
}

TEST(EosGasLoci, IsentropeAndRiemannVelocity) {
  const Gas gas(air());
  const State start = gas.state_at_temperature(100, 2000);
  for (const double ratio : {1e-6, 1e-3, 0.5, 30.0}) {
    const IsentropeState s = isentrope_at_pressure(gas, start, ratio * start.pressure);
    EXPECT_NEAR(s.state.density / (start.density * std::pow(ratio, 1 / g)), 1.0, 1e-8) << ratio;
    EXPECT_NEAR(s.riemann_velocity, 2 / (g - 1) * (s.state.sound_speed - start.sound_speed),
                1e-7 * start.sound_speed);
    EXPECT_FALSE(release(gas, start, ratio * start.pressure).in_equilibrium);
  }
}

TEST(EosGasLoci, InversionsOverManyDecades) {
  const Gas gas(air());
  for (const double density : {1e-8, 1e-3, 1.2, 100.0, 1000.0}) {
    for (const double T : {5.0, 300.0, 1e5}) {
      const State s = gas.state_at_temperature(density, T);
      EXPECT_NEAR(state_at_pressure_and_temperature(gas, s.pressure, T).density / density, 1, 1e-9);
      EXPECT_NEAR(state_at_pressure(gas, density, s.pressure).temperature / T, 1, 1e-9);
      EXPECT_NEAR(state_at_entropy(gas, density, s.specific_entropy).temperature / T, 1, 1e-9);
    }
  }
  // No pressure, no density.
  EXPECT_THROW(state_at_pressure_and_temperature(gas, 0.0, 300), StateError);
  EXPECT_THROW(isentrope_at_pressure(gas, gas.state_at_temperature(1, 300), 0.0), StateError);
}

TEST(EosGasLoci, ImpactOfAMetalOnAGas) {
  const Gas gas(air());
  const GrayEos metal(copper());
  const ImpedanceMatch match = match_impact(Hugoniot(metal), Hugoniot(gas), 3000);
  // The gas hardly slows the metal: strong shock, p = (gamma + 1)/2 rho0 u^2.
  EXPECT_NEAR(match.velocity, 3000, 2);
  EXPECT_NEAR(match.pressure / (0.5 * (g + 1) * rho0 * match.velocity * match.velocity), 1.0, 0.02);
  EXPECT_NEAR(match.left.pressure / match.right.pressure, 1, 1e-3);
}

TEST(EosGasLoci, NothingSolidIsFound) {
  const Gas gas(air());
  EXPECT_FALSE(melting_point(gas, 1e5));
  EXPECT_FALSE(shock_melting(gas));
  EXPECT_THROW(cold_curve(gas), StateError);
  const Audit a = audit(gas);
  EXPECT_EQ(a.summary(), "sound");
  EXPECT_FALSE(a.condensed);
  EXPECT_FALSE(a.cold || a.melting || a.critical);
}

}  // namespace
}  // namespace whipple::eos::test
