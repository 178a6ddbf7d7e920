// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "src/material/kinematics.hpp"
#include "src/material/update.hpp"

/// The working set of the constitutive update (update.cpp) and its second half, failure (failing.cpp).
namespace whipple::material {

constexpr double least_sound_speed_ratio = 0.1;  ///< of the bulk sound speed of the reference state

/// Scratch of one chunk, on the stack; entry k belongs to point `index[k]`.
struct Chunk {
  std::size_t size = 0;
  std::array<std::size_t, chunk_size> index;
  Lanes density, pressure, temperature, plastic_strain, solid_fraction;
  Lanes old_volume;                    // m^3 of matter
  Lanes volume_change;                 // m^3 of matter, on which its pressure does work
  Kinematics motion;                   // its deviator becomes the new one
  SymmetricLanes back_stress, strain;  // of materials that need them only
  Lanes solid_modulus, increment;
  Lanes energy, bulk_sound_speed, melted, vaporised;
  Lanes acting_pressure;  // after failure
  Lanes distension;       // of porous matter only

  template <class Array>
  auto view(Array& array) {
    return std::span(array.data(), size);
  }
  strength::State strength_state() {
    return {view(density), view(pressure), view(temperature), view(plastic_strain)};
  }
};

struct Step {
  const Material& material;
  MaterialPoints& points;
  std::span<const Matrix3> gradient;  // of this chunk
  const UpdateSettings& settings;
  MaterialReport& report;
};

constexpr std::array<double SymmetricTensor::*, 6> components = {&SymmetricTensor::xx, &SymmetricTensor::yy,
                                                                 &SymmetricTensor::zz, &SymmetricTensor::xy,
                                                                 &SymmetricTensor::yz, &SymmetricTensor::zx};

inline SymmetricTensor tensor(const SymmetricLanes& s, std::size_t k) {
  return {s[0][k], s[1][k], s[2][k], s[3][k], s[4][k], s[5][k]};
}

inline void scale(SymmetricLanes& lanes, std::size_t k, double factor) {
  for (Lanes& lane : lanes) lane[k] *= factor;
}

/// Share of the stiffness that a point still has: 1 - melted, less its damage if that softens; 0 failed.
inline double solid_fraction(const Step& step, std::size_t point, double melted) {
  if (step.points.failed[point] != failure::intact) return 0.0;
  return (1.0 - melted) * (step.material.softens ? 1.0 - step.points.damage[point] : 1.0);
}

/// Share of a change of the whole volume that goes to the voids of a point: all of it where the point has
/// failed, its damage where cracks open in softening matter, and that of the porosity in porous matter.
inline double void_share(const Step& step, std::size_t point) {
  const MaterialPoints& points = step.points;
  if (points.failed[point] != failure::intact) return 1.0;
  if (step.material.softens) return points.damage[point];
  return points.void_volume[point] / (points.volume[point] + points.void_volume[point]);
}

/// Voids grow, criteria are asked: between the equation of state and `finish`.
void apply_failure(Step& step, Chunk& chunk);

/// Cracks and voids, loss of the deviator by melting and damage, sound speed; writes the new state.
void finish(Step& step, Chunk& chunk);

}  // namespace whipple::material
