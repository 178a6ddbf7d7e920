// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace whipple::decks {
namespace {

/// Holds a range of cells from..to (excluding the last one) along every direction.
struct CellBox {
  std::array<long, 3> from, to;
};

/// Merges boxes that are adjacent along a direction and have the same cross-section.
void join(std::vector<CellBox>& boxes, std::size_t along) {
  const std::size_t b = (along + 1) % 3, c = (along + 2) % 3;
  const auto across = [&](const CellBox& box) {
    return std::tuple(box.from[b], box.to[b], box.from[c], box.to[c]);
  };
  std::ranges::sort(boxes, [&](const CellBox& left, const CellBox& right) {
    return across(left) != across(right) ? across(left) < across(right)
                                         : left.from[along] < right.from[along];
  });
  std::vector<CellBox> joined;
  for (const CellBox& box : boxes) {
    if (!joined.empty() && across(joined.back()) == across(box) &&
        joined.back().to[along] == box.from[along]) {
      joined.back().to[along] = box.to[along];
    } else {
      joined.push_back(box);
    }
  }
  boxes = std::move(joined);
}

}  // namespace

std::optional<std::vector<LatticeBox>> boxes_of_points(std::span<const Vector3> points, double spacing,
                                                       std::size_t most) {
  if (points.empty() || !(spacing > 0.0)) return std::nullopt;
  Vector3 first = points.front(), last = points.front();
  for (const Vector3& point : points) {
    first = first.cwiseMin(point);
    last = last.cwiseMax(point);
  }
  // The spacing is computed from a mass with few digits: the longest direction determines it more accurately.
  const double extent = (last - first).maxCoeff(), steps = std::round(extent / spacing);
  if (steps >= 1.0 && std::abs(extent / steps - spacing) < 1e-2 * spacing) spacing = extent / steps;
  constexpr double tolerance = 0.02;  // coordinates are written with few digits
  constexpr double greatest = 1e6;    // cells along a direction
  std::vector<CellBox> cells;
  cells.reserve(points.size());
  for (const Vector3& point : points) {
    CellBox cell{};
    for (int i = 0; i < 3; ++i) {
      const double place = (point[i] - first[i]) / spacing, nearest = std::round(place);
      if (!(std::abs(place - nearest) <= tolerance) || nearest > greatest) return std::nullopt;
      cell.from[static_cast<std::size_t>(i)] = static_cast<long>(nearest);
      cell.to[static_cast<std::size_t>(i)] = static_cast<long>(nearest) + 1;
    }
    cells.push_back(cell);
  }
  const auto place = [](const CellBox& cell) { return cell.from; };
  std::ranges::sort(cells, {}, place);
  if (std::ranges::adjacent_find(cells, {}, place) != cells.end()) return std::nullopt;
  for (const std::size_t along : {0, 1, 2}) join(cells, along);
  if (cells.size() > most) return std::nullopt;
  const double grain = 1e-6 * spacing;  // removes the rounding of the coordinates from corners
  const auto corner = [&](int i, long cell) {
    return grain * std::round((first[i] + spacing * (static_cast<double>(cell) - 0.5)) / grain);
  };
  std::vector<LatticeBox> boxes;
  for (const CellBox& cell : cells) {
    LatticeBox box;
    for (int i = 0; i < 3; ++i) {
      box.lower[i] = corner(i, cell.from[static_cast<std::size_t>(i)]);
      box.upper[i] = corner(i, cell.to[static_cast<std::size_t>(i)]);
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace whipple::decks
