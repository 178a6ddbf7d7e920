// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "src/material/update.hpp"
#include "src/particles/particles.hpp"

namespace whipple::quasi_static {

/// Describes the particles of a body and how their material is updated.
struct Group {
  const Material* material;
  std::size_t first, count;  ///< particles [first, first + count)
  UpdateSettings settings;
};

/// Returns row and column of a component of f and T: xx, xy, yx, yy in the plane, then zz of rings; by rows in space.
inline std::array<int, 2> component(int strains, int k) {
  if (strains == 9) return {k / 3, k % 3};
  return k == 4 ? std::array{2, 2} : std::array{k / 2, k % 2};
}

/// Computes dT/df of the particles of a group in closed form, where there is one (docs/theory/quasi_static.md, eq. 9 to
/// 13): elastic, von Mises with isotropic hardening and Drucker-Prager, stresses turned by Hughes and Winget; neo-Hookean
/// that does not relax. Failure, melting and open voids of laws other than Drucker-Prager have none.
/// @param before    at the beginning of the load step
/// @param after     at its end, updated with f
/// @param strains   components of f
/// @param tangents  row by row, `strains`^2 numbers per particle of all groups, N m; out
/// @returns whether the group has a closed form in its present state; otherwise `tangents` is as it was
bool closed_tangents(const Group& group, const Particles& before, const MaterialPoints& after,
                     std::span<const Matrix3> f, int strains, std::span<double> tangents);

}  // namespace whipple::quasi_static
