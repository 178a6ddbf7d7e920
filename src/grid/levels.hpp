// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "src/core/base/registers.hpp"
#include "src/core/base/tensor.hpp"

/// Two sizes of cells in one domain (docs/theory/levels.md).
namespace whipple::grid {

/// Level of cells: the finest is that of `Geometry::cell_size`, cells of the coarse level are twice as large.
enum class Level : std::uint8_t { fine, coarse };
constexpr std::size_t number(Level level) { return static_cast<std::size_t>(level); }

/// Describes a box of the domain with fine cells, in cells of the coarse level; whole numbers, but for directions in
/// which it has no end.
struct RefinedBox {
  /// Of a side that has no end: the box continues beyond a face of the domain.
  static constexpr double no_end = 1e12;
  /// Number of coarse cells of an edge below which no point has fine functions only.
  static constexpr double least_edge = 5.0;
  std::array<double, 3> from, to;
};

/// Fraction of the fine functions at a point, w of (1), with its gradient.
struct Blend {
  double fine = 1.0;
  Vector3 gradient = Vector3::Zero();  ///< 1/m

  [[nodiscard]] bool is_mixed() const { return fine > 0.0 && fine < 1.0; }
  /// Returns the fraction of the functions of a level.
  [[nodiscard]] double share(Level of) const { return of == Level::fine ? fine : 1.0 - fine; }
  /// Returns its gradient, 1/m.
  [[nodiscard]] Vector3 slope(Level of) const { return of == Level::fine ? gradient : Vector3(-gradient); }
};

/// Tells where the functions of the particles are those of the fine level, of the coarse one, or of both: the weights
/// (1) of the union of the boxes. Without a box all of the domain is fine.
class Levels {
 public:
  Levels() = default;
  explicit Levels(std::vector<RefinedBox> boxes);

  [[nodiscard]] bool are_two() const { return !boxes_.empty(); }
  [[nodiscard]] const std::vector<RefinedBox>& boxes() const { return boxes_; }
  /// Returns the weight at a point.
  /// @param fine_cells  its position in fine cells from the lower corner of the domain
  /// @param fine_cell   m
  [[nodiscard]] Blend at(Lanes fine_cells, double fine_cell) const {
    if (boxes_.empty()) return {};
    bool outside = true;
    for (const Limits& box : limits_) {  // most points have functions of one level
      if (is_within(fine_cells, box.inner_lower, box.inner_upper)) return {};
      outside = outside && !is_within(fine_cells, box.outer_lower, box.outer_upper);
    }
    if (outside) return {0.0, Vector3::Zero()};
    return mixed_at(fine_cells, fine_cell);
  }
  /// Returns the level of the blocks that hold a point: the fine one where its weight is positive.
  [[nodiscard]] Level level_at(Lanes fine_cells) const {
    const auto is_between = [&](const Limits& box) {
      return bits((fine_cells > box.outer_lower) & (fine_cells < box.outer_upper)) == all_lanes;
    };
    return boxes_.empty() || std::ranges::any_of(limits_, is_between) ? Level::fine : Level::coarse;
  }
  /// Returns whether points within a distance (fine cells, along each axis) may have functions of a level.
  [[nodiscard]] bool may_need(Level level, Lanes fine_cells, Lanes within) const;
  /// Returns whether a point is in a box: particles there are as small as the fine cells want them.
  [[nodiscard]] bool is_refined(Lanes fine_cells) const;

 private:
  /// Where the weight of a box is 1, and where it is not 0, in fine cells; the nodes that it is the sum of the functions
  /// of, in coarse cells.
  struct Limits {
    Lanes inner_lower, inner_upper, outer_lower, outer_upper, first_node, last_node;
  };
  static bool is_within(Lanes x, Lanes lower, Lanes upper) {
    return bits((x >= lower) & (x <= upper)) == all_lanes;
  }
  [[nodiscard]] Blend mixed_at(Lanes fine_cells, double fine_cell) const;

  std::vector<RefinedBox> boxes_;
  std::vector<Limits> limits_;  // of the boxes
};

}  // namespace whipple::grid
