// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/fem/lists.hpp"

namespace whipple::fem {
namespace {

constexpr std::uint32_t none = 0xffffffff;

/// Holds the corners of the faces at -1 and +1 along a direction; equal positions in both belong to the same edge.
struct Faces {
  std::array<std::size_t, 4> back, front;
};
constexpr std::array<Faces, 3> faces = {
    {{{0, 3, 7, 4}, {1, 2, 6, 5}}, {{0, 1, 5, 4}, {3, 2, 6, 7}}, {{0, 1, 2, 3}, {4, 5, 6, 7}}}};

/// Holds successor and predecessor of each item, or `none`.
struct Links {
  std::vector<std::uint32_t> next, previous;

  explicit Links(std::size_t items) : next(items, none), previous(items, none) {}
  /// Makes b the successor of a, unless either is already linked on that side, or a is the successor of b.
  void join(std::uint32_t a, std::uint32_t b) {
    if (next[a] != none || previous[b] != none || next[b] == a) return;
    next[a] = b;
    previous[b] = a;
  }
  /// Returns the first item of the chain of a; for a ring, a.
  [[nodiscard]] std::uint32_t first_of(std::uint32_t a) const {
    std::uint32_t first = a;
    while (previous[first] != none && previous[first] != a) first = previous[first];
    return previous[first] == none ? first : a;
  }
  /// Returns the chains, with each item once. Rings are cut open.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> chains() const {
    std::vector<std::vector<std::uint32_t>> all;
    std::vector<std::uint8_t> seen(next.size(), 0);
    for (std::uint32_t i = 0; i < next.size(); ++i) {
      if (seen[i] != 0) continue;
      std::vector<std::uint32_t>& chain = all.emplace_back();
      for (std::uint32_t k = first_of(i); k != none && seen[k] == 0; k = next[k]) {
        seen[k] = 1;
        chain.push_back(k);
      }
    }
    return all;
  }
};

/// Links elements whose front face is the back face of another, corner by corner.
Links link_elements(std::span<const Corners> corners, const std::vector<std::uint32_t>& first_corner,
                    const std::vector<std::uint32_t>& node_corners, const Faces& direction) {
  Links links(corners.size());
  for (std::uint32_t e = 0; e < corners.size(); ++e) {
    const std::uint32_t node = corners[e][direction.front[0]];
    for (std::uint32_t k = first_corner[node]; k < first_corner[node + 1]; ++k) {
      const std::uint32_t other = node_corners[k] / 8;
      bool same = other != e;  // a quadrilateral is its own neighbour across the plane
      for (std::size_t i = 0; i < 4; ++i)
        same = same && corners[other][direction.back[i]] == corners[e][direction.front[i]];
      if (same) links.join(e, other);
    }
  }
  return links;
}

Links link_nodes(std::span<const Corners> corners, std::size_t nodes, const Faces& direction) {
  Links links(nodes);
  for (const Corners& c : corners) {
    for (std::size_t i = 0; i < 4; ++i) links.join(c[direction.back[i]], c[direction.front[i]]);
  }
  return links;
}

/// Returns the indices of points along a Morton curve of cells of the given size (m).
std::vector<std::uint32_t> along_curve(std::span<const Vector3> points, double cell) {
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  for (const Vector3& point : points) lower = lower.cwiseMin(point);
  std::vector<std::uint64_t> key(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double steps =
          std::min((points[i][static_cast<int>(axis)] - lower[static_cast<int>(axis)]) / cell, 2e6);
      const auto coordinate = static_cast<std::uint64_t>(steps + 0.5);
      for (unsigned bit = 0; bit < 21; ++bit) key[i] |= (coordinate >> bit & 1U) << (3 * bit + axis);
    }
  }
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return key[i]; });
  return order;
}

}  // namespace

StorageOrder storage_order(std::span<const Vector3> position, std::span<const Corners> corners) {
  StorageOrder order;
  if (corners.empty()) return order;
  static_assert(sizeof(Corners) == 8 * sizeof(std::uint32_t));
  std::vector<std::uint32_t> first_corner, node_corners;
  list_by_item(std::span(corners.front().data(), 8 * corners.size()), position.size(), first_corner,
               node_corners);

  std::vector<std::vector<std::uint32_t>> chains;
  const Faces* direction = nullptr;
  std::size_t most = 0;
  for (const Faces& candidate : faces) {
    auto of_candidate = link_elements(corners, first_corner, node_corners, candidate).chains();
    std::size_t in_full_rows = 0;
    for (const auto& chain : of_candidate) in_full_rows += chain.size() - chain.size() % ElementGroup::size;
    if (direction != nullptr && in_full_rows <= most) continue;
    chains = std::move(of_candidate);
    direction = &candidate;
    most = in_full_rows;
  }

  // Chains are cut into rows of about equal length, which are then ordered along the curve.
  std::vector<std::span<const std::uint32_t>> rows;
  for (const auto& chain : chains) {
    const std::size_t parts = (chain.size() + ElementGroup::size - 1) / ElementGroup::size;
    for (std::size_t i = 0; i < parts; ++i) {
      const std::size_t begin = i * chain.size() / parts, end = (i + 1) * chain.size() / parts;
      rows.push_back(std::span(chain).subspan(begin, end - begin));
    }
  }
  std::vector<Vector3> centre;
  double edges = 0.0;
  for (const auto& row : rows) {
    Vector3 sum = Vector3::Zero();
    for (const std::uint32_t e : row) {
      for (const std::uint32_t node : corners[e]) sum += position[node];
    }
    centre.push_back(sum / (8.0 * static_cast<double>(row.size())));
    const Corners& first = corners[row.front()];
    edges += (position[first[1]] - position[first[0]]).norm() +
             (position[first[3]] - position[first[0]]).norm() +
             (position[first[4]] - position[first[0]]).norm();
  }
  for (const std::uint32_t row : along_curve(centre, edges / (3.0 * static_cast<double>(rows.size())))) {
    order.elements.insert(order.elements.end(), rows[row].begin(), rows[row].end());
  }

  const Links lines = link_nodes(corners, position.size(), *direction);
  std::vector<std::uint8_t> seen(position.size(), 0);
  for (const std::uint32_t e : order.elements) {
    for (const std::uint32_t node : corners[e]) {
      if (seen[node] != 0) continue;
      for (std::uint32_t k = lines.first_of(node); k != none && seen[k] == 0; k = lines.next[k]) {
        seen[k] = 1;
        order.nodes.push_back(k);
      }
    }
  }
  return order;
}

}  // namespace whipple::fem
