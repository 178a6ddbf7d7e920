// SPDX-License-Identifier: BSD-3-Clause
// What the report expects of a planar impact is what the equations of state say.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "src/app/planar_impact.hpp"

namespace whipple::app {
namespace {

cases::Case case_of(const std::string& velocity) {
  return cases::read_case_text(R"(
[domain]
lower = ["0 mm", "0 mm", "-4 mm"]
upper = ["4 mm", "4 mm", "8 mm"]
cell_size = "1 mm"
[time]
end = "1 us"
[[body]]
name = "disk"
material = "copper.toml"
velocity = ["0 m/s", "0 m/s", ")" + velocity +
                                   R"("]
shape = { box = { lower = ["0 mm", "0 mm", "-3 mm"], upper = ["4 mm", "4 mm", "0 mm"] } }
[[body]]
name = "plate"
material = "aluminium.toml"
shape = { box = { lower = ["0 mm", "0 mm", "0 mm"], upper = ["4 mm", "4 mm", "3 mm"] } }
[[body]]
name = "wall"
material = "aluminium.toml"
shape = { box = { lower = ["0 mm", "0 mm", "5 mm"], upper = ["4 mm", "4 mm", "6 mm"] } }
)",
                               "case.toml");
}

TEST(PlanarImpact, OfCopperOnAluminium) {
  const nlohmann::json impacts = planar_impacts(case_of("5.55 km/s"), 2);
  ASSERT_EQ(impacts.size(), 1U);  // the wall is of the plate's material
  EXPECT_NEAR(impacts[0]["pressure"].get<double>(), 105.72e9, 0.01e9);
  EXPECT_NEAR(impacts[0]["free_surface_velocity"].get<double>(), 7820.0, 1.0);
  EXPECT_EQ(impacts[0]["states"][0]["released"]["melted_fraction"].get<double>(), 0.0);
  EXPECT_EQ(impacts[0]["states"][1]["released"]["melted_fraction"].get<double>(), 1.0);
  EXPECT_TRUE(planar_impacts(case_of("5.55 km/s"), 0).empty());  // nothing approaches along x
}

TEST(PlanarImpact, BeyondAnEquationOfStateIsLeftOut) {
  EXPECT_TRUE(planar_impacts(case_of("3000 km/s"), 2).empty());
}

}  // namespace
}  // namespace whipple::app
