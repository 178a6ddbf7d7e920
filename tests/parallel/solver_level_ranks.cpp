// SPDX-License-Identifier: BSD-3-Clause
// Two cell sizes on several ranks: each level is shared out by itself, and the parts of a mixed particle may be with
// different ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "src/case/case.hpp"
#include "tests/parallel/solver_ranks.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::solver {
namespace {

/// Returns a case of a bullet that flies through a region of small cells into a plate, a quarter between mirror planes.
/// @param lines  further lines of the bullet
/// @param nose   x of its front, m
cases::Case bullet(const std::string& lines, const std::string& nose) {
  using namespace verification;
  const std::string material = aluminium("aluminium_of_levels", "0.3 GPa");
  return cases::read_case_text(
      Method{}.time_toml(1e-6) + Method{}.toml() +
          "[domain]\nlower = [-0.012, 0, 0]\nupper = [0.010, 0.012, 0.012]\ncell_size = 0.0005\nboundary = { "
          "y_lower = \"symmetry\", z_lower = \"symmetry\" }\n[[domain.refinement]]\nlower = [-0.006, 0, 0]\n"
          "upper = [0.004, 0.008, 0.008]\n[[body]]\nname = \"bullet\"\nmaterial = \"" +
          material + "\"\n" + lines +
          "velocity = [1500, 0, 0]\nshape = { box = { lower = [-0.0075, 0, 0], upper = [" + nose +
          ", 0.003, 0.003] } }\n[[body]]\nname = \"plate\"\nmaterial = \"" + material +
          "\"\nshape = { box = { lower = [0, 0, 0], upper = [0.007, 0.010, 0.010] } }\n",
      "bullet.toml");
}

TEST(LevelRanks, AgreeWithOneRank) {
  const cases::Case setup = bullet("", "-0.0005");
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  const std::size_t before = alone.particles().size();
  advance_to(together, 0.22e-6);
  advance_on_root(alone, 0.22e-6);
  expect_agreement(together, alone, 1e-11);
  if (!is_root()) return;
  EXPECT_GT(alone.particles().size(), before);  // particles came in and were split
  const Ledger &a = together.state().ledger, &b = alone.state().ledger;
  EXPECT_LT(std::abs(a.energy_error(together.totals())), 1e-12);
  EXPECT_LT(std::abs(b.energy_error(alone.totals())), 1e-12);
}

TEST(LevelRanks, ElementsInSmallCellsAgreeWithOneRank) {
  const cases::Case setup =
      bullet("discretization = { method = \"adaptive\" }\nconversion = { plastic_strain = 0.1 }\n", "0");
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  const std::size_t before = alone.element_count();
  advance_to(together, 0.22e-6);
  advance_on_root(alone, 0.22e-6);
  expect_agreement(together, alone, 1e-11);
  if (!is_root()) return;
  EXPECT_LT(alone.element_count(), before);  // some became particles
  EXPECT_LT(std::abs(together.state().ledger.energy_error(together.totals())), 1e-12);
}

}  // namespace
}  // namespace whipple::solver
