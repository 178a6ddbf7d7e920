// SPDX-License-Identifier: BSD-3-Clause
// The measured Hugoniot and isotherm of copper against GRAY with the two published rows of constants. The
// figures were found before with an independent implementation of the same equations (docs/theory/fit.md,
// section 6).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "eos/experiments/comparison.hpp"
#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/gray.hpp"
#include "src/core/base/error.hpp"
#include "src/material/material.hpp"
#include "tests/folders.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::eos::experiments {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path data = std::filesystem::path(whipple::tests::source_folder()) / "eos/data";

Experiment read_experiment(const std::filesystem::path& file, std::optional<double> temperature = {}) {
  return read_experiments(file, temperature).front();
}

Comparison compare(const Material& material, const Experiment& experiment) {
  return compare(*material.eos, material.reference, experiment);
}

/// Rows of Liu, Wang & Zhang, Int. J. Mech. Mater. Des. 9 (2013) 127.
Material copper(bool measured) {
  eos::GrayConstants c;
  c.molar_mass = 0.063546;
  c.reference_specific_volume = measured ? 0.1118e-3 : 0.1119e-3;
  c.hugoniot_intercept = measured ? 3940.0 : 3980.0;
  c.hugoniot_slope = measured ? 1.489 : 1.301;
  c.gruneisen = measured ? 1.97 : 1.86;
  c.gruneisen_slope = measured ? 1.5 : 1.7;
  c.electronic_heat_coefficient = measured ? 4.9e-4 : 8.3e-4;
  c.melting_temperature = measured ? 1790.0 : 2006.0;
  c.vapour_attraction = 620.0;
  return make_material(measured ? "measured" : "simulated",
                       std::make_shared<eos::ModelEquationOfState<eos::Gray>>(c));
}

// Brand et al., High Press. Res. 26 (2006) 185, to 16 GPa; X-ray absorption plateau and other points beyond.
TEST(Compare, CopperMeltingLine) {
  const Experiment melting = read_experiment(data / "cu_melting.csv");
  EXPECT_EQ(melting.kind, ExperimentKind::melting);
  ASSERT_EQ(melting.abscissa.size(), 12u);
  EXPECT_NEAR(melting.ordinate.front(), 1355.0, 1e-9);
  const Comparison measured = compare(copper(true), melting);
  EXPECT_EQ(measured.points, 12);
  EXPECT_NEAR(measured.rms, 3.52, 0.05);  // % of T
  EXPECT_NEAR(measured.model.front(), 1326.8, 0.1);
}

TEST(Compare, DataNameTheirMaterial) {
  const Experiment copper_data = read_experiment(data / "cu_hugoniot_marsh1980.csv"),
                   aluminium_data = read_experiment(data / "al_hugoniot_mitchell_nellis1981.csv");
  EXPECT_TRUE(belongs_to(copper_data, "Copper, drawn"));
  EXPECT_FALSE(belongs_to(aluminium_data, "Copper, drawn"));
  EXPECT_FALSE(belongs_to(copper_data, "unknown"));
  EXPECT_TRUE(belongs_to(copper_data, "copper_x"));  // the name of a file
}

// Marsh (ed.), LASL Shock Hugoniot Data (1980): 144 shocks up to 366 GPa.
TEST(Compare, CopperHugoniotOfMarsh) {
  const Experiment marsh = read_experiment(data / "cu_hugoniot_marsh1980.csv");
  EXPECT_EQ(marsh.kind, ExperimentKind::shock_velocity);
  ASSERT_EQ(marsh.abscissa.size(), 144u);
  EXPECT_NEAR(marsh.abscissa.back(), 4161.0, 1e-9);
  const Comparison measured = compare(copper(true), marsh);
  EXPECT_EQ(measured.points, 144);
  EXPECT_NEAR(measured.rms, 1.2, 0.05);  // % of Us
  EXPECT_NEAR(measured.mean, 0.08, 0.01);
  // The independent figures are means of (experiment - model)/model: -0.07 % and +3.4 %.
  const auto mean_of_model = [&](const Comparison& comparison) {
    double sum = 0.0;
    for (std::size_t i = 0; i < comparison.model.size(); ++i) {
      sum += 100.0 * (marsh.ordinate[i] / comparison.model[i] - 1.0);
    }
    return sum / static_cast<double>(comparison.model.size());
  };
  EXPECT_NEAR(mean_of_model(measured), -0.07, 0.01);
  const Comparison simulated = compare(copper(false), marsh);
  EXPECT_NEAR(mean_of_model(simulated), 3.4, 0.1);  // S = 1.301 is too low
}

// Dewaele, Loubeyre, Mezouar, Phys. Rev. B 70 (2004) 094112: 298 K to 153 GPa.
TEST(Compare, CopperIsothermOfDewaele) {
  const Experiment dewaele = read_experiment(data / "cu_isotherm_298K_dewaele2004.csv");
  EXPECT_EQ(dewaele.kind, ExperimentKind::isotherm);
  EXPECT_DOUBLE_EQ(dewaele.temperature, 298.0);
  EXPECT_NEAR(dewaele.ambient_volume, 11.808e-30, 1e-36);
  ASSERT_EQ(dewaele.abscissa.size(), 41u);            // 42 rows, one of them the reference at P = 0
  EXPECT_DOUBLE_EQ(dewaele.ordinate.front(), 153e9);  // the revised pressure scale
  const Comparison measured = compare(copper(true), dewaele);
  EXPECT_EQ(measured.points, 41);
  EXPECT_NEAR(measured.rms, 0.50e9, 0.01e9);
  EXPECT_NEAR(measured.mean, 0.08e9, 0.01e9);
  EXPECT_NEAR(measured.model.front(), 153.6e9, 0.3e9);
  const Comparison simulated = compare(copper(false), dewaele);
  EXPECT_NEAR(simulated.rms, 9.8e9, 0.1e9);
  EXPECT_NEAR(simulated.model.front(), 130e9, 1.5e9);
}

TEST(Compare, RoomTemperatureIsothermOfTheHandbook) {
  const Experiment handbook = read_experiment(data / "cu_isotherm_aip_handbook.csv");
  EXPECT_EQ(handbook.kind, ExperimentKind::isotherm);
  EXPECT_DOUBLE_EQ(handbook.temperature, 298.0);  // "room-temperature"
  const Comparison measured = compare(copper(true), handbook);
  EXPECT_LT(measured.rms, 1.0e9);
}

TEST(Compare, PressureVolumeHugoniotIsRecognisedByItsComments) {
  const Experiment hugoniot = read_experiment(data / "al_hugoniot_mitchell_nellis1981.csv");
  EXPECT_EQ(hugoniot.kind, ExperimentKind::shock_pressure);
}

// Points taken from the model's own Hugoniot and isotherm must leave no deviation: the jump conditions and
// the volume ratio are those of the loci.
TEST(Compare, OwnCurvesLeaveNoDeviation) {
  const TemporaryFolder folder;
  const Material material = copper(true);
  const eos::Hugoniot hugoniot(*material.eos, material.reference.density,
                               material.reference.specific_internal_energy);
  {
    std::ofstream shocks(folder.path() / "own_hugoniot.csv");
    std::ofstream ratios(folder.path() / "own_pv_hugoniot.csv");
    shocks << "# test\nus_km_s,up_km_s\n";
    ratios << "# test\nP_GPa,rho_g_cm3,note\n";
    ratios << fmt::format("0,{:.12g},\"start, at rest\"\n", material.reference.density * 1e-3);
    for (const double up : {300.0, 1000.0, 2500.0}) {
      const eos::ShockState state = hugoniot.at_particle_velocity(up);
      shocks << fmt::format("{:.12g},{:.12g}\n", state.shock_velocity * 1e-3, up * 1e-3);
      ratios << fmt::format("{:.12g},{:.12g},\"a, b\"\n", state.state.pressure * 1e-9,
                            state.state.density * 1e-3);
    }
    std::ofstream isotherm(folder.path() / "own_500K.csv");
    isotherm << "# test, V0 at 500 K\nP_GPa,V_over_V0\n";
    const double density = eos::density_at_pressure(*material.eos, 0.0, 500.0);
    for (const double ratio : {0.95, 0.8, 0.7}) {
      isotherm << fmt::format(
          "{:.12g},{}\n", material.eos->state_at_temperature(density / ratio, 500.0).pressure * 1e-9, ratio);
    }
  }
  const Comparison shocks = compare(material, read_experiment(folder.path() / "own_hugoniot.csv"));
  EXPECT_EQ(shocks.points, 3);
  EXPECT_LT(std::abs(shocks.maximum), 1e-7);  // %
  const Experiment ratios = read_experiment(folder.path() / "own_pv_hugoniot.csv");
  EXPECT_EQ(ratios.kind, ExperimentKind::shock_pressure);
  EXPECT_LT(std::abs(compare(material, ratios).maximum), 1e3);  // Pa of up to 150 GPa
  const Experiment isotherm = read_experiment(folder.path() / "own_500K.csv");
  EXPECT_DOUBLE_EQ(isotherm.temperature, 500.0);
  EXPECT_LT(std::abs(compare(material, isotherm).maximum), 1e3);
  // The wrong temperature shows.
  EXPECT_GT(std::abs(compare(material, read_experiment(folder.path() / "own_500K.csv", 1000.0)).maximum),
            1e6);
}

// The same of isentropes and of sound speeds behind shocks; those of another material deviate.
TEST(Compare, OwnIsentropeAndSoundSpeedsLeaveNoDeviation) {
  const TemporaryFolder folder;
  const Material material = copper(true);
  const eos::State& rest = material.reference;
  const eos::Hugoniot hugoniot(*material.eos, rest.density, rest.specific_internal_energy);
  {
    std::ofstream ramp(folder.path() / "own_isentrope.csv");
    std::ofstream sound(folder.path() / "own_sound.csv");
    ramp << "# test, not a Hugoniot\nP_GPa,V_over_V0\n";
    sound << "# test\nP [GPa],c bulk [km/s]\n";
    for (const double ratio : {0.95, 0.8, 0.7}) {
      const eos::State state = eos::isentrope(*material.eos, rest, {rest.density / ratio}).back().state;
      ramp << fmt::format("{:.12g},{}\n", state.pressure * 1e-9, ratio);
    }
    for (const double pressure : {10.0, 50.0, 150.0}) {
      const eos::State state = hugoniot.at_pressure(pressure * 1e9).state;
      sound << fmt::format("{},{:.12g}\n", pressure, state.sound_speed * 1e-3);
    }
  }
  const Experiment ramp = read_experiment(folder.path() / "own_isentrope.csv");
  EXPECT_EQ(ramp.kind, ExperimentKind::isentrope);
  const Comparison own = compare(material, ramp);
  EXPECT_EQ(own.points, 3);
  EXPECT_LT(std::abs(own.maximum), 1e4);  // Pa of up to 110 GPa
  EXPECT_GT(compare(copper(false), ramp).rms, 1e9);
  const Experiment sound = read_experiment(folder.path() / "own_sound.csv");
  EXPECT_EQ(sound.kind, ExperimentKind::sound_speed);
  const Comparison speeds = compare(material, sound);
  EXPECT_EQ(speeds.points, 3);
  EXPECT_LT(std::abs(speeds.maximum), 1e-6);  // %
  EXPECT_GT(compare(copper(false), sound).rms, 1.0);
}

Experiment experiment_of(const std::string& text, const std::string& name = "measurement.csv") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / name, std::ios::binary) << text;
  return read_experiment(folder.path() / name);
}

// One shock, 500 m/s and 4700 m/s, in the dialects of spreadsheets, papers and programs.
TEST(Compare, ReadsTablesAsPeopleWriteThem) {
  for (const char* text :
       {"us_km_s,up_km_s\n4.7,0.5\n",
        "\xEF\xBB\xBFup [km/s];Us [km/s];note\r\n 0.5 ; +4.7 ;\"a; b\"\r\n;;\r\n",
        "u_p (m/s)\tU_s (m/s)\n500\t4700\n", "% text\n\n  up [km/s]  us [km/s]\n  0.5   4.7\n",
        "up,Us\nkm/s,m/s\n0.5,4700\n", "particle velocity (mm/us),shock velocity (mm/us)\n0.5,4.7\n",
        "D [km/s],U [km/s],d [mm]\n4.7,0.5,3\n"}) {
    const Experiment experiment = experiment_of(text);
    EXPECT_EQ(experiment.kind, ExperimentKind::shock_velocity) << text;
    ASSERT_EQ(experiment.abscissa.size(), 1U) << text;
    EXPECT_NEAR(experiment.abscissa.front(), 500.0, 1e-9) << text;
    EXPECT_NEAR(experiment.ordinate.front(), 4700.0, 1e-9) << text;
  }
  const Experiment isotherm = experiment_of("# 298 K\nP (kbar);V (\xC3\x85^3)\n0;12\n100;11\n");
  EXPECT_NEAR(isotherm.ordinate.front(), 1e10, 1.0);
  EXPECT_NEAR(isotherm.abscissa.front(), 11.0 / 12.0, 1e-12);
  EXPECT_NEAR(isotherm.ambient_volume, 12e-30, 1e-40);
}

TEST(Compare, NamesTheRowsThatItLeavesOut) {
  const Experiment experiment =
      experiment_of("us_km_s,up_km_s\n4.7,0.5\n3.9,0\n4.5,-0.4\n5,nan\n,0.3\n4,5\n");
  using Lines = std::vector<int>;
  EXPECT_EQ(experiment.lines, Lines{2});
  const std::map<std::string, Lines> expected = {{"at rest (up = 0: a sound speed, no shock)", {3}},
                                                 {"up is negative", {4}},
                                                 {"a value is missing or no number", {5, 6}},
                                                 {"Us is not above up", {7}}};
  EXPECT_EQ(experiment.left_out, expected);
}

// The same shock from the initial density of a row, from its porosity, and of the model's porous Hugoniot.
TEST(Compare, PorousRowsMeetThePorousHugoniot) {
  const Material material = copper(true);
  const double solid = material.reference.density;
  const double us =
      eos::Hugoniot::porous(*material.eos, solid / 1.6).at_particle_velocity(750).shock_velocity;
  EXPECT_LT(us, 3000.0);  // 5070 m/s from the solid
  const std::string row = fmt::format("0.75,{:.12g},", us * 1e-3);
  const std::string density = fmt::format("up_km_s,us_km_s,rho0_g_cm3\n{}{:.12g}\n", row, solid / 1.6 * 1e-3);
  for (const std::string& text : {density, "up_km_s,us_km_s,m\n" + row + "1.6\n"}) {
    const Comparison comparison = compare(material, experiment_of(text));
    EXPECT_NEAR(comparison.maximum, 0.0, 1e-7) << text;
    EXPECT_EQ(comparison.porous, std::vector<int>{2}) << text;
  }
  // Within a hundredth it is the same solid; above it is said.
  EXPECT_TRUE(compare(material, experiment_of("up_km_s,us_km_s,rho0_g_cm3\n0.75,5,8.92\n")).porous.empty());
  const Comparison denser = compare(material, experiment_of("up_km_s,us_km_s,rho0_g_cm3\n0.75,5,9.2\n"));
  EXPECT_EQ(denser.denser, std::vector<int>{2});
  // A pressure and a density behind the shock: V/V0 by the initial density, no row at rest needed.
  const auto state = eos::Hugoniot::porous(*material.eos, solid / 1.6).at_particle_velocity(750).state;
  const Comparison pressures =
      compare(material, experiment_of(fmt::format("P_GPa,rho_kg_m3,rho0_kg_m3\n{:.12g},{:.12g},{:.12g}\n",
                                                  state.pressure * 1e-9, state.density, solid / 1.6),
                                      "hugoniot.csv"));
  EXPECT_NEAR(pressures.maximum / state.pressure, 0.0, 1e-6);
}

// The table of published fits gives each of its rows for the materials that the row names.
TEST(Compare, PublishedFitsAreExperiments) {
  const std::vector<Experiment> fits = read_experiments(data / "us_up_fits.csv");
  EXPECT_EQ(fits.size(), 25U);
  const auto silver =
      std::ranges::find_if(fits, [](const Experiment& fit) { return fit.lines.front() == 23; });
  ASSERT_NE(silver, fits.end());
  EXPECT_EQ(silver->material, "silver");
  EXPECT_TRUE(silver->only_its_material);
  const auto pressure = [&](std::size_t i) { return 10500 * silver->abscissa[i] * silver->ordinate[i]; };
  EXPECT_GE(pressure(0), 30e9);  // the range that the row states
  EXPECT_LE(pressure(silver->abscissa.size() - 1), 300e9);
  EXPECT_NEAR(silver->ordinate.front(), 3210 + 1.62 * silver->abscissa.front(), 1e-9);
  // Steinberg's form with S2, S3: lead.
  const Experiment lead =
      experiment_of("C_km_s,S,S2,S3,range\n2.006,1.429,0.8506,-1.64,Up 0.4-2\n", "lead.csv");
  for (std::size_t i = 0; i < lead.abscissa.size(); ++i) {
    const double up = lead.abscissa[i], us = lead.ordinate[i];
    EXPECT_NEAR(us, 2006 + 1.429 * up + 0.8506 * up * up / us - 1.64 * up * up * up / (us * us), 1e-6);
  }
}

std::string refusal(const std::string& text, const std::string& name = "measurement.csv") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / name) << text;
  try {
    read_experiment(folder.path() / name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Compare, ReportsFilesThatItCannotUse) {
  EXPECT_THAT(refusal("# no temperature\nP_GPa,V_over_V0\n1,0.99\n"), HasSubstr("give --temperature"));
  EXPECT_THAT(refusal("T_K,alpha\n1,2\n"), HasSubstr("the columns are T_K, alpha"));
  EXPECT_THAT(refusal("# 298 K\nP_GPa,atomic_volume_A3\n1,11.7\n"), HasSubstr("add a row with P = 0"));
  EXPECT_THAT(refusal("# 298 K\nP_GPa,c_km_s\n1,2\n"), HasSubstr("no column of volume"));
  EXPECT_THAT(refusal("us_km_s,up_km_s\n5,x\n"),
              HasSubstr("measurement.csv:2: 'x' in column up_km_s is not a number"));
  EXPECT_THAT(refusal("us_km_s,up_km_s\n5\n"), HasSubstr("measurement.csv:2: 1 cells, the header has 2"));
  EXPECT_THAT(refusal("up;us\nkm/s;km/s\n0,5;4,700.1\n"),
              HasSubstr("csv:3: '4,700.1' in column us is not a number"));
  EXPECT_THAT(refusal("us_km_s,up_km_s\n4,7,0,5\n"),
              HasSubstr("csv:2: 4 cells, the header has 2 (a decimal comma?"));
  EXPECT_THAT(refusal("up,us_km_s\n0.5,4.7\n"), HasSubstr("column 'up' gives no unit"));
  EXPECT_THAT(refusal("up [GPa],us_km_s\n0.5,4.7\n"),
              HasSubstr("csv:1: column 'up [GPa]': 'GPa' is no unit"));
  EXPECT_THAT(refusal(std::string("u\0p\0", 4)), HasSubstr("UTF-16"));
  EXPECT_THAT(refusal("us_km_s,up_km_s\n"), HasSubstr("no rows of data"));
  EXPECT_THAT(refusal("us_km_s,up_km_s\n4,0\n"), HasSubstr("no compressed state"));
}

}  // namespace
}  // namespace whipple::eos::experiments
