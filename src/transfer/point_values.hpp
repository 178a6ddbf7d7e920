// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/core/base/registers.hpp"

/// What points and nodes exchange in a transfer.
namespace whipple::transfer {

/// Update of the affine fields of the particles.
enum class AffineField : std::uint8_t {
  none,      ///< there is none: FLIP, PIC and their blends
  deformed,  ///< carried to the new positions with the deformation of the step, never growing
  turned,    ///< turned with the rotation of the step only, which changes no energy
};

/// Contribution of one point to a node: first += N (a0 + a_x r_x + a_y r_y + a_z r_z), second += N b0 + sum
/// over directions of dN/dx_a b_a.
struct Payload {
  Lanes a0, ax, ay, az;
  Lanes b0, bx, by, bz;
};

/// Sum over nodes with N, and with the derivatives of N.
/// @tparam Vector  register whose lanes 0 to 2 are a vector; of the sums, lane 3 is some number unless stated
template <class Vector = Lanes>
struct ValueAndGradient {
  Vector value;
  std::array<Vector, 3> gradient;
};

/// Sums over the nodes of a particle (docs/theory/mpm.md, equations 4.2 to 4.7); lane 3 of each is
/// meaningless, but for the increment.
template <class Vector>
struct Moments {
  ValueAndGradient<Vector> velocity;   ///< v + d
  ValueAndGradient<Vector> increment;  ///< d
  ValueAndGradient<Vector> change;     ///< d - beta D, with N r instead of the derivatives
  Vector loss;                         ///< (d - beta D)^2 + beta D (2 D - beta D), per component
};

/// Result of the step for one point.
template <class Vector = Lanes>
struct Advance {
  ValueAndGradient<Vector> grid_velocity;  ///< after the forces
  ValueAndGradient<Vector> increment;      ///< of it
  Vector velocity;                         ///< of the point
  std::array<Vector, 3> affine;            ///< columns of its affine field
  Vector heat;                             ///< J/kg, in all lanes
};

/// New velocity of the nodes and how much of it came in the step.
template <class Vector = Lanes>
struct VelocityUpdate {
  ValueAndGradient<Vector> after;
  Vector increment;
};

}  // namespace whipple::transfer
