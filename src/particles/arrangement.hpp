// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "src/core/base/tensor.hpp"
#include "src/core/base/words.hpp"

/// Initial positions of particles in a body (docs/theory/mpm.md, 2).
namespace whipple {

enum class Arrangement : std::uint8_t {
  regular,  ///< at the centres of equal parts of a cell
  layered,  ///< offset so that no two in a block of two parts along every axis share a layer
};

constexpr std::array<Word<Arrangement>, 2> words(Arrangement) {
  return {{{Arrangement::regular, "regular"}, {Arrangement::layered, "layered"}}};
}

/// Returns the offset of a layered particle from the centre of its part, in edges of the part.
/// @param octant  of a block of parts: 1 for the upper half along x, plus 2 for that along y, plus 4 for that along z
inline Vector3 layer_offset(std::size_t octant) {
  static constexpr std::array<std::array<double, 3>, 8> eighths{
      {{3, -3, 1}, {3, 3, -1}, {-1, -1, -3}, {-1, 1, 3}, {1, -1, -3}, {1, 1, 3}, {-3, -3, 1}, {-3, 3, -1}}};
  const std::array<double, 3>& e = eighths[octant];
  return 0.125 * Vector3(e[0], e[1], e[2]);
}

/// Returns the offset of a layered particle in a plane.
/// @param quadrant  1 for the upper half along x, plus 2 for that along y
inline Vector3 planar_layer_offset(std::size_t quadrant) {
  static constexpr std::array<std::array<double, 2>, 4> quarters{{{-1, 1}, {-1, -1}, {1, 1}, {1, -1}}};
  const std::array<double, 2>& q = quarters[quadrant];
  return 0.25 * Vector3(q[0], q[1], 0.0);
}

}  // namespace whipple
