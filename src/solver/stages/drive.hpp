// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "src/solver/state.hpp"

namespace whipple::solver {

/// Computes the force on driven bodies (docs/theory/mpm.md, equation 3.5a): a common acceleration of all particles of a
/// body that keeps its mean velocity v at the velocity V given in the case, or V times the factor of its path,
/// a = (V - v)/dt - c, c = (v - v')/dt' - a',
/// where ' denotes the previous step and c the acceleration by all other forces in it, which changes little from step
/// to step. The spin w about the centre of mass is kept at 0 likewise, by an acceleration that grows with the distance
/// from it. Along the normal of a mirror plane that the body touches there is no force, and about the axes in it no spin.
class Drive {
 public:
  explicit Drive(const cases::Case& setup);

  /// Adds the accelerations (m/s^2) of a step to those of the particles, and stores the data for the next step in
  /// `state.run`. Collective.
  void add(State& state, std::vector<Vector3>& acceleration) const;

 private:
  struct Driven {
    std::size_t body;
    Vector3 velocity;                 // V, m/s
    std::array<bool, 3> guided;       // by a mirror plane normal to this axis
    std::array<bool, 3> turns;        // about this axis, if nothing held it
    std::optional<cases::Path> path;  // factor of V over time
  };
  std::vector<Driven> driven_;
};

}  // namespace whipple::solver
