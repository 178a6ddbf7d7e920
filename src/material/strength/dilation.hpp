// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "src/core/base/tensor.hpp"

/// Change of the volume of soil by its flow, which acts between two evaluations of the equation of state
/// (docs/theory/soil.md, section 3).
namespace whipple::strength {

/// Holds a chunk of points after the equation of state at the distension before the step (SI units).
struct DilationState {
  std::span<const double> stiffness;    ///< dp/d(ln distension) at constant density, Pa
  std::span<const double> pressure;     ///< of the equation of state, as if the material filled its voids, Pa
  std::span<const double> void_volume;  ///< m^3
  std::span<const double> modulus;      ///< shear modulus, Pa
  std::span<const double> solid_fraction;     ///< 0 where the point has failed
  std::span<const double> trial;              ///< equivalent trial stress of the deviator, Pa
  std::span<const double> distension;         ///< before the step
  std::span<const SymmetricTensor> deviator;  ///< trial, Pa; empty unless the law turns it
  std::span<double> dilation;  ///< fraction of the dilation angle that is left; out; with the deviator
  std::span<double> growth;    ///< of ln(distension); out
};

/// Describes a point that may dilate.
struct DilatingPoint {
  double pressure;    ///< at the distension before the step, Pa
  double trial;       ///< equivalent trial stress, Pa
  double stiffness;   ///< dp/d(ln distension), Pa
  double modulus;     ///< shear modulus, Pa
  double distension;  ///< before the step
};

/// Returns whether a point is solid and its parts are together: what separates opens the gap, not the plastic volume.
inline bool may_dilate(const DilationState& state, std::size_t i, double least_pressure) {
  return state.modulus[i] > 0.0 && state.solid_fraction[i] > 0.0 && !(state.void_volume[i] > 0.0) &&
         state.pressure[i] > least_pressure;
}

}  // namespace whipple::strength
