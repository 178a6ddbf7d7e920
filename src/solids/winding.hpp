// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/solids/surface.hpp"

namespace whipple::solids {

/// Computes the generalised winding number of a surface, the sum of the solid angles of its triangles over 4 pi: 1
/// inside of a closed surface and 0 outside; it goes smoothly from one to the other through holes (Jacobson, Kavan and
/// Sorkine-Hornung, ACM Trans. Graph. 32, 2013, 33). Triangles far from a point count as the dipole of their node in
/// a tree (Barill et al., ACM Trans. Graph. 37, 2018, 43).
class WindingTree {
 public:
  explicit WindingTree(std::vector<Triangle> triangles);
  [[nodiscard]] double winding_number(const Vector3& point) const;
  /// Returns the triangles in the order of the tree.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  struct Node {
    Vector3 centre, dipole;  // weighted by area; sum of the vector areas
    double reach;            // m^2: square of the distance from which the dipole is used
    std::uint32_t begin, end;
    std::uint32_t next;  // the node behind its descendants
    bool is_leaf;
  };
  void build(std::vector<std::uint32_t>& order, const std::vector<Vector3>& middles, std::uint32_t begin,
             std::uint32_t end);
  void sum_up(Node& node) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;  // each before its descendants
};

}  // namespace whipple::solids
