// SPDX-License-Identifier: BSD-3-Clause
// Materials of the library, as their files are, against measurements; docs/manual/materials.md has the figures.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "eos/detonation.hpp"
#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "eos/models/solid_transition.hpp"
#include "src/core/base/pattern.hpp"
#include "src/material/material_file.hpp"
#include "tests/folders.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

const std::string data = whipple::tests::source_folder() + "/eos/data/";

Material library(const std::string& name) {
  return read_material(whipple::tests::source_folder() + "/eos/materials/" + name + ".toml");
}

/// Root of the mean square and mean of a series.
struct Deviation {
  double rms = 0, mean = 0;
  int count = 0;
  void add(double value) {
    rms = std::sqrt((rms * rms * count + value * value) / (count + 1));
    mean = (mean * count + value) / (count + 1);
    ++count;
  }
};

/// Midpoint of solidus and liquidus, K.
double melting_temperature(const EquationOfState& eos, double pressure) {
  const MeltingPoint melting = melting_point(eos, pressure).value();
  return 0.5 * (melting.solidus.temperature + melting.liquidus.temperature);
}

/// p - p_measured in GPa on an isotherm of rows (volume, pressure in GPa); `rest` is the volume at p = 0.
Deviation isotherm(const EquationOfState& eos, const std::string& file, double rest, double temperature) {
  Deviation deviation;
  const double rho0 = density_at_pressure(eos, 0.0, temperature);
  for (const auto& row : read_csv(data + file)) {
    const bool revised = row.size() >= 3;  // classical scale, revised scale, volume, errors
    const double ratio = std::stod(row[revised ? 2 : 0]) / rest;
    deviation.add(eos.state_at_temperature(rho0 / ratio, temperature).pressure * 1e-9 - std::stod(row[1]));
  }
  return deviation;
}

/// Us/Us_measured - 1 of rows with Us and up in km/s in these columns, for 0 < up < most (m/s).
Deviation shock_velocities(const EquationOfState& eos, const std::string& file, std::size_t us,
                           std::size_t up, double most = std::numeric_limits<double>::infinity()) {
  Deviation deviation;
  const Hugoniot hugoniot(eos);
  for (const auto& row : read_csv(data + file)) {
    const double velocity = std::stod(row[up]) * 1e3;
    if (velocity > 0 && velocity < most)
      deviation.add(hugoniot.at_particle_velocity(velocity).shock_velocity / (std::stod(row[us]) * 1e3) - 1);
  }
  return deviation;
}

/// p/p_measured - 1 on a principal Hugoniot of rows (V/V0, p in GPa).
Deviation hugoniot_in_volume(const EquationOfState& eos, const std::string& file) {
  Deviation deviation;
  const Hugoniot hugoniot(eos);
  for (const auto& row : read_csv(data + file)) {
    const ShockState s = hugoniot.at_density(eos.reference_density() / std::stod(row[0]));
    deviation.add(s.state.pressure * 1e-9 / std::stod(row[1]) - 1);
  }
  return deviation;
}

TEST(LibraryCopper, HugoniotOfMarshTo366GPa) {
  // LASL Shock Hugoniot Data (1980), 144 shocks.
  const Material copper = library("copper");
  const Deviation deviation = shock_velocities(*copper.eos, "cu_hugoniot_marsh1980.csv", 1, 2);
  ASSERT_EQ(deviation.count, 144);
  EXPECT_LT(deviation.rms, 0.013);
}

TEST(LibraryCopper, IsothermOfDewaeleTo153GPa) {
  const Deviation deviation =
      isotherm(*library("copper").eos, "cu_isotherm_298K_dewaele2004.csv", 11.808, 298);
  ASSERT_EQ(deviation.count, 42);
  EXPECT_LT(deviation.rms, 0.6);
}

TEST(LibraryCopper, MeltingLineOfBrandAndShockMelting) {
  // Brand et al., High Press. Res. 26, 185 (2006), to 16 GPa; arXiv 2503.01939: onset and completion of
  // melting on the Hugoniot with their errors.
  const Material copper = library("copper");
  const ShockMelting melting = shock_melting(*copper.eos).value();
  int fits = 0, points = 0;
  for (const auto& row : read_csv(data + "cu_melting.csv")) {
    const double p = std::stod(row[0]), T = std::stod(row[2]);
    if (row[4] == "fit") {
      EXPECT_NEAR(melting_temperature(*copper.eos, p * 1e9) / T, 1.0, 0.045) << p << " GPa";
      ++fits;
    } else if (!row[1].empty()) {
      const State& s = (points == 0 ? melting.onset : melting.completion).state;
      EXPECT_NEAR(s.pressure * 1e-9, p, std::stod(row[1])) << points;
      EXPECT_NEAR(s.temperature, T, std::stod(row[3])) << points;
      ++points;
    }
  }
  EXPECT_EQ(fits, 9);
  EXPECT_EQ(points, 2);
}

TEST(LibraryCopper, ReleaseMeltingAndCriticalPoint) {
  // Textbook values 140 and 184 GPa (McQueen); the model's equilibrium of the same constants: 136.6, 190.2.
  const Material copper = library("copper");
  const ReleaseThresholds thresholds = release_thresholds(*copper.eos, 0.0);
  EXPECT_NEAR(thresholds.incipient_melting.value().state.pressure * 1e-9, 136.6, 1.5);
  EXPECT_NEAR(thresholds.complete_melting.value().state.pressure * 1e-9, 190.2, 1.5);
  const CriticalPoint& critical = copper.eos->vapour_dome()->critical_point();
  EXPECT_NEAR(critical.temperature, 8511, 5);
  EXPECT_NEAR(critical.pressure * 1e-9, 1.04, 0.01);
  EXPECT_NEAR(1e-3 / critical.specific_volume, 2.60, 0.01);
}

TEST(LibraryAluminium, IsothermOfDewaeleTo153GPa) {
  const Deviation deviation =
      isotherm(*library("aluminium").eos, "al_isotherm_298K_dewaele2004.csv", 16.573, 298);
  ASSERT_EQ(deviation.count, 40);
  EXPECT_LT(deviation.rms, 0.7);
}

TEST(LibraryAluminium, HugoniotsOfMitchellAndNellisAndOfMcQueen) {
  // Points digitised from figures: the scatter of the first is theirs. The second ones lie 4 to 9 % below the
  // line that the same laboratory printed for 2024 aluminium, 5.328 km/s + 1.338 up.
  const Deviation mitchell =
      hugoniot_in_volume(*library("aluminium").eos, "al_hugoniot_mitchell_nellis1981.csv");
  ASSERT_EQ(mitchell.count, 27);
  EXPECT_LT(mitchell.rms, 0.045);
  EXPECT_LT(std::abs(mitchell.mean), 0.01);
  const Deviation mcqueen =
      hugoniot_in_volume(*library("aluminium_2024_t4").eos, "al_hugoniot_mcqueen1970_2024.csv");
  ASSERT_EQ(mcqueen.count, 28);
  EXPECT_LT(mcqueen.rms, 0.06);
}

TEST(LibraryAluminium, MeltingLineOfBoehlerAndRossLiesAboveTheModel) {
  // Diamond cell to 77 GPa and one shock point: Lindemann's law with Steinberg's constants rises too slowly.
  const Material aluminium = library("aluminium");
  Deviation deviation;
  for (const auto& row : read_csv(data + "al_melting_boehler_ross1997.csv")) {
    deviation.add(melting_temperature(*aluminium.eos, std::stod(row[0]) * 1e9) / std::stod(row[1]) - 1);
  }
  ASSERT_EQ(deviation.count, 8);
  EXPECT_LT(deviation.rms, 0.14);
  EXPECT_LT(deviation.mean, 0.0);
}

TEST(LibraryMetals, ShockVelocitiesOfOtherAuthors) {
  // Published fits that Steinberg's constants do not come from, over the range that their source states.
  std::map<std::string, std::pair<double, double>> fits;
  std::ifstream file(data + "us_up_fits.csv");
  for (std::string line; std::getline(file, line);) {
    static const Pattern row(R"(^("[^"]*"|[^",#][^,]*),([\d.]*),([\d.]+),([\d.]+),.*)");
    if (const auto found = row.match(line)) {
      fits[found->at(1) + " " + found->at(2)] = {std::stod(found->at(3)), std::stod(found->at(4))};
    }
  }
  struct Expected {
    const char* material;
    const char* fit;  ///< name and density as in the file
    double lowest, highest, tolerance;
  };
  const Expected table[] = {
      {"nickel", "\"Ni (OLS of Marsh 1980, 19 points)\" ", 0.3, 2.15, 0.015},
      {"copper", "Cu 8.93", 0.3, 3, 0.01},
      {"copper_ofhc", "Cu 8.93", 0.3, 3, 0.01},
      {"aluminium", "Al 2.71", 0.3, 5, 0.01},
      {"aluminium_6061_t6", "Al 6061-T6 (LSQ of 25 states of Marsh pp. 181-182) 2.703", 0.5, 4, 0.02},
      {"lead", "Pb 11.35", 0.2, 2, 0.03},
      {"tantalum", "Ta ", 0.3, 2.5, 0.03},
      {"silver", "Ag 10.5", 0.7, 3, 0.02},
      {"platinum", "Pt 21.43", 0.4, 2.4, 0.015},
  };
  for (const Expected& e : table) {
    ASSERT_EQ(fits.count(e.fit), 1U) << e.fit;
    const auto [C, S] = fits[e.fit];
    const Material material = library(e.material);
    const Hugoniot hugoniot(*material.eos);
    for (int i = 0; i <= 10; ++i) {
      const double up = e.lowest + (e.highest - e.lowest) * i / 10;
      EXPECT_NEAR(hugoniot.at_particle_velocity(up * 1e3).shock_velocity * 1e-3 / (C + S * up), 1.0,
                  e.tolerance)
          << e.material << " at " << up << " km/s";
    }
  }
}

TEST(LibraryMetals, ConstantsAreThoseOfSteinbergsTable) {
  // A slip of the pen in any of the files.
  std::map<std::string, std::vector<std::string>> rows;
  for (const auto& row : read_csv(data + "metals_steinberg1996.csv")) rows[row[0]] = row;
  int compared = 0;
  for (const LibraryMaterial& entry : library_materials()) {
    if (entry.group != "metals") continue;
    std::ifstream file(entry.file);
    const std::string whole((std::istreambuf_iterator<char>(file)), {});
    const std::string text = whole.substr(0, whole.find("[strength]"));
    static const Pattern steinberg(R"re(model = "(?:gray|mie_gruneisen)"[^]*SCG_([\w.-]+)\.xml)re");
    const auto found = steinberg.find(text);
    if (!found) continue;
    SCOPED_TRACE(entry.file.stem().string());
    ASSERT_EQ(rows.count(found->at(1)), 1U) << found->at(1);
    const std::vector<std::string>& row = rows[found->at(1)];
    std::map<std::string, double> constants;
    std::istringstream lines(read_material(entry.file).eos->constants());
    for (std::string line; std::getline(lines, line);) {
      static const Pattern constant(R"(^(\w+) = "?([-+]?[.\d][-+.\deE]*))");
      if (const auto pair = constant.find(line)) constants[pair->at(1)] = std::stod(pair->at(2));
    }
    const auto same = [&](const char* name, std::size_t column, double size) {
      const double value = std::stod(row[column]) * size;
      EXPECT_NEAR(constants.at(name), value, 1e-8 * std::abs(value)) << name;
    };
    const bool gray = constants.count("reference_specific_volume") == 1;
    EXPECT_NEAR(gray ? 1 / constants.at("reference_specific_volume") : constants.at("reference_density"),
                1e3 * std::stod(row[2]), 1e-4);
    if (found->at(1) == "Tin") {
      EXPECT_EQ(constants.at("hugoniot_intercept"), 2610);
    } else {
      same("hugoniot_intercept", 3, 1e3);
    }
    same("hugoniot_slope", 4, 1);
    same("hugoniot_quadratic", 5, 1);
    same("hugoniot_cubic", 6, 1);
    same("gruneisen", 7, 1);
    if (gray) {
      same("gruneisen_slope", 8, 1);
      same("melting_temperature", 9, 1);
    }
    ++compared;
  }
  EXPECT_GE(compared, 45);
}

TEST(LibraryMetals, MeltAtZeroPressureNearTheMeasuredMeltingPoint) {
  // Steinberg's T_m0 belongs to the density V0; the melting point follows from it and from the model.
  std::map<std::string, double> deviation;
  for (const LibraryMaterial& entry : library_materials()) {
    const Material material = read_material(entry.file);
    const bool pure = !std::isnan(material.measured.melting_point) && std::isnan(material.measured.liquidus);
    if (material.eos->model() != "gray" || !pure) continue;
    deviation[entry.file.stem().string()] =
        melting_temperature(*material.eos, 0.0) / material.measured.melting_point - 1;
  }
  // Tin: 573 K instead of 505 K. The molecular-dynamics row of copper melts where its potential does.
  const std::map<std::string, double> outliers = {{"tin", 0.14}, {"copper_md_liu2013", 0.105}};
  EXPECT_GE(deviation.size(), 20U);
  for (const auto& [name, value] : deviation) {
    const auto known = outliers.find(name);
    EXPECT_NEAR(value, 0.0, known == outliers.end() ? 0.08 : known->second) << name;
  }
}

TEST(LibraryMetals, ReleaseMeltingOfTheClassicalTable) {
  // Shock pressures for incipient and complete melting on release as reviews of impact quote them (after
  // McQueen; the first publication was not at hand). The model: within 20 %.
  struct Row {
    const char* material;
    double incipient, complete;
  };
  for (const Row& row :
       {Row{"aluminium", 61, 85}, Row{"cadmium", 33, 43}, Row{"copper", 140, 184}, Row{"lead", 25, 35}}) {
    const ReleaseThresholds release = release_thresholds(*library(row.material).eos, 1e5);
    EXPECT_NEAR(release.incipient_melting.value().state.pressure * 1e-9 / row.incipient, 1.0, 0.2)
        << row.material;
    EXPECT_NEAR(release.complete_melting.value().state.pressure * 1e-9 / row.complete, 1.0, 0.2)
        << row.material;
  }
}

TEST(LibraryMetals, TantalumMeltsInTheShockNear300GPa) {
  // Akin et al., J. Appl. Phys. (2019), doi:10.1063/1.5054332. With the electronic coefficient of low
  // temperature (5.9 mJ/(mol K^2)) the onset would lie at 620 GPa.
  const Material tantalum = library("tantalum");
  EXPECT_NEAR(shock_melting(*tantalum.eos).value().onset.state.pressure * 1e-9, 300, 20);
}

TEST(LibraryIron, HugoniotAbove13GPaAndMeltingOfTheEpsilonPhase) {
  // Shocks of 28 publications, those to 500 GPa that are slower than 5.2 km/s; the fit that C and S come from is of
  // others. Below 13 GPa there is one point.
  const Material iron = library("iron_high_pressure");
  const Deviation deviation = shock_velocities(*iron.eos, "fe_hugoniot_rusbank.csv", 0, 1, 5.2e3);
  EXPECT_EQ(deviation.count, 213);
  EXPECT_LT(deviation.rms, 0.018);
  EXPECT_NEAR(deviation.mean, 0.0, 0.01);
  // Nguyen & Holmes, Nature 427 (2004) 339: sound speeds show melting between 225 and 260 GPa (from memory).
  const ShockMelting melting = shock_melting(*iron.eos).value();
  EXPECT_NEAR(melting.onset.state.pressure * 1e-9, 225, 20);
  EXPECT_NEAR(melting.completion.state.pressure * 1e-9, 260, 20);
  // Diamond cell: the model's line is high (docs/manual/materials.md, section 7).
  Deviation line;
  for (const auto& row : read_csv(data + "fe_melting_fischer2013.csv")) {
    line.add(melting_temperature(*iron.eos, std::stod(row[0]) * 1e9) / std::stod(row[1]) - 1);
  }
  EXPECT_EQ(line.count, 21);
  EXPECT_LT(line.rms, 0.2);
  // What its note says of the missing phases.
  EXPECT_NEAR(melting_temperature(*iron.eos, 0.0), 1616, 5);
  EXPECT_NEAR(iron.eos->reference_density() * std::pow(Hugoniot(*iron.eos).initial().sound_speed, 2) * 1e-9,
              119, 1);
}

TEST(LibraryTillotson, HugoniotsAndContinuity) {
  // Against Steinberg's shock curves (fits to Marsh, 1980): two constants of compression follow metals within
  // 2 % over the velocities of impacts.
  struct Row {
    const char* tillotson;
    const char* measured;
    double lowest, highest, tolerance;
  };
  for (const Row& row : {Row{"aluminium_tillotson", "aluminium", 0.5, 5, 0.02},
                         Row{"copper_tillotson", "copper_ofhc", 0.5, 4, 0.02}}) {
    const Material model = library(row.tillotson), measured = library(row.measured);
    for (int i = 0; i <= 8; ++i) {
      const double up = 1e3 * (row.lowest + (row.highest - row.lowest) * i / 8);
      EXPECT_NEAR(Hugoniot(*model.eos).at_particle_velocity(up).shock_velocity /
                      Hugoniot(*measured.eos).at_particle_velocity(up).shock_velocity,
                  1.0, row.tolerance)
          << row.tillotson << " at " << up << " m/s";
    }
  }
  // The pressure is continuous where the formulas meet: at E_iv and E_cv in expansion, at rho0 above E_cv.
  int crossed = 0;
  for (const LibraryMaterial& entry : library_materials()) {
    const Material material = read_material(entry.file);
    if (material.eos->model() != "tillotson") continue;
    SCOPED_TRACE(entry.file.stem().string());
    const EquationOfState& eos = *material.eos;
    for (const double pressure : {0.0, 50e9})
      EXPECT_FALSE(melting_point(eos, pressure)) << "a model without melting";
    const std::string constants = eos.constants();
    const auto value = [&](const std::string& name) {
      const auto found = Pattern(name + R"( = "?([-+.\deE]+))").find(constants);
      EXPECT_TRUE(found) << name;
      return found ? std::stod(found->at(1)) : 0.0;
    };
    const double rho0 = eos.reference_density(), modulus = value("bulk_modulus");
    const double incipient = value("incipient_vaporisation_energy"),
                 complete = value("complete_vaporisation_energy");
    const auto jump = [&](double density, double energy, double step_density, double step_energy) {
      return std::abs(eos.state(density + step_density, energy + step_energy).pressure -
                      eos.state(density - step_density, energy - step_energy).pressure) /
             modulus;
    };
    for (const double ratio : {0.3, 0.6, 0.9, 0.99}) {
      EXPECT_LT(jump(ratio * rho0, incipient, 0, 1e-9 * incipient), 1e-7) << ratio;
      EXPECT_LT(jump(ratio * rho0, complete, 0, 1e-9 * complete), 1e-7) << ratio;
    }
    for (const double ratio : {0.5, 1.2, 2.0})
      EXPECT_LT(jump(rho0, ratio * complete, 1e-9 * rho0, 0), 1e-7) << ratio;
    ++crossed;
  }
  EXPECT_GE(crossed, 8);
}

TEST(LibraryExplosives, DetonateAtThePublishedVelocityAndPressure) {
  // Chapman-Jouguet states of the handbook (Dobratz and Crawford 1985), where the constants belong to them.
  struct Row {
    const char* material;
    double velocity, pressure;  // km/s, GPa
  };
  for (const Row& row : {Row{"tnt", 6.93, 21.0}, Row{"composition_b", 7.98, 29.5}, Row{"pbx_9404", 8.8, 37.0},
                         Row{"pbx_9501", 8.8, 37.0}, Row{"lx_10", 8.82, 37.5}, Row{"lx_14", 8.8, 37.0},
                         Row{"petn", 8.3, 33.5}, Row{"c4", 8.193, 28.0}, Row{"octol_78_22", 8.48, 34.2},
                         Row{"tetryl", 7.91, 28.5}, Row{"anfo", 4.55, 5.5}, Row{"cyclotol", 8.25, 32.0},
                         Row{"pentolite", 7.53, 25.5}, Row{"lx_07", 8.64, 35.5}, Row{"lx_04", 8.47, 34.0},
                         Row{"lx_17", 7.68, 27.0}, Row{"pbx_9502", 7.71, 28.0}}) {
    const ChapmanJouguet wave = chapman_jouguet(*library(row.material).eos);
    EXPECT_NEAR(wave.detonation_velocity * 1e-3, row.velocity, 0.002 * row.velocity) << row.material;
    EXPECT_NEAR(wave.state.pressure * 1e-9, row.pressure, 0.005 * row.pressure) << row.material;
  }
}

// The constants of nitromethane are rounded more than the others.
TEST(LibraryExplosives, NitromethaneDetonatesWithinAThirdOfAPercent) {
  const ChapmanJouguet wave = chapman_jouguet(*library("nitromethane").eos);
  EXPECT_NEAR(wave.detonation_velocity, 6280, 0.0033 * 6280);
  EXPECT_NEAR(wave.state.pressure, 12.5e9, 0.005 * 12.5e9);
}

TEST(LibraryFluids, WaterAndAir) {
  // Sound at 293 K: water 1482 m/s; air at 288.15 K 340.3 m/s and 101.325 kPa.
  for (const char* name : {"water", "water_linear_mie_gruneisen", "water_tait"}) {
    EXPECT_NEAR(library(name).reference.sound_speed, 1482, 6) << name;
  }
  const State air = library("air").reference;
  EXPECT_NEAR(air.sound_speed, 340.3, 0.2);
  EXPECT_NEAR(air.pressure, 101325, 100);
}

TEST(LibraryAll, ShocksGetFasterAndStrongerFromSoundOn) {
  int crushed = 0;
  for (const LibraryMaterial& entry : library_materials()) {
    SCOPED_TRACE(entry.file.stem().string());
    const Material material = read_material(entry.file);
    if (material.eos->model() == SolidTransition::name) continue;  // they split: SolidTransition.ShocksSplit
    const Hugoniot hugoniot(*material.eos);
    // A weak shock travels with sound, stronger ones faster, subsonically against the material behind them.
    ShockState before = hugoniot.at_particle_velocity(1.0);
    // Crushing pores are slower than sound; a pressure without energy may be concave (ceramics with K2 < 0).
    const bool ramps = material.eos->initial_distension() > 1.0 || material.reference.gruneisen == 0.0;
    // The heat of crushed pores expands foams more than the shock compresses them (docs/theory/equations_of_state.md).
    const bool turns = material.eos->initial_distension() > 1.0 + 2.0 / material.reference.gruneisen;
    const double over_sound = before.shock_velocity / material.reference.sound_speed;
    if (before.state.phase == "compacting") {  // waves of 1 m/s crush the two fabrics, and are slower
      EXPECT_LT(over_sound, 0.6);
      EXPECT_GT(over_sound, 0.2);
      ++crushed;
    } else {
      EXPECT_NEAR(over_sound, 1.0, 0.003);
    }
    for (const double up : {50.0, 200.0, 500.0, 1000.0, 1500.0}) {
      const ShockState shock = hugoniot.at_particle_velocity(up);
      EXPECT_GT(shock.state.pressure, before.state.pressure) << up;
      EXPECT_GT(shock.state.density, turns ? material.reference.density : before.state.density) << up;
      if (!ramps) {
        EXPECT_GT(shock.state.temperature, before.state.temperature) << up;
        EXPECT_GT(shock.shock_velocity, before.shock_velocity) << up;
        EXPECT_GT(shock.state.sound_speed + up, shock.shock_velocity) << up;  // the shock is stable
      }
      before = shock;
    }
  }
  EXPECT_EQ(crushed, 2);
}

}  // namespace
}  // namespace whipple::eos::test
