// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "src/solver/simulation.hpp"

/// Tools of the tests of the solver on several ranks.
namespace whipple::solver {

inline void advance_to(Simulation& simulation, double time) {
  while (simulation.state().time < time) simulation.advance(time);
}

/// Every number of two runs, relative to the largest of its kind.
inline void expect_equal(const Simulation& a, const Simulation& b, double tolerance) {
  EXPECT_EQ(a.state().step, b.state().step);
  EXPECT_EQ(a.particle_count(), b.particle_count());
  EXPECT_EQ(a.element_count(), b.element_count());
  EXPECT_NEAR(a.state().time_step, b.state().time_step, tolerance * b.state().time_step);
  const Totals& initial = b.state().ledger.initial;
  const auto compare = [&](const Totals& x, const Totals& y, const char* what) {
    EXPECT_NEAR(x.mass, y.mass, tolerance * initial.mass) << what;
    EXPECT_NEAR(x.kinetic_energy, y.kinetic_energy, tolerance * initial.energy()) << what;
    EXPECT_NEAR(x.affine_kinetic_energy, y.affine_kinetic_energy, tolerance * initial.energy()) << what;
    EXPECT_NEAR(x.hourglass_energy, y.hourglass_energy, tolerance * initial.energy()) << what;
    EXPECT_NEAR(x.internal_energy, y.internal_energy, tolerance * initial.energy()) << what;
    EXPECT_LE((x.momentum - y.momentum).norm(), tolerance * initial.momentum_scale) << what;
  };
  compare(a.totals(), b.totals(), "now");
  compare(a.state().ledger.outflow, b.state().ledger.outflow, "outflow");
  EXPECT_LE((a.state().ledger.wall_impulse - b.state().ledger.wall_impulse).norm(),
            tolerance * initial.momentum_scale);
  EXPECT_NEAR(a.state().ledger.transfer_heat, b.state().ledger.transfer_heat, tolerance * initial.energy());
  EXPECT_LE(std::abs(a.state().ledger.energy_error(a.totals())), 1e-10);
  EXPECT_LE(a.state().ledger.momentum_error(a.totals()), 1e-11);
}

}  // namespace whipple::solver
