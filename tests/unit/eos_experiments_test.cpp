// SPDX-License-Identifier: BSD-3-Clause
// Measured data and their comparison, called without the command line: data made from the model have no deviation, and
// those shifted by a known amount have that one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "eos/experiments/comparison.hpp"
#include "eos/experiments/measured_table.hpp"
#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::eos::experiments {
namespace {

constexpr double c0 = 5328.0, slope = 1.338;  // of test::aluminium_2024

TEST(EosExperiments, ADeviationIsThatOfTheData) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "shocks.csv";
  {
    std::ofstream text(file);
    text << "# a source\n# material: aluminium\nup_km_s,us_km_s\n";
    for (const double up : {1.0, 2.0, 3.0})
      text << fmt::format("{},{:.12g}\n", up, (1e-3 * c0 + slope * up) / 1.02);
  }
  const std::vector<Experiment> found = read_experiments(file);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, ExperimentKind::shock_velocity);
  EXPECT_EQ(found[0].source, "a source");
  EXPECT_TRUE(belongs_to(found[0], "Aluminium 1100-O"));
  EXPECT_FALSE(belongs_to(found[0], "copper"));
  const test::MieGruneisenEos eos(test::aluminium_2024());
  const State initial = eos.state(eos.reference_density(), eos.reference_energy());
  const Comparison comparison = compare(eos, initial, found[0]);
  EXPECT_EQ(comparison.points, 3);
  EXPECT_NEAR(comparison.mean, 2.0, 1e-6);  // % of Us
  EXPECT_NEAR(comparison.rms, 2.0, 1e-6);
  const std::vector<double> ratio = measured_quantity(file, "V_over_V0");
  EXPECT_NEAR(ratio[0], 1.0 - 1000.0 / found[0].ordinate[0], 1e-12);
  EXPECT_THROW(measured_quantity(file, "T_K"), InputError);
}

TEST(EosExperiments, HeadingsNameQuantities) {
  EXPECT_EQ(MeasuredTable::quantity_of("us_km_s"), Quantity::shock_velocity);
  EXPECT_EQ(MeasuredTable::quantity_of("P [GPa]"), Quantity::pressure);
  EXPECT_EQ(MeasuredTable::quantity_of("rho0_g_cm3"), Quantity::initial_density);
  EXPECT_EQ(MeasuredTable::quantity_of("solidus_K"), std::nullopt);
  for (const char* heading :
       {"us_err_km_s", "sigma_us [m/s]", "dus (km/s)", "P_error_GPa", "us_err [%]", "us_unc_%"})
    EXPECT_EQ(MeasuredTable::quantity_of(heading), std::nullopt) << heading;
}

/// A table of measurements as it is read.
Experiment experiment_of(const std::string& text, const std::string& name = "points.csv") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / name) << text;
  return read_experiments(folder.path() / name).front();
}

class Isotherms : public ::testing::Test {
 protected:
  test::MieGruneisenEos eos{test::aluminium_2024()};
  State initial = eos.state(eos.reference_density(), eos.reference_energy());
  double ambient = density_at_pressure(eos, 0.0, 298.0), hot = density_at_pressure(eos, 0.0, 900.0);

  /// Largest deviation of the model from points of its own isotherm of 900 K, Pa.
  [[nodiscard]] double largest(const std::string& headings, const auto& row,
                               const std::string& comment = "900 K") const {
    std::string text = fmt::format("# {}\n{}\n", comment, headings);
    for (const double density : {1.02 * hot, 1.1 * hot, 1.3 * hot})
      text += row(eos.state_at_temperature(density, 900.0).pressure * 1e-9, density) + "\n";
    const Comparison own = compare(eos, initial, experiment_of(text));
    EXPECT_EQ(own.points, 3) << text;
    EXPECT_TRUE(own.porous.empty() && own.denser.empty()) << text;
    return std::abs(own.maximum);
  }
};

// Of points of its own isotherms the model has no deviation, however they are written, at any temperature.
TEST_F(Isotherms, OfAnyTemperatureLeaveNoDeviation) {
  constexpr double exact = 1e4;  // Pa of up to 40 GPa, by the digits of the tables
  EXPECT_LT(
      largest("P_GPa,rho_kg_m3", [](double p, double rho) { return fmt::format("{:.12g},{:.12g}", p, rho); }),
      exact);
  // Density of the sample at rest, at whichever temperature: densities stay absolute.
  for (const double rest : {ambient, hot, 2000.0}) {
    EXPECT_LT(
        largest("P_GPa,rho_kg_m3,rho0_kg_m3",
                [&](double p, double rho) { return fmt::format("{:.12g},{:.12g},{:.12g}", p, rho, rest); }),
        exact);
  }
  EXPECT_LT(largest("P_GPa,V_cm3_g",
                    [](double p, double rho) { return fmt::format("{:.12g},{:.12g}", p, 1e3 / rho); }),
            exact);
  const auto ratio_to = [&](double reference) {
    return [reference](double p, double rho) { return fmt::format("{:.12g},{:.12g}", p, reference / rho); };
  };
  EXPECT_LT(largest("P_GPa,V_over_V0", ratio_to(ambient)), exact);
  EXPECT_LT(largest("P_GPa,V_over_V0", ratio_to(hot), "900 K, V0 at 900 K"), exact);
  EXPECT_GT(largest("P_GPa,V_over_V0", ratio_to(hot)), 1e9);  // V0 of another temperature shows
  EXPECT_LT(largest(
                "P_GPa,rho_kg_m3,T_K",
                [](double p, double rho) { return fmt::format("{:.12g},{:.12g},900", p, rho); }, "no word"),
            exact);
}

// Several isotherms in one table, with a row at 1 bar that is the volume of reference.
TEST_F(Isotherms, ATemperatureOfEachRowCounts) {
  constexpr double atom = 27.0 * 1.66053906660e-27 * 1e30;  // A^3 kg/m^3
  std::string text = "P_GPa,atomic_volume_A3,T_K\n";
  text += fmt::format("0.0001,{:.12g},298\n", atom / ambient);
  text += fmt::format("0,{:.12g},900\n", atom / hot);
  for (const double temperature : {300.0, 600.0, 1200.0}) {
    const double density = 1.15 * ambient;
    text +=
        fmt::format("{:.12g},{:.12g},{}\n", eos.state_at_temperature(density, temperature).pressure * 1e-9,
                    atom / density, temperature);
  }
  const Experiment table = experiment_of(text);
  EXPECT_EQ(table.kind, ExperimentKind::isotherm);
  EXPECT_TRUE(std::isnan(table.temperature));
  EXPECT_EQ(table.volume_temperature, 298.0);
  EXPECT_EQ(table.left_out.size(), 1U);  // the row of reference
  const Comparison own = compare(eos, initial, table);
  EXPECT_EQ(own.points, 4);  // the hot row at rest is one
  EXPECT_LT(std::abs(own.maximum), 1e4);
}

TEST_F(Isotherms, PressuresAndTemperaturesBelongToWhatTheTableSays) {
  const Hugoniot hugoniot(eos, initial.density, initial.specific_internal_energy);
  std::string rows = "P_GPa,T_K\n";
  for (const double pressure : {20.0, 60.0})
    rows +=
        fmt::format("{},{:.12g}\n", pressure, 1.01 * hugoniot.at_pressure(pressure * 1e9).state.temperature);
  const Experiment shocks = experiment_of("# Hugoniot temperatures below melting\n" + rows);
  EXPECT_EQ(shocks.kind, ExperimentKind::shock_temperature);
  EXPECT_NEAR(compare(eos, initial, shocks).mean, -100.0 / 101.0, 1e-6);  // % of T
  EXPECT_EQ(experiment_of("# melting line up to the shock\n" + rows).kind, ExperimentKind::melting);
  EXPECT_EQ(experiment_of(rows, "al_hugoniot.csv").kind, ExperimentKind::shock_temperature);
  EXPECT_THROW(experiment_of(rows), InputError);
}

// Columns of errors of every kind are one standard deviation of their quantity, SI.
TEST(EosExperiments, ErrorColumnsAreThoseOfTheirQuantity) {
  const Experiment shocks =
      experiment_of("up_km_s,us_km_s,us_err_km_s,sigma_up [m/s]\n1,6.6,0.05,12\n2,8,,12\n");
  EXPECT_TRUE(shocks.states_errors);
  EXPECT_NEAR(shocks.ordinate_error[0], 50.0, 1e-9);
  EXPECT_TRUE(std::isnan(shocks.ordinate_error[1]));
  EXPECT_NEAR(shocks.abscissa_error[1], 12.0, 1e-9);
  const Experiment ramp =
      experiment_of("# an isentrope\nP_GPa,rho_g_cm3,rho0_g_cm3,P_err [%],drho_g_cm3\n50,4,2.7,4,0.04\n");
  EXPECT_NEAR(ramp.ordinate_error[0], 2e9, 1.0);
  EXPECT_NEAR(ramp.abscissa_error[0], 0.01 * 2.7 / 4, 1e-9);
  const Experiment melt = experiment_of("# melting line\nP_GPa,T_K,T_err_K\n10,1300,25\n");
  EXPECT_NEAR(melt.ordinate_error[0], 25.0, 1e-9);
  EXPECT_EQ(melt.abscissa_error[0], 0.0);
  const Experiment none = experiment_of("up_km_s,us_km_s,error of all\n1,6.6,3\n");
  EXPECT_FALSE(none.states_errors);
  ASSERT_EQ(none.remarks.size(), 1U);
  EXPECT_NE(none.remarks[0].find("error of all"), std::string::npos);
}

// A word may name several quantities, and a quantity may have several columns: errors are those of the column that is
// taken, wherever they stand; others are named.
TEST(EosExperiments, ErrorColumnsBelongToTheColumnThatIsTaken) {
  for (const char* headings :
       {"P_GPa,V [A3],V_err [%]", "P_GPa,V,V_err\nGPa,A3,%", "P_GPa,V [A3],V_err [A3]"}) {
    const bool percent = std::string(headings).find('%') != std::string::npos;
    const Experiment atoms = experiment_of(fmt::format("# isotherm, 298 K\n{}\n0,10,{}\n5,8,{}\n", headings,
                                                       percent ? 1 : 0.1, percent ? 2 : 0.16));
    ASSERT_TRUE(atoms.states_errors) << headings;
    EXPECT_NEAR(atoms.abscissa_error[0], 0.02 * 0.8, 1e-9) << headings;  // of V/V0
    EXPECT_TRUE(atoms.remarks.empty()) << headings;
  }
  const std::string revised =
      "# isotherm, 298 K\nP_old_err_GPa,P_old_GPa,P_revised_GPa,P_revised_err_GPa,V/V0\n";
  const Experiment scales = experiment_of(revised + "9,4,5,0.5,0.9\n");
  EXPECT_NEAR(scales.ordinate[0], 5e9, 1.0);
  EXPECT_NEAR(scales.ordinate_error[0], 5e8, 1.0);
  ASSERT_EQ(scales.remarks.size(), 1U);
  EXPECT_NE(scales.remarks[0].find("P_old_err_GPa"), std::string::npos);
  const Experiment other_word = experiment_of("shock velocity [km/s],up [km/s],us_err [km/s]\n6,1,0.1\n");
  EXPECT_NEAR(other_word.ordinate_error[0], 100.0, 1e-9);
  // The diameter of a specimen is no quantity of the table, and its error not one of the shock velocity.
  for (const char* headings : {"us [km/s],up [km/s],D [mm],D_err [%]", "us_km_s,up_km_s,D_mm,dD_%",
                               "us,up,D,sigma_D\nkm/s,km/s,mm,%"}) {
    const Experiment diameter = experiment_of(std::string(headings) + "\n6,1,12,3\n");
    EXPECT_FALSE(diameter.states_errors) << headings;
    ASSERT_FALSE(diameter.remarks.empty()) << headings;
  }
  const Experiment shock_speed = experiment_of("D [km/s],up [km/s],D_err [%]\n6,1,3\n");
  EXPECT_NEAR(shock_speed.ordinate_error[0], 180.0, 1e-9);
  const Experiment absent = experiment_of("us_km_s,up_km_s,rho_err [%]\n6,1,3\n");
  EXPECT_FALSE(absent.states_errors);
  ASSERT_EQ(absent.remarks.size(), 1U);
}

// Values at zero pressure: those of the model itself have no deviation, with a decimal comma as well.
TEST(EosExperiments, HeatCapacitiesAndExpansionsAreThoseAtZeroPressure) {
  const test::MieGruneisenEos eos(test::aluminium_2024());
  const State initial = eos.state(eos.reference_density(), eos.reference_energy());
  std::string heat = "T_K;cp [J/kgK]\n", expansion = "T_K;alpha_lin_1e-6_per_K\n";
  for (const double temperature : {320.0, 500.0}) {
    const State state = eos.state_at_temperature(density_at_pressure(eos, 0.0, temperature), temperature);
    heat += fmt::format("{};{:.12g}\n", temperature, state.isobaric_heat_capacity);
    expansion += fmt::format("{};{:.12g}\n", temperature, 1e6 * state.thermal_expansion / 3.0);
  }
  for (std::string* text : {&heat, &expansion}) {
    for (const bool comma : {false, true}) {
      if (comma) std::ranges::replace(*text, '.', ',');
      const Experiment experiment = experiment_of(*text);
      EXPECT_EQ(experiment.kind, text == &heat ? ExperimentKind::heat_capacity : ExperimentKind::expansion);
      const Comparison comparison = compare(eos, initial, experiment);
      EXPECT_EQ(comparison.points, 2);
      EXPECT_NEAR(comparison.maximum, 0.0, 1e-6);  // % of the measured value
    }
  }
}

TEST(EosExperiments, NumbersWithTwoMeaningsAreRefused) {
  EXPECT_THROW(experiment_of("us_km_s;up_km_s\n1,234.5;0.3\n"), InputError);
  EXPECT_THROW(experiment_of("us_km_s,up_km_s\n5,3,0,3\n"), InputError);
}

}  // namespace
}  // namespace whipple::eos::experiments
