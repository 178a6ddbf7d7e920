// SPDX-License-Identifier: BSD-3-Clause
// Equilibrium melting of GRAY (docs/theory/gray.md, section 3): common tangent, published figures of an
// independent implementation, measured melting points, the policy in tension.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

TEST(EosGrayMelting, TangentHasEqualPressureAndGibbsEnergyAndTheSlopeOfClausiusAndClapeyron) {
  for (GrayConstants c : {copper(MeltingTransition::equilibrium), aluminium()}) {
    const GrayFreeEnergy f(c);
    const GrayMeltingCurve curve(f);
    const double T1 = curve.coldest().temperature, T2 = curve.hottest().temperature;
    for (int i = 1; i < 400; ++i) {
      const double T = T1 + 0.8 * (T2 - T1) * i / 400;  // between the nodes of the table
      const auto t = curve.at_temperature(T);
      const GrayPoint s = f.solid(t.solid_volume, T), l = f.liquid(t.liquid_volume, T);
      const double stiffness = -t.solid_volume * s.pressure_by_volume;
      EXPECT_NEAR(s.pressure, l.pressure, 1e-7 * stiffness) << T;
      EXPECT_NEAR(s.pressure, t.pressure, 1e-7 * stiffness) << T;
      const double latent = T * (l.entropy - s.entropy);
      EXPECT_GT(latent, 0);
      EXPECT_NEAR(s.gibbs(t.solid_volume, T), l.gibbs(t.liquid_volume, T), 1e-6 * latent) << T;
      const double h = 1e-3 * T;
      const double slope =
          (curve.at_temperature(T + h).pressure - curve.at_temperature(T - h).pressure) / (2 * h);
      EXPECT_NEAR(slope * T * (t.liquid_volume - t.solid_volume) / latent, 1.0, 1e-5) << T;
    }
  }
}

TEST(EosGrayMelting, CopperMeltsAtTheFiguresOfAnIndependentImplementation) {
  const GrayEos eos(copper(MeltingTransition::equilibrium));
  const GrayMeltingCurve& curve = eos.underlying().melting_curve().value();
  const double line[][2] = {{0, 1327}, {10, 1672}, {50, 2757}, {200, 5407}};
  for (const auto& row : line) EXPECT_NEAR(curve.at_pressure(row[0] * 1e9).temperature, row[1], 0.6);
  // Fusion at the measured melting point, 1358 K: dV/V 5.4 % (measured 4 to 5), 0.235 kJ/g (0.205).
  const auto t = curve.at_temperature(1358);
  EXPECT_NEAR(t.liquid_volume / t.solid_volume - 1, 0.054, 0.0005);
  const GrayFreeEnergy& f = eos.underlying().free_energy();
  EXPECT_NEAR(1358 * (f.liquid(t.liquid_volume, 1358).entropy - f.solid(t.solid_volume, 1358).entropy),
              0.235e6, 0.0005e6);
  const auto shock = shock_melting(eos).value();
  EXPECT_NEAR(shock.onset.state.pressure * 1e-9, 221.9, 0.06);
  EXPECT_NEAR(shock.onset.state.temperature, 5702, 1);
  EXPECT_NEAR(shock.completion.state.pressure * 1e-9, 285.9, 0.06);
  EXPECT_NEAR(shock.completion.state.temperature, 6481, 1);
  const auto melted = [&](double P) {
    return release(eos, Hugoniot(eos).at_pressure(P * 1e9).state, 0.0).end.state.melted_fraction;
  };
  EXPECT_EQ(melted(136.5), 0.0);
  EXPECT_GT(melted(136.7), 0.0);
  EXPECT_LT(melted(190.1), 1.0);
  EXPECT_EQ(melted(190.3), 1.0);
}

TEST(EosGrayMelting, AmbientMeltingPointsFollowFromSteinbergsConstantsAlone) {
  // UCRL-MA-106439 (1996): g/mol, g/cm^3, km/s, S, gamma0, a, T_m0; g_e = 0, nothing adjusted. Then T_m(P =
  // 0) of an independent implementation and the measured melting point.
  struct Metal {
    const char* name;
    double M, rho, C, S, gamma, a, Tm0, model, measured;
  };
  const Metal metals[] = {{"Al 1100", 26.9815, 2.707, 5.386, 1.339, 1.97, 1.5, 1220, 964, 933},
                          {"Ni", 58.693, 8.9, 4.65, 1.445, 1.93, 1.4, 2330, 1729, 1728},
                          {"W", 183.84, 19.3, 4.03, 1.237, 1.67, 1.3, 4520, 3720, 3695},
                          {"Zn", 65.38, 7.139, 3.03, 1.55, 2.24, 1.7, 900, 688, 693},
                          {"Cd", 112.41, 8.639, 2.48, 1.64, 2.50, 1.95, 770, 607, 594},
                          {"Ta", 180.948, 16.69, 3.41, 1.20, 1.67, 1.3, 4340, 3350, 3290},
                          {"Au", 196.967, 19.3, 3.08, 1.56, 2.99, 2.4, 1970, 1340, 1337},
                          {"Mo", 95.95, 10.2, 5.143, 1.255, 1.59, 1.3, 3660, 3098, 2896},
                          {"V", 50.9415, 6.1, 5.077, 1.201, 1.40, 1.2, 2640, 2223, 2183},
                          {"Mg", 24.305, 1.78, 4.52, 1.242, 1.54, 1.2, 1150, 935, 923},
                          {"Nb", 92.906, 8.59, 4.44, 1.207, 1.66, 1.3, 3530, 2784, 2750},
                          {"Ag", 107.868, 10.49, 3.27, 1.55, 2.40, 1.8, 1604, 1155, 1235},
                          {"Pt", 195.084, 21.44, 3.64, 1.54, 2.74, 2.2, 2840, 1980, 2041},
                          {"U", 238.029, 19.05, 2.48, 1.53, 2.32, 1.8, 1710, 1308, 1408}};
  double sum = 0;
  for (const Metal& m : metals) {
    GrayConstants c;
    c.molar_mass = m.M * 1e-3;
    c.reference_specific_volume = 1e-3 / m.rho;
    c.hugoniot_intercept = m.C * 1e3;
    c.hugoniot_slope = m.S;
    c.gruneisen = m.gamma;
    c.gruneisen_slope = m.a;
    c.electronic_heat_coefficient = 0;
    c.melting_temperature = m.Tm0;
    c.join_volume_ratio = 1.2;
    c.vapour_attraction = 1000;  // the vapour has no part in this
    const double T = GrayMeltingCurve(GrayFreeEnergy(c)).at_pressure(0).temperature;
    EXPECT_NEAR(T, m.model, 1.0) << m.name;
    sum += std::pow(T / m.measured - 1, 2);
  }
  EXPECT_LT(std::sqrt(sum / std::size(metals)), 0.040);
}

TEST(EosGrayMelting, SolidMixtureAndLiquidMeetAtTheirEdges) {
  for (GrayConstants c : {copper(), aluminium()}) {
    c.melting = MeltingTransition::equilibrium;
    const Gray gray(c);
    const GrayMeltingCurve& curve = gray.melting_curve().value();
    const GrayFreeEnergy& f = gray.free_energy();
    const double V0 = c.reference_specific_volume;
    for (double ratio = 0.42; ratio < 1.29; ratio += 0.003) {
      const double V = ratio * V0;
      const GrayIsochore iso = f.isochore(V);
      std::vector<double> edges = {f.liquid_branch(iso).energy(curve.liquidus(V))};
      if (V < curve.coldest().solid_volume) edges.push_back(iso.solid.energy(curve.solidus(V)));
      for (const double E : edges) {
        const double h = 1e-8 * std::abs(E) + 1e-2;
        const State a = gray.state(1 / V, E - h), b = gray.state(1 / V, E + h);
        EXPECT_NE(a.phase, b.phase) << ratio;
        const double stiffness = a.density * b.sound_speed * b.sound_speed;
        EXPECT_NEAR(a.pressure, b.pressure, 1e-6 * stiffness) << ratio << a.phase;
        EXPECT_NEAR(a.temperature, b.temperature, 1e-6 * a.temperature) << ratio << a.phase;
        EXPECT_NEAR(a.specific_entropy, b.specific_entropy, 1e-4) << ratio << a.phase;
        EXPECT_NEAR(a.melted_fraction, b.melted_fraction, 1e-5) << ratio << a.phase;
      }
    }
  }
}

TEST(EosGrayMelting, BeyondTheLastTieLineInTensionTheJumpIsSmallAndTheEntropyRises) {
  // The tangent is followed until the liquid reaches V_J: copper -12.0 GPa, 799 K, V_s = 1.20 V0. On the
  // isochores beyond that solid, melting below the tie line is isochoric; crossing the line changes P by
  // less than 0.5 GPa and T by less than 75 K.
  const Gray gray(copper(MeltingTransition::equilibrium));
  const auto& last = gray.melting_curve()->coldest();
  const double V0 = 0.1118e-3;
  EXPECT_NEAR(last.liquid_volume / V0, 1.3, 1e-9);
  EXPECT_NEAR(last.solid_volume / V0, 1.2005, 0.001);
  EXPECT_NEAR(last.temperature, 799, 1);
  EXPECT_NEAR(last.pressure * 1e-9, -12.02, 0.03);
  for (int i = 1; i < 200; ++i) {
    const double V = last.solid_volume + (last.liquid_volume - last.solid_volume) * i / 200;
    const double E = gray.melting_curve()->mixture(V, last.temperature).energy;
    const State a = gray.state(1 / V, E - 1.0), b = gray.state(1 / V, E + 1.0);
    EXPECT_EQ(b.phase, "melting");
    EXPECT_NEAR(a.pressure, b.pressure, 0.5e9) << V / V0 << a.phase;
    EXPECT_NEAR(a.temperature, b.temperature, 75) << V / V0 << a.phase;
    EXPECT_GT(b.specific_entropy, a.specific_entropy);
  }
}

TEST(EosGrayMelting, CompressionLimitIsTheDensestLiquidInEquilibrium) {
  const Gray gray(copper(MeltingTransition::equilibrium));
  const auto& limit = gray.melting_curve()->hottest();
  EXPECT_NEAR(limit.solid_volume, gray.free_energy().least_volume(), 1e-9 * limit.solid_volume);
  EXPECT_DOUBLE_EQ(gray.maximum_density(), 1 / limit.liquid_volume);
  EXPECT_THROW(static_cast<void>(gray.state(1.0001 * gray.maximum_density(), 1e8)), StateError);
}

// Where gamma falls steeply, solid and liquid reach the same volume below the solid's compression limit, and dP/dT
// grows without bound: the curve ends before that.
TEST(EosGrayMelting, CurveEndsWhereThePhasesMeet) {
  GrayConstants c;
  c.molar_mass = 58.693e-3;
  c.reference_specific_volume = 0.11311e-3;
  c.hugoniot_intercept = 4905;
  c.hugoniot_slope = 1.196;
  c.gruneisen = 2.785;
  c.gruneisen_slope = 9.075;
  c.anharmonic_heat_coefficient = 1.48e-3;
  c.melting_temperature = 2330;
  c.join_volume_ratio = 1.15;
  c.vapour = VapourCondition::boiling;
  c.boiling_temperature = 3186;
  c.reference_temperature = 293;
  c.melting = MeltingTransition::equilibrium;
  const GrayEos eos(c);
  const auto& end = eos.underlying().melting_curve()->hottest();
  EXPECT_GT(end.solid_volume, 1.01 * eos.underlying().free_energy().least_volume());
  for (double density = 8850; density < 1 / end.liquid_volume; density += 25) {
    for (double energy = 0; energy < 4e6; energy += 5e4) {
      const double p = eos.state(density, energy).pressure;
      ASSERT_LT(p, 200e9) << density << " kg/m^3, " << energy << " J/kg";
    }
  }
  EXPECT_THROW(static_cast<void>(Hugoniot(eos).at_particle_velocity(2123)), StateError);
}

TEST(EosGrayMelting, ConstantsWithoutATangentAreRefused) {
  GrayConstants c = copper(MeltingTransition::equilibrium);
  c.melting_gruneisen = 0.2;  // melting temperature falls with compression: the liquid would be the denser
  c.melting_gruneisen_slope = 0;
  EXPECT_THROW(
      try { Gray{c}; } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("melting_gruneisen"), std::string::npos) << error.what();
        throw;
      },
      InputError);
}

}  // namespace
}  // namespace whipple::eos::test
