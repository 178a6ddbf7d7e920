// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/levels.hpp"

#include <algorithm>

namespace whipple::grid {
namespace {

/// Width (coarse cells) at the faces of a box in which the weight is 0, and from which on it is 1.
constexpr double outer_margin = 0.5, inner_margin = 2.5;

/// The factors of a weight along the axes, and their derivatives.
struct Ramps {
  Lanes value, slope;
};

/// Sums of the quadratic B-splines about the whole numbers from 0: 0 below -3/2, 1 above 1/2.
Ramps sums_of_splines(Lanes x) {
  const Lanes zero{}, one = broadcast(1.0), two = broadcast(2.0);
  const Lanes begun = minimum(maximum(x + 1.5, zero), two), slope = minimum(begun, two - begun);
  const Lanes rising = 0.5 * slope * slope;
  return {begun < one ? rising : 1.0 - rising, slope};
}

/// Sums of the splines of the coarse nodes all of whose cells are between two faces of a box (2).
Ramps between(Lanes x, Lanes first, Lanes last) {
  const Ramps lower = sums_of_splines(x - first), upper = sums_of_splines(last - x);
  return {lower.value * upper.value, lower.slope * upper.value - lower.value * upper.slope};
}

}  // namespace

Levels::Levels(std::vector<RefinedBox> boxes) : boxes_(std::move(boxes)) {
  for (const RefinedBox& box : boxes_) {
    const auto moved = [](const std::array<double, 3>& face, double by, double fourth) {
      return Lanes{2.0 * (face[0] + by), 2.0 * (face[1] + by), 2.0 * (face[2] + by), fourth};
    };
    const double any = RefinedBox::no_end;  // lane 3 is no direction
    limits_.push_back({.inner_lower = moved(box.from, inner_margin, -any),
                       .inner_upper = moved(box.to, -inner_margin, any),
                       .outer_lower = moved(box.from, outer_margin, -any),
                       .outer_upper = moved(box.to, -outer_margin, any),
                       .first_node = Lanes{box.from[0] + 2.0, box.from[1] + 2.0, box.from[2] + 2.0, 0.0},
                       .last_node = Lanes{box.to[0] - 2.0, box.to[1] - 2.0, box.to[2] - 2.0, 0.0}});
  }
}

Blend Levels::mixed_at(Lanes fine_cells, double fine_cell) const {
  const Lanes x = 0.5 * fine_cells;
  const double per_cell = 0.5 / fine_cell;
  Blend blend{0.0, Vector3::Zero()};
  for (const Limits& box : limits_) {
    if (!is_within(fine_cells, box.outer_lower, box.outer_upper)) continue;
    const auto [value, slope] = between(x, box.first_node, box.last_node);
    const double xy = value[0] * value[1], w = xy * value[2];
    const Vector3 gradient =
        per_cell * Vector3(slope[0] * value[1] * value[2], value[0] * slope[1] * value[2], xy * slope[2]);
    blend.gradient = (1.0 - w) * blend.gradient + (1.0 - blend.fine) * gradient;
    blend.fine += w - blend.fine * w;
  }
  return blend;
}

bool Levels::may_need(Level level, Lanes fine_cells, Lanes within) const {
  if (boxes_.empty()) return level == Level::fine;
  const Lanes x = 0.5 * fine_cells, around = 0.5 * within;
  const auto inside = [&](const RefinedBox& box, double margin, double sign) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double off = margin + sign * around[a];
      if (!(x[a] >= box.from[a] + off && x[a] <= box.to[a] - off)) return false;
    }
    return true;
  };
  if (level == Level::fine)
    return std::ranges::any_of(boxes_,
                               [&](const RefinedBox& box) { return inside(box, outer_margin, -1.0); });
  return std::ranges::none_of(boxes_, [&](const RefinedBox& box) { return inside(box, inner_margin, 1.0); });
}

bool Levels::is_refined(Lanes fine_cells) const {
  if (boxes_.empty()) return true;
  const Lanes x = 0.5 * fine_cells;
  return std::ranges::any_of(boxes_, [&](const RefinedBox& box) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (!(x[a] >= box.from[a] && x[a] <= box.to[a])) return false;
    }
    return true;
  });
}

}  // namespace whipple::grid
