// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/solids/winding.hpp"

namespace whipple::solids {

/// Decides which points lie inside of a surface: where the magnitude of the winding number exceeds 1/2, so that also a
/// surface turned inside out is a body. An octree remembers where all points are inside, or outside: cells without a
/// triangle, with a winding number near an integer in the middle. For a closed surface this is exact; at a hole it
/// moves the surface that closes it by a fraction of the smallest cells.
class Inside {
 public:
  /// @param audit  of the triangles, from `repair`
  Inside(std::vector<Triangle> triangles, const Audit& audit);
  [[nodiscard]] bool contains(const Vector3& point) const;
  [[nodiscard]] const WindingTree& tree() const { return tree_; }

 private:
  enum Kind : std::int32_t {
    outside = -1,
    inside = -2,
    mixed = -3
  };  // otherwise the first of eight children
  struct Cell {
    Vector3 middle;
    std::uint32_t node;
    std::vector<std::uint32_t> triangles;  // that may touch it
  };
  void divide(std::vector<Cell>& cells, double half, bool is_last);

  WindingTree tree_;
  Vector3 middle_;
  double half_ = 0.0;  // m, half edge of the root
  std::vector<std::int32_t> nodes_{mixed};
};

}  // namespace whipple::solids
