// SPDX-License-Identifier: BSD-3-Clause
// Ballistic limit equations against numbers computed by hand, and where they do not apply.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "src/core/base/csv.hpp"
#include "src/core/base/error.hpp"
#include "src/shields/equation_forms.hpp"
#include "src/shields/equations.hpp"
#include "tests/folders.hpp"

namespace whipple::shields {
namespace {

using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double ksi = 6894757.293168;

Sheet sheet(double thickness) {
  return {
      .alloy = "6061-T6", .thickness = thickness, .density = 2700.0, .yield = 40.0 * ksi, .hardness = 95.0};
}

/// Returns the shield of the worked numbers, with a number of bumpers.
Impact impact(double velocity, double angle, std::size_t bumpers) {
  Impact made;
  made.projectile = {
      .alloy = "2017-T4", .diameter = 3e-3, .velocity = velocity, .angle = angle, .density = 2800.0};
  for (std::size_t k = 0; k < bumpers; ++k) made.shield.bumpers.push_back({sheet(1.2e-3), 0.10});
  made.shield.wall = sheet(bumpers == 0 ? 4.4e-3 : 3.2e-3);
  return made;
}

/// Reads the rows of tests/data/shields/ble_worked_numbers.csv: speed, angle, six diameters in cm.
std::vector<std::vector<double>> worked_rows() {
  std::ifstream file(whipple::tests::source_folder() + "/tests/data/shields/ble_worked_numbers.csv");
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'v') continue;
    std::vector<double> row;
    for (const std::string& cell : csv_cells(line)) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

TEST(BallisticLimit, WorkedNumbers) {
  const auto rows = worked_rows();
  ASSERT_EQ(rows.size(), 33U);
  const std::vector<std::pair<Equation, std::size_t>> columns = {{Equation::nno_1993, 1},
                                                                 {Equation::nno_2001, 1},
                                                                 {Equation::jsc_2011, 1},
                                                                 {Equation::single_perforation, 0},
                                                                 {Equation::single_detached_spall, 0},
                                                                 {Equation::single_incipient_spall, 0}};
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 8U);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto [equation, bumpers] = columns[k];
      const double d = critical_diameter(equation, impact(1e3 * row[0], row[1] * degree, bumpers));
      EXPECT_NEAR(100.0 * d, row[2 + k], 0.6e-4)  // four digits are given
          << word_of(equation) << " at " << row[0] << " km/s, " << row[1] << " degrees";
    }
  }
}

TEST(BallisticLimit, IsContinuousInSpeed) {
  for (const double angle : {0.0, 30.0, 60.0}) {
    for (const auto& word : words(Equation{})) {
      Impact at = impact(1e3, angle * degree, word.value == Equation::srl_2008 ? 2 : 1);
      if (reason_against(word.value, at).find("bumper") != std::string::npos)
        at = impact(1e3, angle * degree, 0);
      if (word.value == Equation::stuffed_2001) at.shield.stuffing.areal_density = 4.0;
      if (word.value == Equation::foam_2009) {
        at.shield.foam.density = 190.0;
        at.shield.bumpers[0].spacing = 0.0254;
      }
      double last = critical_diameter(word.value, at);
      for (double v = 1005.0; v < 16000.0; v += 5.0) {
        at.projectile.velocity = v;
        const double now = critical_diameter(word.value, at);
        ASSERT_NEAR(now, last, 0.01 * last) << word_of(word.value) << " at " << v << " m/s";
        last = now;
      }
    }
  }
}

// The border of the low branch ends at 7 km/s, where the high one begins. They meet there in the limit of no bumper.
TEST(BallisticLimit, OfFoilsJumpsAtMostAtSevenKilometresPerSecond) {
  const auto diameter = [](double foil, double v) {
    Impact at = impact(v, 0.0, 1);
    at.shield.bumpers[0].sheet.thickness = foil;
    return critical_diameter(Equation::jsc_2011, at);
  };
  for (const double foil : {1e-6, 5e-6, 20e-6}) {
    for (double v = 1005.0; v < 16000.0; v += 5.0) {
      if (v - 5.0 <= 7000.0 && v > 7000.0) continue;
      ASSERT_NEAR(diameter(foil, v), diameter(foil, v - 5.0), 0.01 * diameter(foil, v))
          << foil << " at " << v;
    }
  }
  const auto jump = [&](double foil) { return diameter(foil, 7000.001) / diameter(foil, 6999.999) - 1.0; };
  EXPECT_NEAR(jump(1e-6), 0.009, 0.0005);
  EXPECT_NEAR(jump(5e-6), 0.042, 0.0005);
  EXPECT_NEAR(jump(20e-6), 0.0, 1e-4);
}

// By hand from the formulas in equation_forms.hpp: two bumpers of 0.12 cm 10 cm apart, wall 0.32 cm, 40 ksi.
TEST(BallisticLimit, ThreeSheets) {
  const auto cm = [](double v, double angle) {
    return 100.0 * critical_diameter(Equation::srl_2008, impact(v, angle * degree, 2));
  };
  // (0.56569 + 0.12)/1.4 + 0.12 = 0.609775; over 0.6 * 1.67332 * 2^(2/3) = 1.593738; to the power 18/19.
  EXPECT_NEAR(cm(2000.0, 0.0), std::pow(0.6097753 / 1.593738, 18.0 / 19.0), 1e-6);
  // S1^(1/3) (0.12 + 0.48)^(2/3) = 2.154435 * 0.711379 = 1.532619; 0.1 * 4.641589 * 0.683990 = 0.317480.
  const double high = 1.155 * (1.532619 + 0.317480) * 0.829827 / (0.542884 * 1.409460 * 1.116679 * 4.0);
  EXPECT_NEAR(cm(8000.0, 0.0), high, 2e-5);
  EXPECT_GT(cm(2000.0, 45.0), cm(2000.0, 0.0));
}

// Values of NASA's foam panels as computed by hand in the source of the shots (1 inch, 40 pores per inch, 40 ksi).
TEST(BallisticLimit, FoamPanels) {
  Impact panel = impact(6630.0, 0.0, 1);
  panel.shield.bumpers[0] = {sheet(0.254e-3), 25.4e-3};
  panel.shield.wall = sheet(0.254e-3);
  panel.shield.foam.density = 189.0;
  const std::vector<std::array<double, 2>> known = {{2.25, 1.66}, {3.0, 1.84},  {4.0, 2.08},
                                                    {5.0, 1.90},  {6.63, 1.70}, {7.4, 1.62}};
  for (const auto& [v, mm] : known) {
    panel.projectile.velocity = 1e3 * v;
    EXPECT_NEAR(1e3 * critical_diameter(Equation::foam_2009, panel), mm, 0.006) << v;
  }
  panel.projectile.velocity = 6630.0;
  panel.projectile.angle = 45.0 * degree;
  EXPECT_NEAR(1e3 * critical_diameter(Equation::foam_2009, panel), 2.24, 0.006);
  panel.shield.bumpers[0].spacing = 0.1;
  EXPECT_THAT(reason_against(Equation::foam_2009, panel), HasSubstr("12 to 52 mm"));
}

// By hand: bumper 0.12 cm 2.7, fabric 0.4 g/cm^2, wall 0.32 cm, spacing 10 cm, 40 ksi, sphere 2.8 g/cm^3.
TEST(BallisticLimit, StuffedShield) {
  Impact stuffed = impact(2000.0, 0.0, 1);
  stuffed.shield.stuffing.areal_density = 4.0;
  // A = 0.324 + 0.4 = 0.724; 0.32 + 0.37 A = 0.58788; 2.35 * 0.58788 / (1.673320 * 1.587401).
  EXPECT_NEAR(100.0 * critical_diameter(Equation::stuffed_2001, stuffed),
              2.35 * 0.58788 / (1.673320 * 1.587401), 1e-5);
  stuffed.projectile.velocity = 8000.0;
  // The fabric is 0.4/1.588 = 25 % of the shield: K = 0.6. 0.6 * 0.864^(1/3) * 10^(2/3) / (2.8 * 8)^(1/3).
  const double high = 0.6 * std::cbrt(0.864) * std::pow(10.0, 2.0 / 3.0) / std::cbrt(22.4);
  EXPECT_NEAR(100.0 * critical_diameter(Equation::stuffed_2001, stuffed), high, 1e-9);
  stuffed.shield.stuffing.areal_density = 1.6;  // 0.16/1.348 = 11.9 %: K = 0.45
  EXPECT_NEAR(100.0 * critical_diameter(Equation::stuffed_2001, stuffed), 0.75 * high, 1e-9);
}

TEST(BallisticLimit, DenseProjectileHasAnotherExponent) {
  Impact dense = impact(5000.0, 0.0, 0);
  dense.projectile.density = 2.0 * 2700.0;
  Impact light = dense;
  light.projectile.density = 1.4 * 2700.0;
  const auto crater = [](const Impact& at) {
    return std::pow(critical_diameter(Equation::single_perforation, at), -19.0 / 18.0);
  };
  EXPECT_NEAR(crater(dense) / crater(light), std::pow(2.0, 2.0 / 3.0) / std::sqrt(1.4), 1e-9);
}

TEST(BallisticLimit, IsRefusedByName) {
  try {
    static_cast<void>(critical_diameter(Equation::srl_2008, impact(5000.0, 0.0, 1)));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("srl_2008 does not apply: it is for 2 bumpers, the shield has 1"));
  }
  Impact stuffed = impact(5000.0, 0.0, 1);
  stuffed.shield.stuffing.areal_density = 1.0;
  EXPECT_THAT(reason_against(Equation::nno_1993, stuffed), HasSubstr("stuffed"));
  EXPECT_EQ(reason_against(Equation::stuffed_2001, stuffed), "");
  EXPECT_THAT(reason_against(Equation::stuffed_2001, impact(5000.0, 0.0, 1)), HasSubstr("no stuffing"));
}

// NNO above 7 km/s is the design equation solved for the diameter: its own critical sphere needs the wall it has.
TEST(BallisticLimit, DesignAgreesWithNno) {
  Impact at = impact(9000.0, 0.0, 1);
  at.projectile.diameter = critical_diameter(Equation::nno_1993, at);
  const Design design = whipple_design(at);
  EXPECT_NEAR(design.wall, 3.2e-3, 0.01 * 3.2e-3);  // the constants are rounded
  EXPECT_NEAR(design.bumper, 0.25 * at.projectile.diameter * 2.8 / 2.7, 1e-9);
  at.projectile.velocity = 6000.0;
  EXPECT_THROW(static_cast<void>(whipple_design(at)), InputError);
}

}  // namespace
}  // namespace whipple::shields
