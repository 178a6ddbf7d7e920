// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "src/case/section.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/base/tensor.hpp"

namespace whipple::cases {

/// Describes `failure_grains` of a body: polyhedra of a given size along whose faces it fails (docs/theory/cracks.md,
/// 3). One seed is placed at random in each cube (square in two dimensions) of that edge; a grain is the Voronoi cell
/// of its seed.
struct FailureGrains {
  double size =
      std::numeric_limits<double>::infinity();  ///< m, edge of a cube of the mean volume; infinite: none
  double strength = 10.0;                       ///< factor of the thresholds within a grain
  std::int64_t seed = 0;
  static ParameterTable<FailureGrains> parameters();

  [[nodiscard]] bool given() const;
  /// Adds a fault if grains are smaller than cells: all material would then be close to a face.
  void check(const Case& setup, const Faults& faults) const;
  /// Returns the factor of the thresholds at a position: 1 within half a cell of a face, otherwise `strength`.
  /// @param planar  seeds are in the plane of the first two coordinates
  [[nodiscard]] double factor(const Vector3& place, double cell_size, bool planar) const;
};

}  // namespace whipple::cases
