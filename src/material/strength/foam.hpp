// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

namespace whipple::strength {

/// Holds the trial state of the points of a chunk, and what the law of a foam changes (SI units).
struct FoamState {
  std::span<const double> bulk_modulus;  ///< dp/d(ln rho) at constant distension, Pa
  std::span<const double> modulus;       ///< effective shear modulus, Pa; 0 of failed points
  std::span<const double> trial;         ///< equivalent stress of the trial deviator, Pa
  std::span<const double> pressure;      ///< at the distension before the step, Pa
  std::span<double> equivalent;          ///< returned: equivalent stress, Pa
  std::span<double> distension;          ///< volume over that of the solid, >= 1; advanced
  std::span<double> plastic_strain;      ///< equivalent plastic strain; advanced
  std::span<double> plastic_increment;   ///< returned
  std::span<double> dissipation;         ///< returned: plastic work per volume, J/m^3
};

/// Interface of the strength models of foams, whose plastic flow changes the volume: it acts after the pressure of the
/// step is known, and the equation of state, that of the solid at the density times the distension, is evaluated again
/// with the new distension (docs/theory/foam.md). A foam is also a `Strength`.
class Foam {
 public:
  virtual ~Foam() = default;

  /// Returns the distension of the foam as it is made, > 1.
  [[nodiscard]] virtual double initial_distension() const = 0;
  /// Returns stress and distension of each point to the yield surface.
  virtual void crush(const FoamState& state) const = 0;
};

}  // namespace whipple::strength
