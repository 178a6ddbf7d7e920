// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// Holds the state behind a steady shock.
struct ShockState {
  State state;
  double shock_velocity = 0;     ///< m/s, relative to the material ahead
  double particle_velocity = 0;  ///< m/s, relative to the material ahead
};

/// Computes the shock Hugoniot from an initial state at rest, with the mass, momentum and energy jump conditions (L1)
///   rho0 Us = rho (Us - up),  p - p0 = rho0 Us up,  e - e0 = (p + p0)(V0 - V)/2.
class Hugoniot {
 public:
  /// Constructs the principal Hugoniot, from the reference density and temperature.
  explicit Hugoniot(const EquationOfState& eos);
  /// Constructs the Hugoniot from any other state: preheated material, or the second shock in shocked material
  /// (reshock).
  Hugoniot(const EquationOfState& eos, double density, double specific_internal_energy);

  /// Returns the Hugoniot of porous material of a density below the reference density: grains in the reference
  /// state with voids, which have no resistance until they are closed (p, e and T ahead are those of the grains).
  static Hugoniot porous(const EquationOfState& eos, double density);

  [[nodiscard]] ShockState at_particle_velocity(double particle_velocity) const;
  [[nodiscard]] ShockState at_pressure(double pressure) const;
  /// Returns the weakest shock that compresses to a density. The Hugoniot of very porous material, and that of a
  /// gas, may have no state or two states at a density.
  [[nodiscard]] ShockState at_density(double density) const;
  /// Returns the state ahead of the shock. For porous material it has no sound speed (NaN).
  [[nodiscard]] const State& initial() const { return initial_; }
  [[nodiscard]] const EquationOfState& equation_of_state() const { return *eos_; }

 private:
  Hugoniot(const EquationOfState& eos, const State& initial, double stiffness);
  [[nodiscard]] ShockState shock(double density, double energy) const;
  [[nodiscard]] ShockState at_rest() const;

  const EquationOfState* eos_;
  State initial_;
  double stiffness_;  ///< rho0 c0^2 of the material (of the grains) ahead: the pressure scale
};

/// Returns the shock reflected from a rigid wall into shocked material, which brings it to rest. All velocities are
/// relative to the material behind the first shock.
ShockState reflected_at_wall(const EquationOfState& eos, const ShockState& shocked);

}  // namespace whipple::eos
