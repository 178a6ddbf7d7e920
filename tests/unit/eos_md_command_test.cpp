// SPDX-License-Identifier: BSD-3-Clause
// A material that is simulated when a state is asked for, with molecular dynamics behind it: the second call
// simulates nothing and says the same; a potential that does not exist is an input error.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/unit/md_temporary_folder.hpp"

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
  [[nodiscard]] int run() const {
    const int status = std::system(
        fmt::format(
            "cd '{0}' && XDG_CACHE_HOME='{0}/cache' '{1}' eos hugoniot crystal.toml --from '400 m/s' --to "
            "'401 m/s' --points 2 --csv points.csv --force > output.txt 2>&1",
            folder.path().string(), WHIPPLE_EXECUTABLE)
            .c_str());
    return WEXITSTATUS(status);
  }
  [[nodiscard]] std::string output() const { return content_of(folder.path() / "output.txt"); }

  md::TemporaryFolder folder;
};

TEST_F(SimulatedMaterial, SimulatesOnceAndAnswersTheSame) {
  write("copper_universal_3");
  ASSERT_EQ(run(), 0) << output();
  EXPECT_THAT(output(), HasSubstr("simulating"));
  const std::string first = content_of(folder.path() / "points.csv");
  EXPECT_THAT(first, HasSubstr("400"));
  ASSERT_EQ(run(), 0) << output();
  EXPECT_THAT(output(), Not(HasSubstr("simulating")));
  EXPECT_EQ(content_of(folder.path() / "points.csv"), first);
}

TEST_F(SimulatedMaterial, UnknownPotentialIsAnInputError) {
  write("copper_universal_33");
  EXPECT_EQ(run(), 2) << output();
  EXPECT_THAT(output(), HasSubstr("there is no potential 'copper_universal_33'"));
}

}  // namespace
}  // namespace whipple::app
