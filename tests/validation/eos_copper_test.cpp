// SPDX-License-Identifier: BSD-3-Clause
// GRAY against measurements of copper; nothing is adjusted to them here.
#include <gtest/gtest.h>

#include <cmath>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "tests/folders.hpp"
#include "tests/unit/eos_support.hpp"
#include "tests/validation/eos_marsh.hpp"

namespace whipple::eos::test {
namespace {

TEST(EosCopper, RoomTemperatureIsothermOfDewaeleTo153GPa) {
  // Dewaele, Loubeyre, Mezouar, Phys. Rev. B 70, 094112 (2004), revised ruby scale.
  const GrayEos eos(copper());
  const auto rows = read_csv(whipple::tests::source_folder() + "/eos/data/cu_isotherm_298K_dewaele2004.csv");
  ASSERT_EQ(rows.size(), 42u);
  const double rho0 = density_at_pressure(eos, 0.0, 298.0);
  double sum = 0, mean = 0;
  for (const auto& row : rows) {
    const double ratio = std::stod(row[2]) / 11.808;  // measured volume at zero pressure, A^3/atom
    const double deviation =
        eos.state_at_temperature(rho0 / ratio, 298.0).pressure * 1e-9 - std::stod(row[1]);
    sum += deviation * deviation;
    mean += deviation;
  }
  const double count = static_cast<double>(rows.size());
  EXPECT_LT(std::sqrt(sum / count), 1.0);
  EXPECT_LT(std::abs(mean / count), 0.3);
}

TEST(EosCopper, HugoniotOfMarsh) {
  const GrayEos eos(copper());
  const ShockDeviation marsh = deviation_from_marsh(eos);
  ASSERT_EQ(marsh.count, 144);
  EXPECT_LT(marsh.rms, 0.013);
  EXPECT_LT(std::abs(marsh.mean), 0.002);
}

TEST(EosCopper, ThermalExpansionAtZeroPressure) {
  // Linear coefficient in 1e-6/K: model 17.1/17.6/18.0/18.5/19.6, NIST Hahn1 fit 16.7/17.6/18.3/19.0/20.5.
  const GrayEos eos(copper());
  const double table[][3] = {{300, 17.1, 16.683},
                             {400, 17.6, 17.561},
                             {500, 18.0, 18.269},
                             {600, 18.5, 18.953},
                             {800, 19.6, 20.484}};
  for (const auto& row : table) {
    const double h = 1.0;
    const double expansion =
        -std::log(density_at_pressure(eos, 0.0, row[0] + h) / density_at_pressure(eos, 0.0, row[0] - h)) /
        (2 * h) / 3 * 1e6;
    EXPECT_NEAR(expansion, row[1], 0.06) << row[0];
    EXPECT_NEAR(expansion / row[2], 1.0, 0.05) << row[0];
  }
}

TEST(EosCopper, MeltingLineOfBrand) {
  // Brand, Dobson, Vocadlo, Wood, High Press. Res. 26, 185 (2006), fit to 16 GPa: the model lies within 5 %.
  const GrayEos eos(copper());
  const double table[][2] = {{0, 1355}, {4, 1523.2}, {8, 1672}, {12, 1801}, {16, 1911}};
  for (const auto& row : table) {
    double lower = 1000, upper = 3000;
    while (upper - lower > 0.1) {
      const double T = 0.5 * (lower + upper), rho = density_at_pressure(eos, row[0] * 1e9, T);
      (eos.state_at_temperature(rho, T).melted_fraction > 0.5 ? upper : lower) = T;
    }
    EXPECT_NEAR(lower / row[1], 1.0, 0.05) << row[0];
  }
}

TEST(EosCopper, LiquidHugoniotOfMcCoy) {
  // McCoy, Knudson, Root, Phys. Rev. B 96, 174109 (2017): Us = 4.272 + 1.413 up (km/s) for shocked liquid
  // copper.
  const GrayEos eos(copper());
  for (double P : {300e9, 400e9, 600e9, 1000e9}) {
    const ShockState s = Hugoniot(eos).at_pressure(P);
    ASSERT_EQ(s.state.phase.substr(0, 6), "liquid") << P;
    EXPECT_NEAR(s.shock_velocity / (4272 + 1.413 * s.particle_velocity), 1.0, 0.005) << P;
  }
}

TEST(EosCopper, BulkModulusAtRest) {
  const GrayEos eos(copper());
  const State s = eos.state_at_temperature(eos.reference_density(), 300);
  EXPECT_NEAR(s.density * s.sound_speed * s.sound_speed * 1e-9, 138.84, 0.02);
  EXPECT_NEAR(s.isothermal_bulk_modulus * 1e-9, 134.8, 0.1);
}

TEST(EosMetals, AmbientMeltingPointsFollowFromSteinbergsConstants) {
  // T_m(P = 0) from (rho0, C, S, gamma0, a, T_m0) of Steinberg, UCRL-MA-106439 (1996) alone: aluminium 1100
  // 964 K (measured 933 K), without electronic heat capacity.
  GrayConstants c = aluminium();
  c.electronic_heat_coefficient = 0;
  const GrayEos eos(c);
  double lower = 500, upper = 2000;
  while (upper - lower > 0.1) {
    const double T = 0.5 * (lower + upper), rho = density_at_pressure(eos, 0.0, T);
    (eos.state_at_temperature(rho, T).melted_fraction > 0.5 ? upper : lower) = T;
  }
  EXPECT_NEAR(lower, 964, 6);
  EXPECT_NEAR(lower / 933, 1.0, 0.04);
}

}  // namespace
}  // namespace whipple::eos::test
