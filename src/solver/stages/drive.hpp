// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "src/solver/state.hpp"

namespace whipple::solver {

/// Finds the force on driven bodies: one acceleration of all particles of a body, by which its mean velocity v stays the
/// one that the case gives it, V,
///   a = (V - v)/dt - c, c = (v - v')/dt' - a',
/// where ' is the step before and c the acceleration by all other forces in it, which change little from step to step. Along the
/// normal of a mirror plane that the body touches the plane guides it.
class Drive {
 public:
  explicit Drive(const cases::Case& setup);

  /// Adds the accelerations (m/s^2) of a step to those of the particles, and remembers in `state.run`. Collective.
  void add(State& state, std::vector<Vector3>& acceleration) const;

 private:
  struct Driven {
    std::size_t body;
    Vector3 velocity;            // m/s, V
    std::array<bool, 3> guided;  // by a mirror plane, along this axis
  };
  std::vector<Driven> driven_;
};

}  // namespace whipple::solver
