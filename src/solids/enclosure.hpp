// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "src/solids/winding.hpp"

namespace whipple::solids {

/// Describes what a surface of closed parts encloses.
struct Enclosure {
  double volume = 0.0;       ///< m^3, where the winding number is not zero
  std::size_t parts = 0;     ///< closed parts
  std::size_t inverted = 0;  ///< parts turned inside out: the winding number is negative on one side
  std::size_t covered = 0;   ///< parts within the solid, with solid on both sides: they bound nothing
};

/// Determines the volume that a surface encloses from the volumes of its parts by the divergence theorem. A part counts
/// by the winding numbers on its two sides, at samples of its triangles: with its sign between 0 and 1, as a cavity has
/// it as well; with the opposite sign between -1 and 0; not at all if neither side is 0. For parts that do not cross
/// this is exact.
/// @returns nothing if a part is not closed, or the winding numbers vary along one, as where two cross
std::optional<Enclosure> enclosure_of(const WindingTree& tree, const Audit& audit);

}  // namespace whipple::solids
