// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Curves on any equation of state, through its public face (docs/theory/equations_of_state.md, section 4).
/// SI. Everything here throws StateError, with the bound that was met, if the asked state is outside the
/// model.
namespace whipple::eos {

/// State behind a steady shock.
struct ShockState {
  State state;
  double shock_velocity = 0;     ///< m/s, against the material ahead
  double particle_velocity = 0;  ///< m/s, against the material ahead
};

/// Shock Hugoniot from an initial state at rest: mass, momentum and energy jump conditions
///   rho0 Us = rho (Us - up),  p - p0 = rho0 Us up,  e - e0 = (p + p0)(V0 - V)/2.
class Hugoniot {
 public:
  /// Principal Hugoniot: from the reference density and temperature.
  explicit Hugoniot(const EquationOfState& eos);
  /// From any other state (reshock, preheated or porous material ahead of the shock).
  Hugoniot(const EquationOfState& eos, double density, double specific_internal_energy);

  [[nodiscard]] ShockState at_particle_velocity(double particle_velocity) const;
  [[nodiscard]] ShockState at_pressure(double pressure) const;
  [[nodiscard]] ShockState at_density(double density) const;
  [[nodiscard]] const State& initial() const { return initial_; }

 private:
  [[nodiscard]] ShockState shock(double density, double energy) const;

  const EquationOfState* eos_;
  State initial_;
};

/// One point of an isentrope.
struct IsentropeState {
  State state;
  double riemann_velocity = 0;  ///< integral of c d(rho)/rho from the start, m/s (negative on expansion)
};

/// Isentrope through a state, de = p/rho^2 d(rho), integrated with error control (relative 1e-10), at the
/// asked densities (monotone, on one side of the start).
std::vector<IsentropeState> isentrope(const EquationOfState& eos, const State& start,
                                      const std::vector<double>& densities);

/// Release (or isentropic compression) to a pressure.
struct Release {
  IsentropeState end;
  /// The end is an equilibrium mixture of liquid and vapour: `end.state` holds the mixture's density, energy,
  /// temperature and fractions; sound speed and Riemann velocity are not defined (NaN).
  bool in_equilibrium = false;
};
/// If the model has a liquid-vapour dome at the pressure and the entropy of the start lies in it, the end is
/// the equilibrium mixture (lever rule on the entropy); otherwise the isentrope is integrated on the model's
/// own surface.
/// @throws StateError if the isentrope turns around before it reaches the pressure; the message says where
Release release(const EquationOfState& eos, const State& start, double pressure);

/// Where the principal Hugoniot enters and leaves the melting region.
struct ShockMelting {
  ShockState onset;
  ShockState completion;
};
/// Nothing if the model never melts below the pressure.
std::optional<ShockMelting> shock_melting(const EquationOfState& eos, double highest_pressure = 2e12);

}  // namespace whipple::eos
