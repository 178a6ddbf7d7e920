// SPDX-License-Identifier: BSD-3-Clause
// Plans: what is accepted, how errors read, and that every shipped plan is complete.
#include <gtest/gtest.h>

#include <filesystem>

#include "md_fitting/plan/plan.hpp"
#include "src/core/base/error.hpp"
#include "tests/folders.hpp"

namespace whipple::md {
namespace {

std::string errors_of(const std::string& text) {
  try {
    auto document = input::Document::from_text(text, "plan.toml");
    read_plan(document);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(Plan, ReadsQuantitiesWithUnits) {
  auto document = input::Document::from_text(R"(
element = "Cu"
potential = "copper_universal_3"
[zero_pressure_volume]
temperature = ["20 degC"]
[[isotherm]]
temperature = 300
volume_ratio = [1, 0.9]
time_step = "1 fs"
[[coexistence]]
pressure = ["10 GPa"]
first_guess = ["1700 K"]
)",
                                             "plan.toml");
  const Plan plan = read_plan(document);
  EXPECT_NEAR(plan.zero_pressure->temperature.at(0), 293.15, 1e-9);
  EXPECT_EQ(plan.isotherms.at(0).temperature, 300.0);
  EXPECT_EQ(plan.isotherms.at(0).volume_ratio, (std::vector<double>{1.0, 0.9}));
  EXPECT_NEAR(plan.isotherms.at(0).size.time_step, 1e-15, 1e-24);
  EXPECT_NEAR(plan.coexistences.at(0).pressure.at(0), 1e10, 1.0);
  EXPECT_FALSE(plan.hugoniot.has_value());
}

TEST(Plan, ReportsAllErrorsAtOnceWithTheirPlace) {
  const std::string text = errors_of(R"(
element = "Cu"
[[isotherm]]
volume_ratio = [1.0, -0.5]
cels = 4
[hugoniot]
volume_ratio = [0.8]
[[coexistence]]
pressure = ["0 GPa", "10 K"]
first_guess = ["1300 K"]
)");
  for (const char* part : {"potential", "plan.toml:4:", "cels", "did you mean \"cells\"", "plan.toml:9:",
                           "needs the section [zero_pressure_volume]", "1 temperatures for 0 pressures"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(Plan, PairStyleAndCoefficientsBelongTogether) {
  const std::string head = "element = \"Ni\"\npotential = \"own\"\n";
  EXPECT_NE(errors_of(head + "pair_style = \"adp\"\n").find("plan.toml:3:"), std::string::npos)
      << errors_of(head + "pair_style = \"adp\"\n");
  EXPECT_NE(errors_of(head + "pair_coeff = [\"* * Ni.adp Ni\"]\n").find("belongs to a pair_style"),
            std::string::npos);
  EXPECT_EQ(errors_of(head + "pair_style = \"adp\"\npair_coeff = [\"* * Ni.adp Ni\"]\n"), "no InputError");
}

TEST(Plan, DescriptionNamesEveryKey) {
  const std::string text = describe_plan();
  for (const char* key :
       {"element", "potential", "seed", "[zero_pressure_volume]", "[[isotherm]]", "[[isochore]]",
        "[hugoniot]", "[[coexistence]]", "[cold_curve]", "[hugoniostat]", "[piston]", "[liquid]", "[[fluid]]",
        "[spall]", "[liquid_vapour]", "[elastic]", "volume_ratio", "first_guess", "equilibration_steps"}) {
    EXPECT_NE(text.find(key), std::string::npos) << key << "\n" << text;
  }
}

TEST(Plan, ShippedPlansAreValid) {
  int plans = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(whipple::tests::source_folder() + "/cases/md")) {
    if (entry.path().extension() != ".toml") continue;
    ++plans;
    Plan plan;
    EXPECT_NO_THROW(plan = read_plan(entry.path())) << entry.path();
    EXPECT_TRUE(plan.hugoniot.has_value() || !plan.coexistences.empty() || !plan.fluids.empty() ||
                !plan.isochores.empty())
        << entry.path();
  }
  EXPECT_GE(plans, 4);
}

}  // namespace
}  // namespace whipple::md
