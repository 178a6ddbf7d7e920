// SPDX-License-Identifier: BSD-3-Clause
#include "eos/curves/planar_impact.hpp"

#include "eos/loci/impedance.hpp"
#include "eos/loci/isentrope.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::curves {
namespace {

/// Calls a function; returns nothing if the range of the model is exceeded.
template <class Function>
auto unless_beyond(const Function& function) -> std::optional<decltype(function())> {
  try {
    return function();
  } catch (const StateError&) {
    return std::nullopt;
  }
}

ImpactSide side(const EquationOfState& eos, const State& shocked) {
  return {shocked, unless_beyond([&] { return release(eos, shocked, 0.0).end.state; })};
}

}  // namespace

PlanarImpact planar_impact(const EquationOfState& projectile, const EquationOfState& target,
                           double velocity) {
  const ImpedanceMatch match = match_impact(Hugoniot(projectile), Hugoniot(target), velocity);
  return {match.pressure, match.velocity, unless_beyond([&] {
            return free_surface_velocity(target, {match.right, match.right_shock_velocity, match.velocity});
          }),
          side(projectile, match.left), side(target, match.right)};
}

}  // namespace whipple::eos::curves
