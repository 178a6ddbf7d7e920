// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "src/fem/step.hpp"
#include "src/solver/ledger.hpp"
#include "src/solver/loads.hpp"

/// Loads on the nodes of elements.
namespace whipple::solver {

/// Evaluates the accelerations of the nodes of a body at a time (s) and adds the forces.
/// @param acceleration  result for `book_loads`, m/s^2; empty without a load
inline void add_loads(const Loads& loads, double time, std::size_t body, fem::Nodes& nodes,
                      std::vector<Vector3>& acceleration) {
  acceleration.clear();
  if (!loads.act(time)) return;
  acceleration.resize(nodes.size(), Vector3::Zero());
  loads.add_to({nodes.id, nodes.position, nodes.velocity, body}, time, acceleration);
  for (std::size_t a = 0; a < acceleration.size(); ++a) nodes.force[a] += nodes.mass[a] * acceleration[a];
}

/// Accumulates momentum and work of these accelerations in a step of `dt` (s).
inline void book_loads(const std::vector<Vector3>& acceleration, const fem::Nodes& nodes,
                       const fem::Motion& motion, double dt, Ledger& booked) {
  for (std::size_t a = 0; a < acceleration.size(); ++a) {
    const Vector3 impulse = dt * nodes.mass[a] * acceleration[a];
    booked.external_impulse += impulse;
    booked.external_work += impulse.dot(motion.mean[a]);
  }
}

}  // namespace whipple::solver
