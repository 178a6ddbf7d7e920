// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "src/device/check/states.hpp"

/// Many particles from a stored state, to measure times with. They are no physics to be compared.
namespace whipple::device::check {

/// Particles with the problem in which they are stepped.
struct Arrangement {
  Problem problem;
  PointsOnHost points;
  double dt = 0.0;  ///< s
};

/// Repeats the start of a state along x until there are `size` particles at least, each copy a whole number of blocks
/// apart from the next.
/// @throws WrongInput if the domain would have too many cells, or the state is a section
Arrangement repeated(const StoredState& state, std::size_t size);

/// Fills a cube with a state's first particle at rest, its material undeformed as it was there.
/// @param per_cell  particles in a cell, 8 in fresh material; the volume of each is that of 1/8 cell
/// @throws WrongInput if the domain would have too many cells, or the state is a section
Arrangement scattered(const StoredState& state, std::size_t size, double per_cell);

}  // namespace whipple::device::check
