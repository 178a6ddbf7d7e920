// SPDX-License-Identifier: BSD-3-Clause
// GRAY does what docs/theory/gray.md says: values of an independent implementation, continuity at every
// joint, named policies at the edges of its range.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "eos/catalogue.hpp"
#include "src/core/base/error.hpp"
#include "tests/folders.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

TEST(EosGray, AgreesWithAnIndependentImplementationToNineDigits) {
  const Gray gray(copper(MeltingTransition::isochoric));
  const auto rows = read_csv(whipple::tests::source_folder() + "/tests/data/eos/gray_golden_cu.csv");
  int compared = 0;
  for (const auto& row : rows) {
    if (row[0] != "C") continue;
    ++compared;
    const double rho = 1 / (std::stod(row[2]) * 0.1118e-3);
    const double T = std::stod(row[3]), P = std::stod(row[4]) * 1e9, E = std::stod(row[5]) * 1e6;
    const State s = row[1] == "VT" ? gray.state_at_temperature(rho, T) : gray.state(rho, E);
    const std::string where = row[1] + " V/V0 " + row[2] + " T " + row[3];
    // The reference state itself is P = E = 0: there the scale is that of a tenth of a kelvin.
    EXPECT_NEAR(s.pressure, P, 1e-9 * std::abs(P) + 1e-3) << where;
    EXPECT_NEAR(s.specific_internal_energy, E, 1e-9 * std::abs(E) + 1e-6) << where;
    EXPECT_NEAR(s.temperature, T, 1e-9 * T) << where;
    if (row.size() > 7 && !row[7].empty()) {
      EXPECT_NEAR(s.melted_fraction, std::stod(row[7]), 2e-9) << where;
    }
  }
  EXPECT_EQ(compared, 93);
}

TEST(EosGray, BatchEqualsSinglePoints) {
  for (const auto& [melting, word] : words(MeltingTransition{})) {
    const GrayEos eos(copper(melting));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr std::size_t n = 4000;
    std::vector<double> rho(n), e(n), P(n), T(n), c(n), melted(n), vapour(n);
    for (std::size_t i = 0; i < n; ++i) {
      rho[i] = eos.reference_density() * std::exp(std::log(1e-3) + uniform(random) * std::log(2.5e3));
      e[i] = 1.5e7 * std::pow(uniform(random), 3);
    }
    const RangeReport report = eos.evaluate({rho, e, P, T, c, melted, vapour});
    EXPECT_EQ(report.out_of_range, 0u);
    for (std::size_t i = 0; i < n; ++i) {
      const State s = eos.state(rho[i], e[i]);
      ASSERT_EQ(P[i], s.pressure);
      ASSERT_EQ(T[i], s.temperature);
      ASSERT_EQ(c[i], s.sound_speed);
      ASSERT_EQ(melted[i], s.melted_fraction);
      ASSERT_EQ(vapour[i], s.vaporised_fraction);
    }
  }
}

TEST(EosGray, EnergyToTemperatureAndBackIsExact) {
  const Gray gray(copper());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double V = 0.1118e-3 * std::exp(std::log(0.36) + uniform(random) * std::log(100 / 0.36));
    const double T = std::exp(std::log(2.0) + uniform(random) * std::log(5e4 / 2.0));
    const State there = gray.state_at_temperature(1 / V, T);
    const State back = gray.state(1 / V, there.specific_internal_energy);
    // Round-off of E against the heat capacity limits T at low temperature.
    const double tolerance =
        1e-12 * T + 4e-16 * std::abs(there.specific_internal_energy) / there.heat_capacity * 4;
    ASSERT_NEAR(back.temperature, T, tolerance) << "V/V0 " << V / 0.1118e-3 << " " << there.phase;
    ASSERT_EQ(back.phase, there.phase);
  }
}

TEST(EosGray, PressureEnergyAndEntropyAreContinuousAtEveryJoint) {
  for (const MeltingTransition melting : {MeltingTransition::band, MeltingTransition::isochoric}) {
    const Gray gray(copper(melting));
    const GrayFreeEnergy& f = gray.free_energy();
    for (double ratio : {0.4, 0.5, 0.62, 0.8, 1.0, 1.15, 1.29}) {
      const double V = ratio * 0.1118e-3;
      const GrayIsochore iso = f.isochore(V);
      const GrayBand band = f.band(iso);
      const double hot = 9.38 * iso.melting_temperature;
      // Both edges of the band and T_G: from either side in energy.
      const double edges[] = {band.E1, band.E2, f.liquid_branch(iso).energy(hot)};
      for (const double E : edges) {
        const double h = 1e-9 * std::abs(E) + 1e-3;
        const State a = gray.state(1 / V, E - h), b = gray.state(1 / V, E + h);
        EXPECT_NE(a.phase, b.phase) << ratio;
        EXPECT_NEAR(a.pressure, b.pressure, 1e-7 * std::abs(a.pressure) + 1e4) << ratio << a.phase << b.phase;
        EXPECT_NEAR(a.temperature, b.temperature, 1e-7 * a.temperature) << ratio;
        EXPECT_NEAR(a.specific_entropy, b.specific_entropy, 1e-5) << ratio << a.phase;
      }
    }
    // V_J at every temperature of the liquid, below and above T_G(V_J) = 6354 K.
    const double VJ = f.join_volume();
    for (double T : {1100.0, 2000.0, 5000.0, 6300.0, 6400.0, 20000.0}) {
      const State l = gray.state_at_temperature(1 / (VJ * (1 - 1e-10)), T);
      const State v = gray.state_at_temperature(1 / (VJ * (1 + 1e-10)), T);
      EXPECT_NE(l.phase, v.phase);
      EXPECT_EQ(v.phase, T > 6354 ? "hot vapour" : "vapour");
      EXPECT_NEAR(l.pressure, v.pressure, 1e3) << T;
      EXPECT_NEAR(l.specific_internal_energy, v.specific_internal_energy, 1.0) << T;
      EXPECT_NEAR(l.specific_entropy, v.specific_entropy, 1e-6) << T;
    }
  }
}

TEST(EosGray, BelowTheColdCurveTheTemperatureIsHeldAndCounted) {
  const GrayEos eos(copper());
  const double cold = eos.state_at_temperature(9500, 1.0).specific_internal_energy;
  std::vector<double> rho = {9500, 9500, 9500}, e = {cold - 1e5, cold - 1.0, cold + 1e5}, P(3), T(3), c(3);
  const RangeReport report = eos.evaluate({rho, e, P, T, c, {}, {}});
  EXPECT_EQ(report.out_of_range, 0u);
  EXPECT_EQ(report.below_cold_curve, 2u);
  EXPECT_EQ(T[0], Gray::least_temperature);
  EXPECT_EQ(P[0], P[1]);
  EXPECT_GT(T[2], 100);
  EXPECT_EQ(e[0], cold - 1e5);  // the energy is never reset
}

TEST(EosGray, BeyondItsRangeItCountsAndNamesTheBound) {
  const GrayEos eos(copper());
  const double nan = State::unknown;
  std::vector<double> rho = {8900, 1.001 * eos.maximum_density(), 8900, nan, -1, 8900};
  std::vector<double> e = {1e5, 1e6, nan, 1e5, 1e5, 1e6}, P(6), T(6), c(6), melted(6), vapour(6);
  const RangeReport report = eos.evaluate({rho, e, P, T, c, melted, vapour});
  EXPECT_EQ(report.out_of_range, 4u);
  EXPECT_EQ(report.first, 1u);
  EXPECT_EQ(report.bound, "density above the compression limit of the cold curve");
  for (const std::size_t i : {0u, 5u}) EXPECT_TRUE(std::isfinite(P[i]));
  for (const std::size_t i : {1u, 2u, 3u, 4u})
    EXPECT_TRUE(std::isnan(P[i]) && std::isnan(T[i]) && std::isnan(c[i]));
  EXPECT_THROW(static_cast<void>(eos.state(rho[1], 1e6)), StateError);
  EXPECT_THROW(static_cast<void>(eos.state_at_temperature(8900, -5)), StateError);
}

TEST(EosGray, CompressionLimitIsWhereTheColdPressureTurnsOver) {
  // Published turn-overs of the construction: copper at V/V0 = 0.350, aluminium 1100 at 0.357 with P_c = 463
  // GPa.
  const GrayFreeEnergy cu(copper());
  EXPECT_NEAR(cu.least_volume() / 0.1118e-3, 0.350, 0.002);
  GrayConstants al = aluminium();
  al.electronic_heat_coefficient = 0;
  const GrayFreeEnergy f(al);
  EXPECT_NEAR(f.least_volume() * 2707, 0.357, 0.001);
  EXPECT_NEAR(f.cold_pressure(f.least_volume()), 463e9, 1e9);
  EXPECT_LT(f.cold_pressure(1.01 * f.least_volume()), f.cold_pressure(f.least_volume()));
}

TEST(EosGray, SoundSpeedFloorActsOnlyInsideTheVanDerWaalsLoop) {
  const Gray gray(copper());
  const double floor = Gray::least_sound_speed_ratio * 3940;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double V = 0.1118e-3 * (0.36 + 0.72 * uniform(random));
    const double T = 2 + 3e4 * std::pow(uniform(random), 2);
    ASSERT_GT(gray.state_at_temperature(1 / V, T).sound_speed, 10 * floor) << V / 0.1118e-3 << " " << T;
  }
  EXPECT_EQ(gray.state_at_temperature(1 / (3 * 0.1118e-3), 1500).sound_speed, floor);
  EXPECT_LT(gray.state_at_temperature(1 / (3 * 0.1118e-3), 1500).isothermal_bulk_modulus, 0);
}

TEST(EosGray, ConstantsThatContradictEachOtherAreRefusedByName) {
  GrayConstants c = copper();
  c.anharmonic_heat_coefficient = -2e-3;
  EXPECT_THROW(
      try { GrayFreeEnergy{c}; } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("anharmonic_heat_coefficient"), std::string::npos)
            << error.what();
        throw;
      },
      InputError);
  c = copper();
  c.melting_entropy = 1.0;
  EXPECT_THROW(GrayFreeEnergy{c}, InputError);
  c = copper();
  c.vapour_attraction = 1e-3;
  EXPECT_THROW(Gray{c}, InputError);
}

TEST(EosGray, AttractionOfTheVapourIsSolvedForTheCriticalOrTheBoilingTemperature) {
  for (GrayConstants c : {copper(), aluminium()}) {
    c.vapour_attraction = GrayConstants::not_given;
    c.vapour = VapourCondition::critical;
    for (const double T : {6600.0, 7800.0, 10000.0}) {
      c.critical_temperature = T;
      EXPECT_NEAR(Gray(c).dome().critical_point().temperature, T, 1e-6 * T);
    }
    c.vapour = VapourCondition::boiling;
    for (const double T : {2414.7, 2835.0}) {
      c.boiling_temperature = T;
      EXPECT_NEAR(Gray(c).dome().at_pressure(101325).value().temperature, T, 1e-6 * T);
    }
  }
  // The presets find the attraction that gives the temperatures of copper with 620 J m^3/kg^2, and say so.
  GrayConstants c = copper();
  c.vapour = VapourCondition::boiling;
  c.boiling_temperature = Gray(copper()).dome().at_pressure(101325).value().temperature;
  c.vapour_attraction = GrayConstants::not_given;
  const GrayEos eos(c);
  EXPECT_NEAR(eos.underlying().constants().vapour_attraction, 620, 1e-3);
  EXPECT_NE(eos.constants().find("\nvapour_attraction = \""), std::string::npos) << eos.constants();
  EXPECT_NE(eos.constants().find("vapour = \"boiling\""), std::string::npos);
}

TEST(EosGray, VapourPresetWithoutItsTemperatureOrOutOfReachIsRefused) {
  const auto refusal = [](const GrayConstants& c) {
    try {
      const GrayFreeEnergy f(c);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  GrayConstants c = copper();
  for (const auto& [vapour, name] : {std::pair(VapourCondition::critical, "critical_temperature"),
                                     std::pair(VapourCondition::boiling, "boiling_temperature"),
                                     std::pair(VapourCondition::attraction, "vapour_attraction")}) {
    c.vapour = vapour;
    c.vapour_attraction = GrayConstants::not_given;
    EXPECT_NE(refusal(c).find(std::string("needs ") + name), std::string::npos) << refusal(c);
  }
  // The join alone binds copper: with any attraction it boils above 300 K and is a fluid with a loop at 2000
  // K.
  c.vapour = VapourCondition::critical;
  c.critical_temperature = 2000;
  EXPECT_NE(refusal(c).find("no vapour_attraction gives a critical_temperature of 2000 K"),
            std::string::npos);
  c.vapour = VapourCondition::boiling;
  c.boiling_temperature = 300;
  EXPECT_NE(refusal(c).find("no vapour_attraction gives a boiling_temperature of 300 K"), std::string::npos);
}

TEST(EosGray, AnharmonicAndElectronicCoefficientsAddUp) {
  GrayConstants a = copper(), b = copper();
  b.electronic_heat_coefficient = 7e-4;
  b.anharmonic_heat_coefficient = a.electronic_heat_coefficient - 7e-4;
  const GrayFreeEnergy fa(a), fb(b);
  EXPECT_NEAR(fa.solid(1e-4, 2000).pressure, fb.solid(1e-4, 2000).pressure, 1e-3);
  EXPECT_NEAR(fa.liquid(1e-4, 5000).energy, fb.liquid(1e-4, 5000).energy, 1e-6);
}

TEST(EosCatalogue, BuildsEveryModelFromNamedConstants) {
  GrayConstants source = copper();
  const std::vector<BoundParameter> values = whipple::bind(gray_parameters(), source);
  const auto declared = catalogue().at("gray").declare([&](std::span<const BoundParameter> wanted) {
    ASSERT_EQ(wanted.size(), values.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      ASSERT_EQ(wanted[i].info.name, values[i].info.name);
      if (double* const* number = std::get_if<double*>(&wanted[i].target)) {
        **number = *std::get<double*>(values[i].target);
      }
    }
  });
  const std::unique_ptr<EquationOfState> eos = declared.build();
  EXPECT_EQ(eos->model(), "gray");
  EXPECT_EQ(eos->state(9500, 5e5).pressure, GrayEos(copper()).state(9500, 5e5).pressure);
  // Provenance holds every constant with its unit; the defaults are resolved.
  EXPECT_NE(eos->constants().find("melting_gruneisen = 1.97"), std::string::npos) << eos->constants();
  EXPECT_EQ(eos->constants().find("nan"), std::string::npos) << eos->constants();
  for (const ModelEntry& entry : catalogue())
    EXPECT_NE(entry.describe().find("reference_"), std::string::npos) << entry.name;
  EXPECT_THROW(static_cast<void>(catalogue().at("grey")), InputError);
}

}  // namespace
}  // namespace whipple::eos::test
