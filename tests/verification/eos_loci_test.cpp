// SPDX-License-Identifier: BSD-3-Clause
// Loci of GRAY for copper against the figures of docs/theory/gray.md (computed there by an independent
// implementation).
#include <gtest/gtest.h>

#include <cmath>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

TEST(EosLoci, HugoniotOfGrayFollowsItsConstants) {
  // Solid to 221.8 GPa: Us = C + S up within 0.2 %; exact without electronic terms, since then only one
  // Grueneisen parameter is left.
  const GrayEos eos(copper());
  for (double P = 2e9; P <= 221e9; P += 4e9) {
    const ShockState s = Hugoniot(eos).at_pressure(P);
    ASSERT_EQ(s.state.phase, "solid");
    EXPECT_NEAR(s.shock_velocity / (3940 + 1.489 * s.particle_velocity), 1.0, 2e-3) << P;
  }
  GrayConstants bare = copper();
  bare.electronic_heat_coefficient = 0;
  const GrayEos exact(bare);
  for (double P = 2e9; P <= 200e9; P += 20e9) {
    const ShockState s = Hugoniot(exact).at_pressure(P);
    EXPECT_NEAR(s.shock_velocity / (3940 + 1.489 * s.particle_velocity), 1.0, 1e-8) << P;
  }
}

TEST(EosLoci, ThreeWaysToTheSameShockState) {
  const GrayEos eos(copper());
  const Hugoniot hugoniot(eos);
  for (double P : {1e9, 30e9, 150e9, 250e9, 400e9, 900e9}) {
    const ShockState a = hugoniot.at_pressure(P);
    const ShockState b = hugoniot.at_particle_velocity(a.particle_velocity);
    const ShockState c = hugoniot.at_density(a.state.density);
    for (const ShockState& s : {b, c}) {
      EXPECT_NEAR(s.state.pressure, P, 1e-8 * P);
      EXPECT_NEAR(s.shock_velocity, a.shock_velocity, 1e-8 * a.shock_velocity);
      EXPECT_NEAR(s.state.temperature, a.state.temperature, 1e-7 * a.state.temperature);
    }
    // Jump conditions of mass, momentum, energy.
    const double rho0 = eos.reference_density();
    EXPECT_NEAR(rho0 * a.shock_velocity, a.state.density * (a.shock_velocity - a.particle_velocity),
                1e-10 * rho0 * a.shock_velocity);
    EXPECT_NEAR(a.state.pressure, rho0 * a.shock_velocity * a.particle_velocity, 1e-10 * P);
    EXPECT_NEAR(a.state.specific_internal_energy, 0.5 * P * (1 / rho0 - 1 / a.state.density),
                1e-10 * P / rho0);
  }
}

TEST(EosLoci, ShockMeltingOfCopper) {
  const auto band = shock_melting(GrayEos(copper(MeltingTransition::band)));
  ASSERT_TRUE(band);
  EXPECT_NEAR(band->onset.state.pressure * 1e-9, 221.8, 0.5);
  EXPECT_NEAR(band->onset.state.temperature, 5698, 5);
  EXPECT_NEAR(band->completion.state.pressure * 1e-9, 286.2, 0.5);
  EXPECT_NEAR(band->completion.state.temperature, 6491, 5);
  const auto isochoric = shock_melting(GrayEos(copper(MeltingTransition::isochoric)));
  ASSERT_TRUE(isochoric);
  EXPECT_NEAR(isochoric->onset.state.pressure * 1e-9, 227.8, 0.5);
  EXPECT_NEAR(isochoric->completion.state.pressure * 1e-9, 281.0, 0.5);
  // Sound speeds on either side of both edges (isochoric): 8.336/8.239 and 8.792/8.902 km/s, known on a
  // grid of pressures of some 0.4 GPa.
  const GrayEos eos(copper(MeltingTransition::isochoric));
  const Hugoniot hugoniot(eos);
  const double onset = isochoric->onset.state.pressure, completion = isochoric->completion.state.pressure;
  EXPECT_NEAR(hugoniot.at_pressure(onset * 0.9999).state.sound_speed, 8336, 6);
  EXPECT_NEAR(hugoniot.at_pressure(onset * 1.0001).state.sound_speed, 8239, 6);
  EXPECT_NEAR(hugoniot.at_pressure(completion * 0.9999).state.sound_speed, 8792, 6);
  EXPECT_NEAR(hugoniot.at_pressure(completion * 1.0001).state.sound_speed, 8902, 6);
}

TEST(EosLoci, MeltingAndLiquidAtZeroPressure) {
  const GrayEos eos(copper());
  // Solidus and liquidus at P = 0 bracket the equilibrium melting temperature of 1327 K within 20 K.
  const auto melted = [&](double T) {
    const double rho = density_at_pressure(eos, 0.0, T);
    return eos.state_at_temperature(rho, T).melted_fraction;
  };
  EXPECT_EQ(melted(1318), 0.0);
  EXPECT_GT(melted(1321), 0.0);
  EXPECT_NEAR(melted(1327), 0.5, 0.2);
  EXPECT_LT(melted(1341), 1.0);
  EXPECT_EQ(melted(1345), 1.0);
  const double densities[][2] = {{1358, 7960}, {2000, 7610}, {2835, 7120}};
  for (const auto& row : densities) EXPECT_NEAR(density_at_pressure(eos, 0.0, row[0]), row[1], 6) << row[0];
}

TEST(EosLoci, ReleaseMeltsAboveTheKnownShockPressures) {
  // Incipient and complete melting on release to P = 0: 145.9 and 178.9 GPa with isochoric melting.
  const GrayEos eos(copper(MeltingTransition::isochoric));
  const auto melted = [&](double P) {
    return release(eos, Hugoniot(eos).at_pressure(P).state, 0.0).end.state.melted_fraction;
  };
  EXPECT_EQ(melted(145.4e9), 0.0);
  EXPECT_GT(melted(146.4e9), 0.0);
  EXPECT_LT(melted(178.4e9), 1.0);
  EXPECT_EQ(melted(179.4e9), 1.0);
  // With the band, near the equilibrium thresholds of 136.6 and 190.2 GPa.
  const GrayEos band(copper(MeltingTransition::band));
  const auto banded = [&](double P) {
    return release(band, Hugoniot(band).at_pressure(P).state, 0.0).end.state.melted_fraction;
  };
  EXPECT_EQ(banded(135e9), 0.0);
  EXPECT_GT(banded(137.5e9), 0.0);
  EXPECT_LT(banded(189e9), 1.0);
  EXPECT_EQ(banded(193e9), 1.0);
}

TEST(EosLoci, ReleaseToOneAtmosphereVaporises) {
  const GrayEos eos(copper());
  const auto vapour = [&](double P) {
    return release(eos, Hugoniot(eos).at_pressure(P).state, 1e5).end.state.vaporised_fraction;
  };
  EXPECT_LT(vapour(300e9), 1e-4);
  EXPECT_GT(vapour(304e9), 0.0);
  EXPECT_NEAR(vapour(396e9), 0.10, 0.001);
  EXPECT_NEAR(vapour(529e9), 0.20, 0.001);
  EXPECT_NEAR(vapour(1318e9), 0.50, 0.001);
  EXPECT_NEAR(Hugoniot(eos).at_pressure(302e9).particle_velocity, 3600, 5);
}

TEST(EosLoci, CriticalAndBoilingPointsOfCopper) {
  // a_y in kJ cm^3/g^2: T_c K, P_c GPa, rho_c g/cm^3, T_b(1 atm) K, latent heat at 2835 K kJ/g.
  const double table[][6] = {{0.55, 7559, 0.92, 2.60, 2216, 3.66},
                             {0.62, 8511, 1.04, 2.60, 2415, 4.00},
                             {0.70, 9595, 1.16, 2.59, 2643, 4.38},
                             {0.77, 10539, 1.28, 2.58, 2843, 4.71}};
  for (const auto& row : table) {
    GrayConstants c = copper();
    c.vapour_attraction = row[0] * 1e3;
    const Gray gray(c);
    const CriticalPoint& critical = gray.dome().critical_point();
    EXPECT_NEAR(critical.temperature, row[1], 1.0) << row[0];
    EXPECT_NEAR(critical.pressure * 1e-9, row[2], 0.006) << row[0];
    EXPECT_NEAR(1e-3 / critical.specific_volume, row[3], 0.006) << row[0];
    const auto boiling = gray.dome().at_pressure(101325);
    ASSERT_TRUE(boiling);
    EXPECT_NEAR(boiling->temperature, row[4], 1.0) << row[0];
    EXPECT_NEAR(gray.dome().at_temperature(2835)->latent_heat() * 1e-6, row[5], 0.006) << row[0];
  }
}

TEST(EosLoci, IsentropeKeepsTheEntropyThroughAllPhases) {
  // Integration of de = p/rho^2 d(rho) against the entropy of the free energy, from a liquid state at 400 GPa
  // down to the vapour, and from rest to 200 GPa.
  const GrayEos eos(copper(MeltingTransition::isochoric));
  const State hot = Hugoniot(eos).at_pressure(1500e9).state;
  for (const IsentropeState& s : isentrope(eos, hot, {14000, 11000, 9000, 7500, 6900, 6000, 3000, 500, 50})) {
    EXPECT_NEAR(s.state.specific_entropy, hot.specific_entropy, 1e-4) << s.state.density;
  }
  const State rest = eos.state_at_temperature(eos.reference_density(), 300);
  for (const IsentropeState& s : isentrope(eos, rest, {9500, 11000, 13000})) {
    EXPECT_NEAR(s.state.specific_entropy, rest.specific_entropy, 1e-6);
    EXPECT_GT(s.riemann_velocity, 0);
  }
  // There and back.
  const auto there = isentrope(eos, rest, {12000});
  const auto back = isentrope(eos, there[0].state, {eos.reference_density()});
  EXPECT_NEAR(back[0].state.specific_internal_energy, rest.specific_internal_energy, 1e-2);
}

TEST(EosLoci, BeyondTheRangeTheErrorSaysWhere) {
  const GrayEos eos(copper());
  const Hugoniot hugoniot(eos);
  EXPECT_THROW(static_cast<void>(hugoniot.at_pressure(1e14)), StateError);
  EXPECT_THROW(static_cast<void>(hugoniot.at_pressure(-1e9)), StateError);
  EXPECT_THROW(static_cast<void>(hugoniot.at_density(8000)), StateError);
  EXPECT_THROW(static_cast<void>(hugoniot.at_density(1.01 * eos.maximum_density())), StateError);
  EXPECT_THROW(density_at_pressure(eos, 0.0, 9000), StateError);  // above the critical temperature
  EXPECT_THROW(density_at_pressure(eos, 1e14, 300), StateError);
  EXPECT_THROW(release(eos, hugoniot.at_pressure(100e9).state, -1e11), StateError);
  EXPECT_FALSE(shock_melting(MieGruneisenEos(aluminium_2024())));
}

TEST(EosLoci, StateAtPressureAndDensityInvertsTheModel) {
  const GrayEos eos(copper());
  for (double e : {2e5, 9e5, 3e6}) {
    const State s = eos.state(9500, e);
    EXPECT_NEAR(state_at_pressure(eos, 9500, s.pressure).specific_internal_energy, e, 1e-8 * e);
  }
}

}  // namespace
}  // namespace whipple::eos::test
