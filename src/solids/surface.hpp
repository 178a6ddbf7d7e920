// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/core/base/tensor.hpp"

/// Solids from files of other programs, and generated ones: which points they hold.
namespace whipple::solids {

/// Holds the corners (m) of a triangle, counter-clockwise as seen from outside.
using Triangle = std::array<Vector3, 3>;

/// Describes connected triangles of one orientation.
struct Part {
  double volume = 0.0;            ///< m^3, by the divergence theorem; negative if turned inside out
  std::vector<Triangle> samples;  ///< some of its triangles, spread over all of them
};

/// Describes a surface of triangles: how far it is from one that bounds a solid.
struct Audit {
  std::size_t triangles = 0;      ///< in the file
  std::size_t degenerate = 0;     ///< without area; dropped
  std::size_t repeated = 0;       ///< with the corners and the sense of another one; dropped
  std::size_t cancelled = 0;      ///< pairs with the same corners and opposite senses; both dropped
  std::size_t flipped = 0;        ///< against most of their connected neighbours; turned
  std::size_t open_edges = 0;     ///< of one triangle only
  std::size_t crowded_edges = 0;  ///< of more than two triangles
  double area = 0.0;              ///< m^2
  double volume = 0.0;   ///< m^3, by the divergence theorem; of an open surface with respect to the middle
  Vector3 lower, upper;  ///< m, corners of the bounding box
  bool are_parts_closed = false;  ///< every part has a definite inside: `parts` are valid
  std::vector<Part> parts;        ///< connected by edges of two triangles

  [[nodiscard]] bool is_closed() const { return open_edges == 0 && crowded_edges == 0; }
};

/// Drops triangles that are repeated or have no area, turns those that are against their connected neighbours, and
/// reports on the rest. Corners with equal coordinates, to the last bit, are one. Two triangles of opposite senses
/// between the same corners, as where two bodies touch, add nothing to the winding number: both are dropped, unless
/// they belong to a closed shell that is given in both senses, of which one copy stays. Connected triangles keep the
/// orientation of the larger area among them.
/// @throws InputError if no triangle is left
Audit repair(std::vector<Triangle>& triangles);

}  // namespace whipple::solids
