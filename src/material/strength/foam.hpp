// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
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

/// Returns whether a point has pores left.
inline bool has_pores(const FoamState& state, std::size_t i) { return state.distension[i] > 1.0 + 1e-12; }

/// Returns a point without pores to von Mises' surface of its solid.
/// @param yield_stress  of the solid, Pa
inline void flow_as_solid(const FoamState& state, std::size_t i, double yield_stress) {
  state.equivalent[i] = state.trial[i];
  state.plastic_increment[i] = 0.0;
  state.dissipation[i] = 0.0;
  const double excess = state.trial[i] - yield_stress;
  if (!(excess > 0.0)) return;
  const double increment = excess / (3.0 * state.modulus[i]);
  state.equivalent[i] = yield_stress;
  state.plastic_increment[i] = increment;
  state.plastic_strain[i] += increment;
  state.dissipation[i] = yield_stress * increment;
}

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
