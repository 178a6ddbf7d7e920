// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "src/core/parallel/threads.hpp"

namespace whipple::solids {
namespace {

/// Returns half of the solid angle of a triangle (van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30, 1983, 125).
double half_angle(const Triangle& triangle, const Vector3& point) {
  const Vector3 a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
  const double ra = a.norm(), rb = b.norm(), rc = c.norm();
  return std::atan2(a.dot(b.cross(c)), ra * rb * rc + a.dot(b) * rc + b.dot(c) * ra + c.dot(a) * rb);
}

}  // namespace

WindingTree::WindingTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  std::vector<std::uint32_t> order(triangles_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<Vector3> middles(triangles_.size());
  for (std::size_t t = 0; t < middles.size(); ++t) {
    middles[t] = (triangles_[t][0] + triangles_[t][1] + triangles_[t][2]) / 3.0;
  }
  build(order, middles, 0, static_cast<std::uint32_t>(order.size()));
  std::vector<Triangle> sorted(triangles_.size());
  for (std::size_t t = 0; t < order.size(); ++t) sorted[t] = triangles_[order[t]];
  triangles_ = std::move(sorted);
  parallel::for_each_uneven(nodes_.size(), [&](std::size_t n) { sum_up(nodes_[n]); });
}

void WindingTree::build(std::vector<std::uint32_t>& order, const std::vector<Vector3>& middles,
                        std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t most_in_leaf = 8;
  const std::size_t number = nodes_.size();
  nodes_.push_back({Vector3::Zero(), Vector3::Zero(), 0.0, begin, end, 0, end - begin <= most_in_leaf});
  if (!nodes_[number].is_leaf) {
    Vector3 lower = middles[order[begin]], upper = lower;
    for (std::uint32_t i = begin; i < end; ++i) {
      lower = lower.cwiseMin(middles[order[i]]);
      upper = upper.cwiseMax(middles[order[i]]);
    }
    Eigen::Index axis = 0;
    (upper - lower).maxCoeff(&axis);
    const std::uint32_t half = begin + (end - begin) / 2;
    // Equal places are ordered by number: the tree does not depend on the library's algorithm.
    std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
                     });
    build(order, middles, begin, half);
    build(order, middles, half, end);
  }
  nodes_[number].next = static_cast<std::uint32_t>(nodes_.size());
}

void WindingTree::sum_up(Node& node) const {
  double area = 0.0;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const Triangle& t = triangles_[i];
    const Vector3 vector_area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
    node.dipole += vector_area;
    area += vector_area.norm();
    node.centre += vector_area.norm() / 3.0 * (t[0] + t[1] + t[2]);
  }
  node.centre /= area;
  double square = 0.0;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    for (const Vector3& x : triangles_[i]) square = std::max(square, (x - node.centre).squaredNorm());
  }
  constexpr double far = 2.0;  // radii of the node
  node.reach = far * far * square;
}

double WindingTree::winding_number(const Vector3& point) const {
  double halves = 0.0, dipoles = 0.0;
  for (std::uint32_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const Vector3 away = node.centre - point;
    const double square = away.squaredNorm();
    if (square > node.reach) {
      dipoles += node.dipole.dot(away) / (square * std::sqrt(square));
      n = node.next;
      continue;
    }
    if (node.is_leaf) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) halves += half_angle(triangles_[i], point);
    }
    ++n;
  }
  return (2.0 * halves + dipoles) / (4.0 * std::numbers::pi);
}

}  // namespace whipple::solids
