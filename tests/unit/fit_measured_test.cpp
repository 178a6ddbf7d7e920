// SPDX-License-Identifier: BSD-3-Clause
// `whipple-fit --with`: tables as users write them, the coverage in the material, and what is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "eos/equation_of_state.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "src/core/base/files.hpp"
#include "src/material/material_coverage.hpp"
#include "src/material/material_file.hpp"
#include "tests/folders.hpp"
#include "tests/unit/fit_support.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::fit {
namespace {

using ::testing::HasSubstr;

class FitMeasured : public ::testing::Test {
 protected:
  void SetUp() override {
    const testing::SyntheticStore points(testing::true_constants(), testing::Noise{}, 11);
    for (const md::PointRecord& point : points.points) {
      if (point.protocol != "coexistence") md::append_point(file, point);
    }
  }
  [[nodiscard]] int run(const std::string& arguments) const {
    const int status = std::system(fmt::format("'{}' {} > '{}' 2>&1", whipple::tests::program("whipple-fit"),
                                               arguments, (folder.path() / "output.txt").string())
                                       .c_str());
    return WEXITSTATUS(status);
  }
  [[nodiscard]] std::string output() const { return read_text(folder.path() / "output.txt"); }

  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "copper.md.h5";
};

TEST_F(FitMeasured, MeasurementsInTheFitAreNamedWithTheirCoverage) {
  const std::string material = (folder.path() / "joint.toml").string();
  const std::string table = (folder.path() / "own.csv").string();
  std::ofstream(table) << "# material: copper\nup [km/s];us [km/s];us_err "
                          "[%]\n0,5;4,62;1\n1,0;5,36;1\n1,5;6,10;1\n2,0;6,83;1\n";
  const std::string command = fmt::format("{} -o {} -q --density \"8.93 g/cm^3\"", file.string(), material);
  ASSERT_EQ(run(fmt::format("{} --with {} cu_isotherm_298K_dewaele2004 --check cu_hugoniot_marsh1980",
                            command, table)),
            0)
      << output();
  const std::string text = read_text(material);
  EXPECT_THAT(text, HasSubstr("together with measurements (own, cu_isotherm_298K_dewaele2004)"));
  const std::vector<Coverage> coverage = coverage_of(read_material(material));
  ASSERT_EQ(coverage.size(), 3U);
  EXPECT_EQ(coverage[0].curve, "own");
  EXPECT_EQ(coverage[0].points, 4);
  EXPECT_EQ(coverage[2].curve, "cu_hugoniot_marsh1980");
  EXPECT_GT(coverage[2].inside_95, 0.5);
  // What cannot be fitted is refused before the fit, by name.
  EXPECT_EQ(run(command + " --force --with al_isotherm_298K_dewaele2004"), 2);
  EXPECT_THAT(output(), HasSubstr("measured on another material than copper"));
  EXPECT_EQ(run(command + " --force --check cu_hugoniot_marsh1980"), 2);
  EXPECT_THAT(output(), HasSubstr("--check"));
  EXPECT_EQ(run(command + " --force --with nothing"), 2);
  EXPECT_THAT(output(), HasSubstr("no experiment 'nothing'"));
  EXPECT_EQ(run(command + " --force --model mie_gruneisen --with cu_hugoniot_marsh1980"), 2);
  EXPECT_THAT(output(), HasSubstr("--model gray only"));
}

TEST_F(FitMeasured, FreeEnergiesAreCorrected) {
  const std::filesystem::path target = folder.path() / "corrected.toml", figure = folder.path() / "fit.png";
  ASSERT_EQ(run(fmt::format("'{}' --correct --samples 2 --density '8.93 g/cm^3' -o '{}' --plot '{}'",
                            file.string(), target.string(), figure.string())),
            0)
      << output();
  EXPECT_THAT(output(), HasSubstr("correction of the free energy"));
  EXPECT_EQ(read_text(figure).substr(1, 3), "PNG");
  const std::string text = read_text(target);
  EXPECT_THAT(text, HasSubstr("model = \"gray_corrected\""));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("[covariance]")));
  const auto reference = [](const std::filesystem::path& path) {
    const auto eos = read_material(path).eos;
    EXPECT_EQ(eos->model(), "gray_corrected");
    EXPECT_NEAR(eos->reference_density(), 8930.0, 1e-3);
    return eos->state_at_temperature(1.2 * eos->reference_density(), 800.0).pressure;
  };
  const double pressure = reference(target);
  for (const char* sample : {"corrected_1.toml", "corrected_2.toml"}) {
    const double drawn = reference(folder.path() / "corrected_samples" / sample);
    EXPECT_NE(drawn, pressure);
    EXPECT_NEAR(drawn, pressure, 0.02 * pressure);
  }
  EXPECT_EQ(run(fmt::format("'{}' --correct --melting band", file.string())), 2);
  EXPECT_THAT(output(), HasSubstr("--melting equilibrium only"));
}

}  // namespace
}  // namespace whipple::fit
