// SPDX-License-Identifier: BSD-3-Clause
// `whipple compare` as a user calls it: table, files, refusals.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/folders.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::app {
namespace {

using ::testing::HasSubstr;

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class CompareCommand : public ::testing::Test {
 protected:
  [[nodiscard]] int run(const std::string& arguments) const {
    const int status =
        std::system(fmt::format("cd '{}' && '{}' compare {} > output.txt 2>&1", folder.path().string(),
                                whipple::tests::program("whipple"), arguments)
                        .c_str());
    return WEXITSTATUS(status);
  }
  [[nodiscard]] std::string output() const { return read_text(folder.path() / "output.txt"); }

  TemporaryFolder folder;
};

TEST_F(CompareCommand, PrintsOneRowPerMaterialAndExperiment) {
  ASSERT_EQ(run("copper copper_md_liu2013 --with cu_hugoniot_marsh1980 cu_isotherm_298K_dewaele2004.csv"), 0)
      << output();
  // Figures of docs/theory/fit.md, section 6, with the library's own files.
  EXPECT_THAT(output(),
              ::testing::ContainsRegex("cu_hugoniot_marsh1980 +Hugoniot +copper +144 .*1\\.18 +\\+0\\.08"));
  EXPECT_THAT(output(),
              ::testing::ContainsRegex("dewaele2004 +isotherm 298 K +copper +41 .*0\\.50 +\\+0\\.08"));
  EXPECT_THAT(output(),
              ::testing::ContainsRegex("dewaele2004 +isotherm 298 K +copper_md_liu2013 +41 .*9\\.75"));
  EXPECT_THAT(output(), HasSubstr("% of Us"));
}

TEST_F(CompareCommand, WritesPointsAndFigureOnce) {
  const std::string arguments = "copper --with cu_isotherm_aip_handbook --csv points.csv --plot figure.png";
  ASSERT_EQ(run(arguments), 0) << output();
  EXPECT_EQ(read_text(folder.path() / "figure.png").substr(1, 3), "PNG");
  const std::string points = read_text(folder.path() / "points.csv");
  EXPECT_EQ(std::count(points.begin(), points.end(), '\n'), 2 + 25);
  EXPECT_EQ(run(arguments), 2);
  EXPECT_THAT(output(), HasSubstr("'points.csv' exists; --force overwrites it"));
  EXPECT_EQ(run(arguments + " --force"), 0) << output();
}

// A hot isotherm of copper itself, as densities with an initial density: no deviation at any temperature.
TEST_F(CompareCommand, AHotIsothermIsComparedAtItsDensities) {
  ASSERT_EQ(
      run("copper --with " + whipple::tests::source_folder() + "/tests/data/eos/copper_isotherm_1500K.csv"),
      0)
      << output();
  EXPECT_THAT(output(), ::testing::ContainsRegex(
                            "isotherm 1500 K +copper +5 +rho .* 0\\.00 +[+-]0\\.00 +[+-]0\\.00 +GPa"));
}

// Beside a fitted material one without errors has its deviations and no band; a warning of many draws is one line.
TEST_F(CompareCommand, FittedMaterialsStandBesideOthers) {
  std::string text =
      read_text(std::filesystem::path(whipple::tests::source_folder()) / "eos/materials/copper.toml");
  text +=
      "\n[covariance]\nnames = [\"hugoniot_intercept\"]\nunits = [\"m/s\"]\n[covariance.matrix]\n"
      "hugoniot_intercept = [400.0]\n";
  std::ofstream(folder.path() / "fitted.toml") << text;
  std::ofstream(folder.path() / "ramp.csv") << "# an isentrope\nP_GPa,V_over_V0\n20,0.9\n50,0.81\n";
  ASSERT_EQ(run("fitted.toml copper --with cu_hugoniot_marsh1980 ramp.csv --samples 6"), 0) << output();
  EXPECT_THAT(output(), ::testing::ContainsRegex("marsh1980 +fitted +144 +[0-9.]+ % +[0-9.]+ % +[0-9.]+ %"));
  EXPECT_THAT(output(), ::testing::ContainsRegex("marsh1980 +copper +- +-"));
  EXPECT_THAT(output(), ::testing::ContainsRegex("ramp +fitted +2 +[0-9.]+ % +- +[0-9.]+ % +- +- +-"));
  EXPECT_THAT(output(), HasSubstr("ramp: no column of errors of P or V/V0"));
  EXPECT_THAT(output(), HasSubstr("copper: not a fitted material"));
}

TEST_F(CompareCommand, RefusesWithReasons) {
  EXPECT_EQ(run("copper --with nothing.csv"), 2);
  EXPECT_THAT(output(), HasSubstr("no experiment 'nothing.csv'"));
  EXPECT_EQ(run("coper --with cu_hugoniot_marsh1980"), 2);
  EXPECT_THAT(output(), HasSubstr("copper"));
  EXPECT_EQ(run("copper"), 2);
  EXPECT_EQ(run("copper --with cu_hugoniot_marsh1980 --samples 4"), 2);
  EXPECT_THAT(output(), HasSubstr("no table [covariance]"));
  std::ofstream(folder.path() / "strange.csv") << "pressure in what,volume\n1,2\n";
  EXPECT_EQ(run("copper --with strange.csv"), 2);  // of no kind that is compared
  EXPECT_THAT(output(), HasSubstr("the columns are"));
}

}  // namespace
}  // namespace whipple::app
