// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// State behind a steady shock.
struct ShockState {
  State state;
  double shock_velocity = 0;     ///< m/s, against the material ahead
  double particle_velocity = 0;  ///< m/s, against the material ahead
};

/// Shock Hugoniot from an initial state at rest: mass, momentum and energy jump conditions (L1)
///   rho0 Us = rho (Us - up),  p - p0 = rho0 Us up,  e - e0 = (p + p0)(V0 - V)/2.
class Hugoniot {
 public:
  /// Principal Hugoniot: from the reference density and temperature.
  explicit Hugoniot(const EquationOfState& eos);
  /// From any other state: preheated material, or the second shock through a shocked state (reshock).
  Hugoniot(const EquationOfState& eos, double density, double specific_internal_energy);

  /// Porous material of a density below the reference density: grains in the reference state with voids
  /// between, which resist with no pressure until they are closed (p, e and T ahead are those of the grains).
  /// @throws StateError if the density is not below the reference density, or not positive
  static Hugoniot porous(const EquationOfState& eos, double density);

  [[nodiscard]] ShockState at_particle_velocity(double particle_velocity) const;
  [[nodiscard]] ShockState at_pressure(double pressure) const;
  /// The weakest shock that compresses to a density. The Hugoniot of very porous material, and that of a gas,
  /// reaches a density not at all or twice.
  [[nodiscard]] ShockState at_density(double density) const;
  /// The state ahead of the shock. That of porous material has no sound speed (NaN).
  [[nodiscard]] const State& initial() const { return initial_; }
  [[nodiscard]] const EquationOfState& equation_of_state() const { return *eos_; }

 private:
  Hugoniot(const EquationOfState& eos, const State& initial, double stiffness);
  [[nodiscard]] ShockState shock(double density, double energy) const;
  [[nodiscard]] ShockState at_rest() const;

  const EquationOfState* eos_;
  State initial_;
  double stiffness_;  ///< rho0 c0^2 of the material (of the grains) ahead: the scale of pressures
};

/// The shock that goes back through shocked material when it meets a rigid wall: brings it to rest again. All
/// velocities against the material that the first shock has passed.
ShockState reflected_at_wall(const EquationOfState& eos, const ShockState& shocked);

}  // namespace whipple::eos
