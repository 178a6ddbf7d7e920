// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/levels.hpp"

#include <algorithm>

namespace whipple::grid {
namespace {

/// Width (coarse cells) at the faces of a box in which the weight is 0, and from which on it is 1.
constexpr double outer_margin = 0.5, inner_margin = 2.5;

/// One direction of a weight, and its derivative.
struct Ramp {
  double value, slope;
};

/// Sum over k >= 0 of the quadratic B-splines about k: 0 below -3/2, 1 above 1/2.
Ramp sum_of_splines(double x) {
  if (x <= -1.5) return {0.0, 0.0};
  if (x < -0.5) return {0.5 * (x + 1.5) * (x + 1.5), x + 1.5};
  if (x < 0.5) return {1.0 - 0.5 * (0.5 - x) * (0.5 - x), 0.5 - x};
  return {1.0, 0.0};
}

/// Sum of the splines of the coarse nodes all of whose cells are between two faces of a box (2).
Ramp between(double x, double from, double to) {
  const Ramp lower = sum_of_splines(x - (from + 2.0)), upper = sum_of_splines((to - 2.0) - x);
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
                       .outer_upper = moved(box.to, -outer_margin, any)});
  }
}

Blend Levels::mixed_at(Lanes fine_cells, double fine_cell) const {
  const Lanes x = 0.5 * fine_cells;
  const double per_cell = 0.5 / fine_cell;
  Blend blend{0.0, Vector3::Zero()};
  for (const RefinedBox& box : boxes_) {
    std::array<Ramp, 3> along;
    double w = 1.0;
    for (std::size_t a = 0; a < 3 && w > 0.0; ++a) {
      along[a] = between(x[a], box.from[a], box.to[a]);
      w *= along[a].value;
    }
    if (!(w > 0.0)) continue;
    const Vector3 gradient = per_cell * Vector3(along[0].slope * along[1].value * along[2].value,
                                                along[0].value * along[1].slope * along[2].value,
                                                along[0].value * along[1].value * along[2].slope);
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
