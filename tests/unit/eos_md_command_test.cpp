// SPDX-License-Identifier: BSD-3-Clause
// From a plan to a material by the commands of the users. A material that is simulated when a state is asked
// for, with molecular dynamics behind it: the second call simulates nothing and says the same; a potential
// that does not exist is an input error.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/folders.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class SimulatedMaterial : public ::testing::Test {
 protected:
  void write(const std::string& potential) const {
    std::ofstream(folder.path() / "crystal.toml") << fmt::format(R"(
name = "simulated copper"
source = "test"
[eos]
model = "md"
element = "Cu"
potential = "{}"
temperature = ["300 K", "900 K"]
least_volume_ratio = 0.85
tolerance = "3 GPa"
cells = 3
equilibration_steps = 200
steps = 400
)",
                                                                 potential);
  }
  [[nodiscard]] int run(const std::string& options = "") const {
    const int status = std::system(
        fmt::format(
            "cd '{0}' && XDG_CACHE_HOME='{0}/cache' '{1}' eos hugoniot crystal.toml --from '400 m/s' --to "
            "'401 m/s' --points 2 --csv points.csv --force {2} > output.txt 2>&1",
            folder.path().string(), whipple::tests::program("whipple"), options)
            .c_str());
    return WEXITSTATUS(status);
  }
  [[nodiscard]] std::string output() const { return content_of(folder.path() / "output.txt"); }

  TemporaryFolder folder;
};

TEST_F(SimulatedMaterial, SimulatesOnceAndAnswersTheSame) {
  write("copper_universal_3");
  ASSERT_EQ(run(), 0) << output();
  EXPECT_THAT(output(), HasSubstr("simulating"));
  const std::string first = content_of(folder.path() / "points.csv");
  EXPECT_THAT(first, HasSubstr("400"));
  ASSERT_EQ(run("--verbose"), 0) << output();
  EXPECT_THAT(output(), Not(HasSubstr("simulating")));
  EXPECT_THAT(output(), HasSubstr("nothing to compute"));  // of whipple-md
  EXPECT_THAT(output(), Not(HasSubstr("whipple fit")));    // nobody asked for one
  EXPECT_EQ(content_of(folder.path() / "points.csv"), first);
}

TEST_F(SimulatedMaterial, UnknownPotentialIsAnInputError) {
  write("copper_universal_33");
  EXPECT_EQ(run(), 2) << output();
  EXPECT_THAT(output(), HasSubstr("there is no potential 'copper_universal_33'"));
}

// What `whipple md` stores, `whipple fit` reads: a plan as small as a fit can bear (108 atoms, half a
// picosecond or two per point), its constants near those of long runs (docs/generated/results_md.md: V0 = 0.1135
// cm^3/g, C = 3.90 km/s, S = 1.32, gamma0 = 1.86), and the same bytes from a second fit.
TEST(PlanToMaterial, SmallestPlanIsSimulatedAndFitted) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "small.toml") << R"(
element = "Cu"
potential = "copper_universal_3"
[zero_pressure_volume]
temperature = ["293 K"]
cells = 3
equilibration_steps = 500
steps = 3000
[[isochore]]
volume_ratio = 1.0
temperature = ["150 K", "600 K", "1000 K"]
cells = 3
equilibration_steps = 300
steps = 800
[[isochore]]
volume_ratio = 0.85
temperature = ["150 K", "700 K", "1400 K"]
cells = 3
equilibration_steps = 300
steps = 800
[hugoniot]
volume_ratio = [0.9, 0.84, 0.78]
cells = 3
equilibration_steps = 300
steps = 800
)";
  const auto whipple = [&](const std::string& arguments) {
    const int status =
        std::system(fmt::format("cd '{}' && OMP_NUM_THREADS=1 OMPI_MCA_rmaps_base_oversubscribe=1 '{}' {} >> "
                                "output.txt 2>&1",
                                folder.path().string(), whipple::tests::program("whipple"), arguments)
                        .c_str());
    return WEXITSTATUS(status);
  };
  const auto output = [&] { return content_of(folder.path() / "output.txt"); };
  ASSERT_EQ(whipple("md small.toml -o small.md.h5 --ranks 2"), 0) << output();
  ASSERT_EQ(whipple("fit small.md.h5 -o first.toml"), 0) << output();
  ASSERT_EQ(whipple("fit small.md.h5 -o second.toml"), 0) << output();
  const std::string material = content_of(folder.path() / "first.toml");
  const auto constant = [&](const std::string& key) {
    const std::size_t at = material.find(key + " = ");
    if (at == std::string::npos) return 0.0;
    const std::size_t first = material.find_first_of("-0123456789", at + key.size());
    return std::stod(material.substr(first));
  };
  EXPECT_NEAR(constant("reference_specific_volume"), 0.1135, 0.0004) << material;
  EXPECT_NEAR(constant("hugoniot_intercept"), 3.90, 0.08) << material;
  EXPECT_NEAR(constant("hugoniot_slope"), 1.32, 0.06) << material;
  EXPECT_NEAR(constant("gruneisen"), 1.86, 0.25) << material;
  EXPECT_EQ(content_of(folder.path() / "second.toml").substr(material.find("[eos]")),
            material.substr(material.find("[eos]")));
}

}  // namespace
}  // namespace whipple::app
