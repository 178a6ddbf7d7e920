// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "src/case/section.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/base/tensor.hpp"

namespace whipple::cases {

/// `failure_grains` of a body: polyhedra of a size along whose faces it fails (docs/theory/cracks.md, 3). A seed lies at
/// random in each cube (square in two dimensions) of that edge; a grain is what is nearer to its seed than to others.
struct FailureGrains {
  double size =
      std::numeric_limits<double>::infinity();  ///< m, edge of a cube of the mean volume; infinite: none
  double strength = 10.0;                       ///< factor of the thresholds within a grain
  std::int64_t seed = 0;
  static ParameterTable<FailureGrains> parameters();

  [[nodiscard]] bool given() const;
  /// Adds a fault if grains are smaller than cells: all of the material would lie at a face.
  void check(const Case& setup, const Faults& faults) const;
  /// Returns the factor of the thresholds at a place: 1 within half a cell of a face, else `strength`.
  /// @param planar  seeds lie in the plane of the first two coordinates
  [[nodiscard]] double factor(const Vector3& place, double cell_size, bool planar) const;
};

}  // namespace whipple::cases
