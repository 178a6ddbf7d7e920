// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/solver/accounts.hpp"

namespace whipple::solver {

void Balance::sum() {
  state_.totals = {};
  std::vector<double> counts = {0.0, 0.0};
  for (Carrier* carrier : carriers_) {
    carrier->add_totals(state_.totals);
    counts[0] += static_cast<double>(carrier->particle_count());
    counts[1] += static_cast<double>(carrier->element_count());
  }
  for (const BodyOutflow& out : state_.booked_outflow) {
    counts.insert(counts.end(), {out.mass, out.momentum[0], out.momentum[1], out.momentum[2], out.energy});
  }
  const std::span<GaugedImpulse> gauged = state_.force_gauges.booked();
  const std::size_t of_gauges = counts.size();
  for (const GaugedImpulse& of : gauged) {
    counts.insert(counts.end(), of.impulse.begin(), of.impulse.end());
    counts.insert(counts.end(), of.moment.begin(), of.moment.end());
  }
  sum_over_ranks(state_.communicator, state_.totals, state_.booked);
  parallel::sum(state_.communicator, counts);
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    BodyOutflow& out = state_.run.outflow_of_body[b];
    const double* const number = &counts[2 + 5 * b];
    out.mass += number[0];
    out.momentum += Vector3(number[1], number[2], number[3]);
    out.energy += number[4];
  }
  std::ranges::fill(state_.booked_outflow, BodyOutflow{});
  for (std::size_t g = 0; g < gauged.size(); ++g) {
    const double* const n = &counts[of_gauges + 6 * g];
    state_.run.gauged[g] += {Vector3(n[0], n[1], n[2]), Vector3(n[3], n[4], n[5])};
    gauged[g] = {};
  }
  state_.particle_count = static_cast<std::size_t>(counts[0]);
  state_.element_count = static_cast<std::size_t>(counts[1]);
  state_.run.ledger.add(state_.booked);
  state_.booked = {};
}

void Balance::require_energy() const {
  const double error = state_.run.ledger.energy_error(state_.totals);
  const double limit = state_.setup.output.energy_error_limit(state_.setup.time.scheme);
  if (std::abs(error) <= limit) return;  // not true for NaN
  throw StateError(
      fmt::format("step {}, t = {} s: the relative error of the total energy is {:.3e}, beyond "
                  "output.maximum_energy_error = {}",
                  state_.run.step, state_.run.time, error, limit));
}

}  // namespace whipple::solver
