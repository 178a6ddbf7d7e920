// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/loci/impedance.hpp"

#include <fmt/core.h>

#include <cmath>

#include "eos/loci/isentrope.hpp"
#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {

ImpedanceMatch match_impact(const Hugoniot& impactor, const Hugoniot& target, double velocity) {
  if (!(velocity > 0)) {
    throw StateError(fmt::format("impact: the velocity must be positive, not {:.6g} m/s", velocity));
  }
  // p_target(u) = p_impactor(v - u)  (L5): increases with u, negative at u = 0, positive at u = v. The stronger of
  // the two shocks is in the softer material; both models are evaluated only in the half of the range that contains
  // the root, since a model may end before `velocity`.
  const auto residual = [&](double u) {
    return target.at_particle_velocity(u).state.pressure -
           impactor.at_particle_velocity(velocity - u).state.pressure;
  };
  const double half = 0.5 * velocity, at_half = residual(half);
  double u = half;
  if (at_half != 0) {
    // Search outwards from the half, in steps that stop at the first change of sign.
    const double direction = at_half > 0 ? -1 : 1;
    constexpr int steps = 16;
    bool found = false;
    double before = half;
    for (int i = 1; i <= steps && !found; ++i) {
      const double next = half + direction * half * i / steps;
      found = (residual(next) > 0) != (at_half > 0);
      if (found) u = find_root(residual, before, next, "velocity of the interface");
      before = next;
    }
    if (!found) {
      throw StateError(fmt::format(
          "impact with {:.6g} m/s: no shock of both materials has equal pressures; their pressures "
          "before it are {:.6g} and {:.6g} Pa",
          velocity, impactor.initial().pressure, target.initial().pressure));
    }
  }
  const ShockState right = target.at_particle_velocity(u), left = impactor.at_particle_velocity(velocity - u);
  return {right.state.pressure, u, left.state, right.state, right.shock_velocity, left.shock_velocity};
}

ImpedanceMatch match_shock(const EquationOfState& left, const ShockState& incident, const Hugoniot& right) {
  const double p1 = incident.state.pressure, u1 = incident.particle_velocity;
  const ShockState same = right.at_particle_velocity(u1);
  if (std::abs(same.state.pressure - p1) <= 1e-10 * p1) {  // equal impedances: no reflection
    return {p1, u1, incident.state, same.state, same.shock_velocity, State::unknown};
  }
  if (same.state.pressure >= p1) {
    // Reshock: p_right(u) = p_reshock(u1 - u)  (L6).
    const Hugoniot reshock(left, incident.state.density, incident.state.specific_internal_energy);
    const auto residual = [&](double u) {
      return right.at_particle_velocity(u).state.pressure -
             reshock.at_particle_velocity(u1 - u).state.pressure;
    };
    const double u = find_root(residual, 0, u1, "velocity of the interface");
    const ShockState r = right.at_particle_velocity(u), l = reshock.at_particle_velocity(u1 - u);
    return {r.state.pressure, u, l.state, r.state, r.shock_velocity, l.shock_velocity};
  }
  // Release: u = u1 - u_r(p), with the Riemann velocity u_r < 0 of the isentrope, on the right Hugoniot at p (L6).
  // At p1 the right material would move faster, at the initial pressure slower.
  const auto released = [&](double p) { return isentrope_at_pressure(left, incident.state, p); };
  const auto residual = [&](double p) {
    return right.at_pressure(p).particle_velocity - (u1 - released(p).riemann_velocity);
  };
  const double p = find_root(residual, right.initial().pressure, p1, "pressure of the interface");
  const ShockState r = right.at_pressure(p);
  return {p, r.particle_velocity, released(p).state, r.state, r.shock_velocity, State::unknown};
}

double free_surface_velocity(const EquationOfState& eos, const ShockState& incident, double pressure) {
  return incident.particle_velocity - isentrope_at_pressure(eos, incident.state, pressure).riemann_velocity;
}

}  // namespace whipple::eos
