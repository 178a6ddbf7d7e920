// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/verification/exact/result.hpp"

/// Oblique impact of two bodies in free space: mass, momentum, energy and angular momentum stay as they are.
namespace whipple::verification::exact {

struct ObliqueImpact {
  std::string name;
  bool spheres;   ///< of 6 mm diameter; else cubes of 6 mm
  double speed;   ///< m/s, each against the other with half of it
  double offset;  ///< m, of the two paths
  double end;     ///< s
};

/// Cubes at 1 km/s and spheres at 3 km/s, both half overlapping.
ObliqueImpact oblique_cubes();
ObliqueImpact oblique_spheres();

/// Elastic-plastic aluminium (Y 0.3 GPa; the spheres spall), which the grid never sees from a preferred
/// place: the centres are off the cells' corners.
/// @param affine_field  of `transfer`, empty: the default
Result run(const ObliqueImpact& impact, double cell, const std::string& affine_field = {});

}  // namespace whipple::verification::exact
