// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/base/tensor.hpp"

namespace whipple::solids {

/// Holds a sphere, m.
struct Ball {
  Vector3 centre;
  double radius;
};

/// Describes spheres to be packed into a box.
struct PackingOrder {
  Vector3 lower, upper;  ///< m
  double radius;         ///< m, median
  double spread;         ///< standard deviation of the logarithm of the radii; cut off at 2.5 of them
  double fraction;       ///< of the volume of the box
  std::uint64_t seed;
};

/// Packs spheres that do not overlap and lie in the box wholly. They begin at random places and are pushed apart. All
/// radii are scaled by at most 5 % so that the fraction of the volume is met exactly.
/// @throws InputError if a sphere does not fit into the box, there would be more than 200,000, or the fraction is not
/// reached
std::vector<Ball> pack(const PackingOrder& order);

}  // namespace whipple::solids
