// SPDX-License-Identifier: BSD-3-Clause
// What a plan costs before it is run.
#include <gtest/gtest.h>

#include <cmath>

#include "md_fitting/protocols/budget.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

TEST(Budget, CountsAtomsTimesStepsByProtocol) {
  auto document = input::Document::from_text(R"(
element = "Cu"
potential = "copper_universal_3"
[[isotherm]]
temperature = "293 K"
volume_ratio = [1.0, 0.9]
cells = 4
equilibration_steps = 1000
steps = 2000
[[coexistence]]
pressure = ["0 GPa"]
first_guess = ["1280 K"]
cells = 4
length = 18
replicas = 2
equilibration_steps = 5000
steps = 6000
[[coexistence]]
pressure = ["0 GPa"]
first_guess = ["1280 K"]
cells = 6
[cold_curve]
volume_ratio = [1.0]
)",
                                             "plan.toml");
  const Plan plan = read_plan(document);
  ASSERT_EQ(plan.coexistences.size(), 2U);
  const Potential potential = Potential::load(plan.potential, plan.element);
  const std::vector<Task> tasks = make_tasks(plan, potential);
  const auto work = planned_atom_steps(tasks, {}, potential);
  EXPECT_EQ(work.size(), 2U);  // static crystals are free
  EXPECT_NEAR(work.at("isotherm"), 2 * 256.0 * 3000.0, 1e-6);
  // Three cells of 1152 atoms (one finds the temperature), and for two of them crystal and melt of 4 x 4 x 4
  // apart.
  const double small = 3 * 1152.0 * (5500.0 + 11000.0) + 2 * 256.0 * 11000.0;
  const double usual = 5 * 2880.0 * (5500.0 + 16000.0) + 4 * 4.0 * std::pow(4.5, 3) * 16000.0;
  EXPECT_NEAR(work.at("coexistence"), small + usual, 1e-6);
  // What the store holds already costs nothing.
  std::set<std::string> present;
  for (const Task& task : tasks) {
    if (task.protocol == "isotherm") present.insert(task.key);
  }
  EXPECT_EQ(planned_atom_steps(tasks, present, potential).count("isotherm"), 0U);
}

TEST(Budget, SplitNamesTheLargestShareFirst) {
  EXPECT_EQ(time_split({{"isochore", 60.0}, {"coexistence", 180.0}}),
            "4.0 min: coexistence 3.0 (75 %), isochore 1.0 (25 %)");
  EXPECT_EQ(total({{"a", 1.0}, {"b", 2.0}}), 3.0);
}

// A core of any machine of the last fifteen years.
TEST(Budget, SpeedIsThatOfAProcessor) {
  const double speed = atom_steps_per_second(Potential::load("copper_universal_3", "Cu"));
  EXPECT_GT(speed, 5e4);
  EXPECT_LT(speed, 5e7);
}

}  // namespace
}  // namespace whipple::md
