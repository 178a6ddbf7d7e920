// SPDX-License-Identifier: BSD-3-Clause
// `whipple eos` as a user calls it: every subcommand, pairs of quantities, several materials, files,
// refusals.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/folders.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::app {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class EosCommand : public ::testing::Test {
 protected:
  [[nodiscard]] int run(const std::string& arguments) const {
    const int status =
        std::system(fmt::format("cd '{}' && '{}' eos {} > output.txt 2>&1", folder.path().string(),
                                whipple::tests::program("whipple"), arguments)
                        .c_str());
    return WEXITSTATUS(status);
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream file(folder.path() / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  [[nodiscard]] std::string output() const { return read("output.txt"); }

  TemporaryFolder folder;
};

TEST_F(EosCommand, StateTakesEveryPairOfQuantities) {
  ASSERT_EQ(run("state copper --density '10 g/cm^3' --temperature '1000 K' --csv state.csv"), 0) << output();
  EXPECT_THAT(output(), ContainsRegex("pressure +[0-9.]+ +GPa"));
  EXPECT_THAT(output(), ContainsRegex("Gibbs energy +[0-9.]+ +kJ/kg"));
  EXPECT_THAT(output(), ContainsRegex("isentropic bulk modulus +[0-9.]+ +GPa"));
  EXPECT_THAT(output(), ContainsRegex("volume expansion at constant pressure +[0-9.]+ +1e-6/K"));
  // The numbers of the CSV, with all their digits, name the same state again.
  std::istringstream lines(read("state.csv"));
  std::string title, header, row, cell;
  std::getline(lines, title);
  std::getline(lines, header);
  std::getline(lines, row);
  EXPECT_EQ(header.substr(0, 43), "rho_kg_m3,V_over_V0,P_GPa,T_K,e_kJ_kg,c_km_");
  std::vector<std::string> cells;
  for (std::istringstream words(row); std::getline(words, cell, ',');) cells.push_back(cell);
  const std::string density = fmt::format("--density '{} kg/m^3'", cells[0]),
                    pressure = fmt::format("--pressure '{} GPa'", cells[2]);
  for (const std::string& pair :
       {density + fmt::format(" --energy '{} kJ/kg'", cells[4]), density + " " + pressure,
        density + fmt::format(" --entropy '{} J/(kg K)'", cells[6]),
        pressure + fmt::format(" --temperature '{} K'", cells[3])}) {
    ASSERT_EQ(run("state copper " + pair), 0) << output();
    EXPECT_THAT(output(), ContainsRegex("density +10000 +kg/m")) << pair;
    EXPECT_THAT(output(), ContainsRegex("temperature +1000 +K")) << pair;
  }
  EXPECT_EQ(run("state copper --density '9 g/cm^3'"), 2);
  EXPECT_THAT(output(), HasSubstr("a state is named by two quantities"));
  EXPECT_EQ(run("state copper --density '9 g/cm^3' --pressure '-90 GPa'"), 3);
  EXPECT_THAT(output(), HasSubstr("below the coldest state of model gray"));
}

TEST_F(EosCommand, AListOfStatesIsTheStatesOneByOne) {
  const auto rows = [&] {
    std::vector<std::string> all;
    std::istringstream lines(output());
    for (std::string line; std::getline(lines, line);) all.push_back(line);
    return all;
  };
  std::ofstream(folder.path() / "states.csv")
      << "# two columns of each row\ndensity [g/cm^3],temperature [K],pressure\r\n10,1000,\n\n,300,5e10\n";
  ASSERT_EQ(run("state copper --states states.csv --csv -"), 0) << output();
  const std::vector<std::string> list = rows();
  ASSERT_EQ(list.size(), 4U) << "title, names and two states, nothing else: " << output();
  ASSERT_EQ(run("state copper --density '10 g/cm^3' --temperature '1000 K' --csv -"), 0) << output();
  EXPECT_EQ(rows()[2], list[2]);
  ASSERT_EQ(run("state copper --pressure '50 GPa' --temperature '300 K' --csv -"), 0) << output();
  EXPECT_EQ(rows()[2], list[3]);
  std::ofstream(folder.path() / "bad.csv") << "density [g/cm^3],temprature\n";
  EXPECT_EQ(run("state copper --states bad.csv"), 2);
  EXPECT_THAT(output(), AllOf(HasSubstr("bad.csv:1:"), HasSubstr("did you mean \"temperature\"?")));
  std::ofstream(folder.path() / "bad.csv") << "density [g/cm^3],temperature\n9,-3\n";
  EXPECT_EQ(run("state copper --states bad.csv"), 2);
  EXPECT_THAT(output(), AllOf(HasSubstr("bad.csv:2:"), HasSubstr("temperature")));
}

TEST_F(EosCommand, QuantitiesThatNoMatterHasAreInput) {
  for (const char* arguments :
       {"state copper --density '-1 kg/m^3' --temperature '300 K'", "match copper copper --velocity '0 m/s'",
        "match copper copper --velocity '-1 km/s'", "isotherm copper --temperature '0 K'",
        "hugoniot copper --initial-density '0 kg/m^3'", "isentrope copper --to '-2 g/cm^3'",
        "cold copper --from '0 kg/m^3'", "state copper --density 9000 --temperature '300 K'",
        "hugoniot copper --to 300"}) {
    EXPECT_EQ(run(arguments), 2) << arguments << output();
  }
}

TEST_F(EosCommand, SaysWhatAStateBeyondTheModelsPurposeIs) {
  ASSERT_EQ(run("state copper --density '4 g/cm^3' --temperature '300 K'"), 0);
  EXPECT_THAT(output(), ContainsRegex("names the surface of the model.*condensed, with voids: 0.26 %"));
  ASSERT_EQ(run("state copper --density '9 g/cm^3' --temperature '2e8 K'"), 0);
  EXPECT_THAT(output(), HasSubstr("2e+08 K is beyond 1e+05 K, to which the audit finds the model valid"));
  ASSERT_EQ(run("state copper --density '9 g/cm^3' --temperature '2000 K'"), 0);
  EXPECT_THAT(output(), Not(HasSubstr("beyond")));
}

TEST_F(EosCommand, SeveralMaterialsShareATableAndACsv) {
  ASSERT_EQ(run("hugoniot copper aluminium --to '100 GPa' --points 3 --csv two.csv"), 0) << output();
  EXPECT_THAT(output(), ContainsRegex("aluminium 1100-O +[0-9.]+ +[0-9.]+ +[0-9.]+ +[0-9.]+ +100 "));
  EXPECT_THAT(read("two.csv"), HasSubstr("material,up_km_s,us_km_s,rho_kg_m3"));
  EXPECT_THAT(read("two.csv"), ContainsRegex("\ncopper,[0-9.]+,[0-9.]+,"));
}

TEST_F(EosCommand, PorousAndReflectedHugoniots) {
  ASSERT_EQ(run("hugoniot copper --initial-density '6 g/cm^3' --pressure '40 GPa'"), 0) << output();
  EXPECT_THAT(output(), HasSubstr("Hugoniot from 6 g/cm^3"));
  ASSERT_EQ(run("hugoniot copper --reflected '50 GPa' --to '100 GPa' --points 2"), 0) << output();
  EXPECT_THAT(output(), HasSubstr("off a rigid wall 128.90 GPa"));
  EXPECT_EQ(run("hugoniot copper --initial-density '9.5 g/cm^3'"), 2);
  EXPECT_THAT(output(), HasSubstr("above the reference density of 8944.54 kg/m^3"));
}

TEST_F(EosCommand, ACurveEndsWhereItsModelEnds) {
  ASSERT_EQ(run("hugoniot aluminium --to '4000 GPa' --points 6"), 0) << output();
  EXPECT_THAT(output(),
              HasSubstr("the curve ends after 2 points: Hugoniot at the pressure: beyond the maximum "
                        "density of model gray"));
  EXPECT_EQ(run("hugoniot aluminium --pressure '4000 GPa'"), 3);
}

TEST_F(EosCommand, MeltColdDomeAndMatchPrintTheirFigures) {
  ASSERT_EQ(run("melt copper --points 2"), 0) << output();
  EXPECT_THAT(output(), ContainsRegex("0 +1326\\.79 +1326\\.79"));
  EXPECT_THAT(output(),
              ContainsRegex("after release to 1 bar: melting begins 13[567]\\..*, is complete 1[89].*, "
                            "vaporisation begins 30[123]\\."));
  ASSERT_EQ(run("cold copper --points 3"), 0) << output();
  EXPECT_THAT(output(), HasSubstr("limit in tension -19.7"));
  ASSERT_EQ(run("match copper aluminium copper --velocity '5.55 km/s'"), 0) << output();
  EXPECT_THAT(output(), ContainsRegex("copper \\(shocked\\) +3\\.759[0-9]* .*105\\.7"));
  EXPECT_THAT(output(), HasSubstr("free surface of copper"));
  EXPECT_EQ(run("match copper --velocity '5 km/s'"), 2);
  EXPECT_THAT(output(), HasSubstr("two materials at least"));
  EXPECT_EQ(run("melt aluminium_mie_gruneisen"), 3);
  EXPECT_THAT(output(), HasSubstr("does not melt"));
}

// The band of a fitted material: the deviation of Us is that of C and S with their correlation, and the
// thresholds of melting come with theirs.
TEST_F(EosCommand, SamplesDrawTheBandOfTheHugoniot) {
  std::ofstream(folder.path() / "fitted.toml") << R"toml(name = "fitted"
source = "test"
[eos]
model = "gray"
molar_mass = "63.546 g/mol"
reference_specific_volume = "0.1118 cm^3/g"
hugoniot_intercept = "3.94 km/s"
hugoniot_slope = 1.489
gruneisen = 1.97
gruneisen_slope = 1.5
electronic_heat_coefficient = "4.9e-7 kJ/(mol K^2)"
melting_temperature = "1790 K"
vapour_attraction = "0.62 kJ cm^3/g^2"
[covariance]
names = ["hugoniot_intercept", "hugoniot_slope", "melting_temperature"]
units = ["m/s", "", "K"]
[covariance.matrix]
hugoniot_intercept = [400.0, -0.16, 0.0]
hugoniot_slope = [-0.16, 1e-4, 0.0]
melting_temperature = [0.0, 0.0, 400.0]
)toml";
  ASSERT_EQ(
      run("hugoniot fitted.toml --samples 60 --from '1 km/s' --to '3 km/s' --points 3 --csv band.csv --plot "
          "band.png"),
      0)
      << output();
  EXPECT_THAT(output(),
              ContainsRegex("melting behind the shock begins at 2[0-9][0-9]\\.[0-9] \\+- [0-9.]+ GPa"));
  EXPECT_THAT(output(), HasSubstr("melting on release begins at"));
  EXPECT_EQ(read("band.png").substr(1, 3), "PNG");
  std::istringstream lines(read("band.csv"));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 32), "up_km_s,us_km_s,sd-us_km_s,P_GPa");
  for (const double up : {1.0, 2.0, 3.0}) {
    ASSERT_TRUE(std::getline(lines, line));
    std::vector<double> cells;
    std::string cell;
    for (std::istringstream words(line); std::getline(words, cell, ',');)
      cells.push_back(std::strtod(cell.c_str(), nullptr));
    EXPECT_NEAR(cells[0], up, 1e-12);
    // var(C + S up) = 400 - 2 * 0.16 up + 1e-4 up^2 in m/s, up in m/s; 60 draws know it to a tenth.
    const double u = 1e3 * up;
    const double deviation = 1e-3 * std::sqrt(400.0 - 0.32 * u + 1e-4 * u * u);
    // At 3 km/s some samples melt, which adds to it.
    if (up < 2.5) {
      EXPECT_NEAR(cells[2], deviation, 0.4 * deviation) << up;
    }
    EXPECT_NEAR(cells[1], 3.94 + 1.489 * up, 0.02) << up;
    EXPECT_EQ(cells.back(), 60.0);
  }
  // Refusals: no covariance; entries that contradict the names.
  EXPECT_EQ(run("hugoniot copper --samples 5"), 2);
  EXPECT_THAT(output(), HasSubstr("has no table [covariance]"));
  std::string text = read("fitted.toml");
  text.replace(text.find("hugoniot_slope = [-0.16, 1e-4, 0.0]"), 35, "hugoniot_slope = [-0.16, 1e-4]     ");
  std::ofstream(folder.path() / "short.toml") << text;
  EXPECT_EQ(run("hugoniot short.toml --samples 5"), 2);
  EXPECT_THAT(output(), HasSubstr("2 entries in a covariance of 3 constants"));
}

TEST_F(EosCommand, FiguresAndDiagrams) {
  for (const char* kind : {"p-t", "p-rho"}) {
    ASSERT_EQ(run(fmt::format("plot copper --kind {0} -o {0}.png", kind)), 0) << output();
    EXPECT_EQ(read(fmt::format("{}.png", kind)).substr(1, 3), "PNG") << kind;
  }
  EXPECT_EQ(run("plot copper --kind p-t -o p-t.png"), 2);
  EXPECT_THAT(output(), HasSubstr("exists; --force overwrites it"));
  ASSERT_EQ(run("plot copper aluminium --kind p-v -o two.pdf --with cu_hugoniot_marsh1980 "
                "al_isotherm_298K_dewaele2004"),
            0)
      << output();
  EXPECT_EQ(read("two.pdf").substr(0, 4), "%PDF");
  ASSERT_EQ(run("plot aluminium --kind us-up --with cu_hugoniot_marsh1980 -o us-up.svg"), 0) << output();
  EXPECT_THAT(read("us-up.svg"), HasSubstr("particle velocity (km/s)"));
  ASSERT_EQ(run("melt copper --points 5 --plot melt.svg --with cu_melting --y solidus_K"), 2);
  EXPECT_THAT(output(), HasSubstr("no column that gives solidus_K"));
  EXPECT_EQ(run("plot copper --kind t-s -o a.png"), 2);
  EXPECT_EQ(run("isotherm copper --plot a.png --y entropy"), 2);
  EXPECT_THAT(output(), HasSubstr("no column 'entropy'; the columns are rho_kg_m3"));
}

}  // namespace
}  // namespace whipple::app
