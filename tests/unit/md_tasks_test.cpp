// SPDX-License-Identifier: BSD-3-Clause
// The points of a plan and their keys: a store outlives the program's inner order, so a key may change only
// with something that changes the numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "md_fitting/protocols/catalogue.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"
#include "tests/folders.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

/// Of the algorithm of a protocol.
std::string revision(const std::string& protocol) {
  if (protocol == "lattice") return "1";
  return "4";
}

/// The key of docs/theory/molecular_dynamics.md, "The store", written out: format 1 of the store.
class Keys : public ::testing::Test {
 protected:
  std::string key(const std::string& protocol, const std::string& conditions, const std::string& sizes,
                  const std::string& dependency = {}) {
    // Provenance in the order of its names: what stands before "equilibration_steps", the sizes, the rest.
    std::map<std::string, std::string> entries = {{"element", "Cu"},
                                                  {"lammps_version", std::to_string(lammps_release())},
                                                  {"molar_mass", fmt::format("{}", 1e-3 * potential.mass())},
                                                  {"plan_seed", "1"},
                                                  {"potential_sha256", potential.hash()},
                                                  {"ranks", "1"},
                                                  {"revision", revision(protocol)},
                                                  {"structure", "fcc"}};
    for (std::size_t at = 0; at < sizes.size();) {
      const std::size_t end = sizes.find('\n', at);
      const std::size_t equals = sizes.find('=', at);
      entries[sizes.substr(at, equals - at)] = sizes.substr(equals + 1, end - equals - 1);
      at = end + 1;
    }
    std::string text = "protocol=" + protocol + "\ndependency=" + dependency + "\n" + conditions;
    for (const auto& [name, value] : entries) text += name + "=" + value + "\n";
    return sha256(text);
  }
  std::string volume(double ratio) const {
    return fmt::format("condition specific_volume={}\n", ratio * potential.static_volume());
  }
  Potential potential = Potential::load("copper_universal_3", "Cu");
};

TEST_F(Keys, OfTheShippedPlansAreThoseOfTheFirstStores) {
  const Plan plan =
      read_plan(std::filesystem::path(whipple::tests::source_folder() + "/cases/md/copper_u3_short.toml"));
  const std::vector<Task> tasks = make_tasks(plan, potential);
  const auto stands = [&](const std::string& wanted) {
    return std::any_of(tasks.begin(), tasks.end(), [&](const Task& task) { return task.key == wanted; });
  };
  const std::string reference =
      key("zero_pressure_volume", "condition pressure=0\ncondition temperature=293\n",
          "cells=5\nequilibration_steps=2000\nsteps=20000\ntime_step=automatic\n");
  EXPECT_TRUE(stands(reference));
  EXPECT_TRUE(stands(key("lattice", "", "")));
  EXPECT_TRUE(stands(key("isotherm", volume(0.85) + "condition temperature=293\n",
                         "cells=4\nequilibration_steps=1000\nsteps=3000\ntime_step=automatic\n")));
  EXPECT_TRUE(stands(key("isochore", volume(0.9) + "condition temperature=1400\n",
                         "cells=4\nequilibration_steps=1500\nsteps=12000\ntime_step=automatic\n")));
  EXPECT_TRUE(stands(key("hugoniot", volume(0.72),
                         "cells=4\nequilibration_steps=1000\nsteps=4000\ntime_step=automatic\n", reference)));

  const Plan melting =
      read_plan(std::filesystem::path(whipple::tests::source_folder() + "/cases/md/copper_u3_melting.toml"));
  const std::vector<Task> melting_tasks = make_tasks(melting, potential);
  const CoexistencePlan& section = melting.coexistences.front();
  const std::string wanted = key(
      "coexistence", fmt::format("condition pressure={}\n", section.pressure[0]),
      fmt::format(
          "attempts={}\ncells={}\nequilibration_steps={}\nfirst_guess={}\nlength={}\nreplicas={}\nsteps={}\n"
          "time_step=automatic\n",
          section.attempts, section.size.cells, section.size.equilibration_steps, section.first_guess[0],
          section.length, section.replicas, section.size.steps));
  EXPECT_TRUE(std::any_of(melting_tasks.begin(), melting_tasks.end(),
                          [&](const Task& task) { return task.key == wanted; }));
}

// The cutoff of u3 is 4.95 A, its lattice constant 3.615 A: one cell is too narrow, two are not, but at half
// the volume again.
TEST_F(Keys, BoxesNarrowerThanTheCutoffAreRefused) {
  Plan plan;
  plan.element = "Cu";
  plan.potential = "copper_universal_3";
  plan.isotherms = {{293.0, {0.9}, {.cells = 1, .equilibration_steps = 100, .steps = 1000}}};
  const auto fault = [&] {
    try {
      make_tasks(plan, potential);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(fault().find("a box of 1 cells is 3.49 angstrom wide at V/V0 = 0.900, less than the cutoff"),
            std::string::npos)
      << fault();
  EXPECT_NE(fault().find("use cells = 2 or more"), std::string::npos) << fault();
  plan.isotherms[0].size.cells = 2;
  EXPECT_EQ(fault(), "");
}

TEST_F(Keys, ChangeWithWhatChangesTheNumbersOnly) {
  Plan plan;
  plan.element = "Cu";
  plan.potential = "copper_universal_3";
  plan.isotherms = {{293.0, {0.9, 0.9}, {}}};
  const auto keys = [&] {
    std::set<std::string> all;
    for (const Task& task : make_tasks(plan, potential)) all.insert(task.key);
    return all;
  };
  const std::set<std::string> first = keys();
  EXPECT_EQ(first.size(), 2U);  // the lattice, and the same state twice
  plan.title = "another title";
  EXPECT_EQ(keys(), first);
  plan.isotherms[0].size.steps += 1;
  EXPECT_NE(keys(), first);
}

// Every protocol of the catalogue has a name of its own, and a point that stands before those that need it.
TEST_F(Keys, DependenciesComeFirst) {
  std::set<std::string> names;
  for (const Protocol& protocol : protocols()) EXPECT_TRUE(names.insert(protocol.name).second);
  const Plan plan =
      read_plan(std::filesystem::path(whipple::tests::source_folder() + "/cases/md/copper_u3_short.toml"));
  std::set<std::string> seen;
  int dependent = 0;
  for (const Task& task : make_tasks(plan, potential)) {
    if (!task.dependency.empty()) {
      ++dependent;
      EXPECT_TRUE(seen.contains(task.dependency)) << task.protocol;
    }
    seen.insert(task.key);
  }
  EXPECT_EQ(dependent, 11);
}

TEST(StructureRemark, NamesCrystalsBeyondLindemannsLimit) {
  EXPECT_EQ(structure_remark(1.0, true, 0.14), "");
  EXPECT_NE(structure_remark(1.0, true, 0.25).find("atoms move 0.25 of the distance of their neighbours"),
            std::string::npos);
  EXPECT_NE(structure_remark(0.1, false, 0.7).find("melted"), std::string::npos);
}

}  // namespace
}  // namespace whipple::md
