// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/simd.hpp"
#include "src/core/base/tensor.hpp"
#include "src/grid/block_grid.hpp"

namespace whipple::contact {

constexpr double no_mass = 1e-300;  // kg

inline Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }

/// Accumulates the energy and momentum balance of contact in a step on this rank.
struct Balance {
  double contact_heat = 0.0;      ///< dissipated by normal impulses, J
  double friction_heat = 0.0;     ///< dissipated by tangential impulses, J
  double impulse = 0.0;           ///< sum of the magnitudes of the normal impulses, N s
  double friction_impulse = 0.0;  ///< sum of the magnitudes of the tangential impulses, N s
  Balance& operator+=(const Balance& other) {
    contact_heat += other.contact_heat;
    friction_heat += other.friction_heat;
    impulse += other.impulse;
    friction_impulse += other.friction_impulse;
    return *this;
  }
};

/// Describes one velocity field at a node.
struct Side {
  grid::Node* node = nullptr;
  double mass = 0.0;  ///< kg
  double heat = 0.0;  ///< contact dissipation, J

  [[nodiscard]] Vector3 before() const { return node->motion.velocity(); }
  [[nodiscard]] Vector3 increment() const { return node->motion.increment(); }
  [[nodiscard]] Vector3 after() const { return before() + increment(); }
  [[nodiscard]] double relaxation() const { return node->motion.relaxation(); }
  void push(const Vector3& impulse) { node->motion.accelerate(impulse / mass); }
  void shift_velocity(const Vector3& change) {
    node->motion.velocity_and_relaxation += Lanes{change[0], change[1], change[2], 0.0};
  }
};

}  // namespace whipple::contact
