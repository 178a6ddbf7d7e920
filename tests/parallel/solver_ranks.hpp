// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <thread>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/solver/simulation.hpp"

/// Tools of the tests of the solver on several ranks.
namespace whipple::solver {

inline void advance_to(Simulation& simulation, double time) {
  while (simulation.state().time < time) simulation.advance(time);
}

inline bool is_root() { return parallel::rank(MPI_COMM_WORLD) == 0; }

/// Calls f() on the root only: the other ranks sleep until it has ended, as there are fewer cores than ranks.
template <class Function>
void compute_on_root(Function&& f) {
  if (is_root()) f();
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  for (int ended = 0;;) {
    MPI_Test(&request, &ended, MPI_STATUS_IGNORE);
    if (ended != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Advances the reference run of one rank on the root only.
inline void advance_on_root(Simulation& alone, double time) {
  compute_on_root([&] { advance_to(alone, time); });
}

/// Requires that every rank of a run holds bitwise equal sums.
inline void expect_same_on_all_ranks(const Simulation& together) {
  std::vector<double> own = {static_cast<double>(together.state().step),
                             static_cast<double>(together.particle_count()),
                             static_cast<double>(together.element_count()), together.state().time_step};
  const auto add = [&](const char*, double value) { own.push_back(value); };
  const Ledger& ledger = together.state().ledger;
  for_each_number(together.totals(), add);
  for_each_number(ledger.initial, add);
  for_each_number(ledger.outflow, add);
  own.insert(own.end(), ledger.wall_impulse.begin(), ledger.wall_impulse.end());
  own.insert(own.end(),
             {ledger.external_work, ledger.transfer_heat, ledger.contact_heat, ledger.friction_heat,
              ledger.contact_impulse, ledger.converted_mass, ledger.conversion_heat});
  const auto ranks = static_cast<std::size_t>(parallel::size(MPI_COMM_WORLD));
  EXPECT_EQ(parallel::exchange(MPI_COMM_WORLD, std::vector(ranks, own)), std::vector(ranks, own));
}

/// Compares every number of two runs, relative to the largest of its kind.
/// @param of_time_step  relative, of the time step alone: that of one point
inline void expect_equal(const Simulation& a, const Simulation& b, double tolerance, double of_time_step) {
  EXPECT_EQ(a.state().step, b.state().step);
  EXPECT_EQ(a.particle_count(), b.particle_count());
  EXPECT_EQ(a.element_count(), b.element_count());
  EXPECT_NEAR(a.state().time_step, b.state().time_step, of_time_step * b.state().time_step);
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

inline void expect_equal(const Simulation& a, const Simulation& b, double tolerance) {
  expect_equal(a, b, tolerance, tolerance);
}

/// Compares a run on all ranks with that of the root alone. Collective.
inline void expect_agreement(const Simulation& together, const Simulation& alone, double tolerance,
                             double of_time_step) {
  expect_same_on_all_ranks(together);
  if (is_root()) expect_equal(together, alone, tolerance, of_time_step);
}
inline void expect_agreement(const Simulation& together, const Simulation& alone, double tolerance) {
  expect_agreement(together, alone, tolerance, tolerance);
}

}  // namespace whipple::solver
