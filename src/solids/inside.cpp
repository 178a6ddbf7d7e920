// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/inside.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/core/parallel/threads.hpp"

namespace whipple::solids {
namespace {

/// Returns whether a triangle may touch a cube: their boxes meet, and its plane cuts the cube.
bool may_touch(const Triangle& t, const Vector3& middle, double half) {
  const Vector3 a = t[0] - middle, b = t[1] - middle, c = t[2] - middle;
  if ((a.cwiseMin(b).cwiseMin(c).array() > half).any() || (a.cwiseMax(b).cwiseMax(c).array() < -half).any()) {
    return false;
  }
  const Vector3 normal = (b - a).cross(c - a);
  return std::abs(normal.dot(a)) <= half * normal.cwiseAbs().sum() * (1.0 + 1e-9);
}

}  // namespace

Inside::Inside(std::vector<Triangle> triangles, const Audit& audit) : tree_(std::move(triangles)) {
  constexpr double margin = 1.0 + 1e-6;
  middle_ = 0.5 * (audit.lower + audit.upper);
  half_ = 0.5 * margin * (audit.upper - audit.lower).maxCoeff();
  // The smallest cells are about half as large as the triangles: most points are decided without them.
  const auto count = static_cast<double>(tree_.triangles().size());
  const int depth = std::clamp(static_cast<int>(std::lround(0.5 * std::log2(count / 6.0))) + 1, 5, 8);
  std::vector<Cell> cells(1);
  cells[0] = {middle_, 0, std::vector<std::uint32_t>(tree_.triangles().size())};
  std::iota(cells[0].triangles.begin(), cells[0].triangles.end(), 0U);
  double half = half_;
  for (int level = 0; level < depth; ++level) {
    half *= 0.5;
    divide(cells, half, level + 1 == depth);
  }
}

void Inside::divide(std::vector<Cell>& cells, double half, bool is_last) {
  constexpr double nearness =
      0.25;  // of the winding number to an integer: inside of a surface without 15 % it is 0.85
  std::vector<std::array<Cell, 8>> divided(is_last ? 0 : cells.size());  // the smallest cells need no lists
  for (Cell& cell : cells) {
    nodes_[cell.node] = static_cast<std::int32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 8, mixed);
  }
  const std::vector<Triangle>& triangles = tree_.triangles();
  parallel::for_each_uneven(cells.size(), [&](std::size_t c) {
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      Cell child;
      child.node = static_cast<std::uint32_t>(nodes_[cells[c].node]) + octant;
      for (std::uint32_t a = 0; a < 3; ++a) {
        child.middle[a] = cells[c].middle[a] + (((octant >> a) & 1U) != 0 ? half : -half);
      }
      for (const std::uint32_t t : cells[c].triangles) {
        if (!may_touch(triangles[t], child.middle, half * (1.0 + 1e-9))) continue;
        child.triangles.push_back(t);
        if (is_last) break;
      }
      if (!child.triangles.empty()) {
        if (!is_last) divided[c][octant] = std::move(child);
        continue;
      }
      const double winding = std::abs(tree_.winding_number(child.middle));
      if (winding < nearness) nodes_[child.node] = outside;
      if (winding > 1.0 - nearness) nodes_[child.node] = inside;
      if (!is_last) divided[c][octant] = std::move(child);
    }
    cells[c].triangles = {};
  });
  cells.clear();
  for (auto& eight : divided) {
    for (Cell& child : eight) {
      if (nodes_[child.node] == mixed) cells.push_back(std::move(child));
    }
  }
}

bool Inside::contains(const Vector3& point) const {
  if (((point - middle_).array().abs() > half_).any()) return false;
  Vector3 middle = middle_;
  double half = half_;
  std::int32_t node = nodes_[0];
  while (node >= 0) {
    half *= 0.5;
    std::int32_t octant = 0;
    for (int a = 0; a < 3; ++a) {
      const bool upper = point[a] > middle[a];
      octant |= (upper ? 1 : 0) << a;
      middle[a] += upper ? half : -half;
    }
    node = nodes_[static_cast<std::size_t>(node) + static_cast<std::size_t>(octant)];
  }
  if (node != mixed) return node == inside;
  return std::abs(tree_.winding_number(point)) > 0.5;
}

}  // namespace whipple::solids
