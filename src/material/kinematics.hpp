// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "src/core/base/tensor.hpp"
#include "src/material/stress_rotation.hpp"

/// Kinematics and elastic trial of one step (docs/theory/material.md, sections 1 and 2) for a chunk of points, with one
/// array per tensor component, so that the compiler processes several points at a time.
namespace whipple::material {

constexpr std::size_t chunk_size = 64;  ///< the scratch of a chunk fits in the second-level cache
/// Chunks are padded to a multiple, so that no remainder loop rounds differently.
constexpr std::size_t lane_count = 8;

using Lanes = std::array<double, chunk_size>;
using MatrixLanes = std::array<Lanes, 9>;     ///< row by row
using SymmetricLanes = std::array<Lanes, 6>;  ///< xx, yy, zz, xy, yz, zx

constexpr std::size_t padded(std::size_t size) { return (size + lane_count - 1) / lane_count * lane_count; }

/// Holds input and results of `volume_change` and `elastic_trial`, in one object so that the compiler can assume its
/// arrays to be disjoint.
struct Kinematics {
  MatrixLanes gradient;  ///< L_ij = dv_i/dx_j, 1/s
  Lanes ratio;           ///< J
  Lanes divergence;      ///< tr L, 1/s
  Lanes modulus;         ///< shear modulus of the step, Pa; 0 where the material has failed or melted
  SymmetricLanes
      deviator;  ///< old deviatoric stress (0 where the modulus is 0), Pa; becomes the trial deviator
  SymmetricLanes strain;  ///< strain increment of the step
  Lanes trial;            ///< equivalent stress of the trial deviator, sqrt(3/2 s:s), Pa
};

/// Computes J = det(I + dt L) and tr L (eq. 1).
/// @param size a multiple of `lane_count`
void volume_change(std::size_t size, double dt, Kinematics& step);

/// Computes strain increment, rotation and elastic trial (eq. 2 to 5).
/// @param size a multiple of `lane_count`
void elastic_trial(std::size_t size, double dt, StressRotation rule, Kinematics& step);

/// Rotates tensors with the material (eq. 4).
/// @param size a multiple of `lane_count`
void turn(std::size_t size, double dt, StressRotation rule, const MatrixLanes& gradient,
          std::span<Lanes, 6> tensor);

/// Advances deformation gradients, row by row: F becomes (I + dt L) F.
/// @param size a multiple of `lane_count`
void deform(std::size_t size, double dt, const MatrixLanes& gradient, std::span<Lanes, 9> deformation);

/// Computes the strain increment alone (eq. 2, 3), for material without elastic deviator.
/// @param size a multiple of `lane_count`
void strain_increment(std::size_t size, double dt, StressRotation rule, const MatrixLanes& gradient,
                      SymmetricLanes& strain);

}  // namespace whipple::material
