// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whipple::decks::dyna {
namespace {

using Indices = std::vector<std::size_t>;

/// Holds a plane at the border of all parts, and whether its nodes are constrained as by symmetry.
struct Candidate {
  Mirror plane;
  bool holds = true;  ///< so far
};

class MirrorFinder {
 public:
  MirrorFinder(const std::vector<HeldPart>& parts, double cell) : parts_(parts), cell_(cell) {
    Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    for (const HeldPart& part : parts) {
      lower = lower.cwiseMin(part.lower);
      upper = upper.cwiseMax(part.upper);
    }
    tolerance_ = 1e-6 * (upper - lower).maxCoeff();
    for (int axis = 0; axis < 3; ++axis) {
      candidates_.push_back({{axis, false, lower[axis]}});
      candidates_.push_back({{axis, true, upper[axis]}});
    }
  }

  std::vector<Mirror> find() {
    for (Candidate& candidate : candidates_) candidate.holds = all_are_held(candidate.plane);
    bool changed = true;
    while (changed) {
      changed = false;
      for (Candidate& candidate : candidates_) {
        if (!candidate.holds || mostly_held_by_planes(candidate.plane)) continue;
        candidate.holds = false;
        changed = true;
      }
    }
    std::vector<Mirror> found;
    for (const Candidate& candidate : candidates_) {
      const Mirror& plane = candidate.plane;
      if (!candidate.holds || (plane.at_upper && !found.empty() && found.back().axis == plane.axis &&
                               !is_whole((plane.place - found.back().place) / cell_)))
        continue;
      found.push_back(plane);
    }
    return found;
  }

  [[nodiscard]] bool lies_on(const Vector3& x, const Mirror& plane) const {
    return std::abs(x[plane.axis] - plane.place) <= tolerance_;
  }

 private:
  static bool is_whole(double cells) {
    return cells >= 0.5 && std::abs(cells - std::round(cells)) <= 1e-6 * std::max(cells, 1.0);
  }
  template <class Function>
  void for_each_node_on(const Mirror& plane, Function&& f) const {
    for (const HeldPart& part : parts_) {
      for (std::size_t i = 0; i < part.nodes.size(); ++i) {
        if (lies_on(part.nodes[i], plane)) f(part.nodes[i], part.held[i]);
      }
    }
  }
  [[nodiscard]] bool all_are_held(const Mirror& plane) const {
    std::size_t nodes = 0, held = 0;
    for_each_node_on(plane, [&](const Vector3&, Directions directions) {
      ++nodes;
      held += (directions & along(plane.axis)) != 0 ? 1 : 0;
    });
    return nodes > 0 && held == nodes;
  }
  /// Returns whether most nodes of a plane are constrained only by it and other such planes: a clamped face is not a
  /// symmetry plane.
  [[nodiscard]] bool mostly_held_by_planes(const Mirror& plane) const {
    std::size_t nodes = 0, explained = 0;
    for_each_node_on(plane, [&](const Vector3& x, Directions directions) {
      ++nodes;
      for (const Candidate& other : candidates_) {
        if (other.holds && lies_on(x, other.plane))
          directions = static_cast<Directions>(directions & ~along(other.plane.axis));
      }
      explained += directions == 0 ? 1 : 0;
    });
    return 2 * explained >= nodes;
  }

  const std::vector<HeldPart>& parts_;
  std::vector<Candidate> candidates_;
  double cell_;
  double tolerance_ = 0.0;
};

/// Finds boxes that contain the chosen points and none of the others, by cuts that leave the fewest others inside.
class BoxFinder {
 public:
  BoxFinder(const std::vector<Vector3>& points, double margin, std::size_t most)
      : points_(points), margin_(Vector3::Constant(margin)), most_(most) {}

  /// Covers the chosen points; returns false if that needs too many boxes or is impossible.
  /// @param depth  number of cuts so far, each of which adds a box
  bool cover(Indices chosen, const Indices& others, std::size_t depth = 0) {
    if (depth > most_) return false;
    const NodeBox box = box_of(chosen);
    const Indices inside = those_in(box, others);
    if (inside.empty()) {
      boxes.push_back(box);
      return boxes.size() <= most_;
    }
    // The fewest others inside; of equal cuts, the one with the most points in a box without others.
    std::pair<std::size_t, std::size_t> best = {std::numeric_limits<std::size_t>::max(), 0};
    Indices best_below, best_above;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double cut : cuts(chosen, axis)) {
        Indices below, above;
        for (const std::size_t i : chosen) (points_[i][axis] < cut ? below : above).push_back(i);
        if (below.empty() || above.empty()) continue;
        const std::size_t in_lower = those_in(box_of(below), inside).size(),
                          in_upper = those_in(box_of(above), inside).size();
        const std::size_t done = (in_lower == 0 ? below.size() : 0) + (in_upper == 0 ? above.size() : 0);
        const std::pair score = {in_lower + in_upper, chosen.size() - done};
        if (score >= best) continue;
        best = score;
        best_below = std::move(below);
        best_above = std::move(above);
      }
    }
    if (best_below.empty()) return false;  // coincident points
    return cover(std::move(best_below), inside, depth + 1) && cover(std::move(best_above), inside, depth + 1);
  }

  std::vector<NodeBox> boxes;

 private:
  [[nodiscard]] NodeBox box_of(const Indices& chosen) const {
    NodeBox box{points_[chosen.front()], points_[chosen.front()]};
    for (const std::size_t i : chosen) {
      box.lower = box.lower.cwiseMin(points_[i]);
      box.upper = box.upper.cwiseMax(points_[i]);
    }
    box.lower -= margin_;
    box.upper += margin_;
    return box;
  }
  [[nodiscard]] Indices those_in(const NodeBox& box, const Indices& candidates) const {
    Indices inside;
    for (const std::size_t i : candidates) {
      if ((points_[i].array() >= box.lower.array()).all() && (points_[i].array() <= box.upper.array()).all())
        inside.push_back(i);
    }
    return inside;
  }
  /// Returns cut positions between layers: after the first, before the last, in the largest gap and in the middle.
  [[nodiscard]] std::vector<double> cuts(const Indices& chosen, int axis) const {
    std::vector<double> places;
    places.reserve(chosen.size());
    for (const std::size_t i : chosen) places.push_back(points_[i][axis]);
    std::ranges::sort(places);
    std::vector<double> between;
    double largest = 0.0, at_largest = 0.0, at_middle = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const double gap = places[i] - places[i - 1], middle = 0.5 * (places[i] + places[i - 1]);
      if (gap <= 2.0 * margin_[axis]) continue;
      between.push_back(middle);
      if (gap > largest) {
        largest = gap;
        at_largest = middle;
      }
      if (between.size() == 1 || 2 * i <= places.size()) at_middle = middle;
    }
    if (between.empty()) return {};
    return {between.front(), between.back(), at_largest, at_middle};
  }

  const std::vector<Vector3>& points_;
  Vector3 margin_;
  std::size_t most_;
};

}  // namespace

std::vector<Mirror> take_mirrors(std::vector<HeldPart>& parts, double cell) {
  if (parts.empty()) return {};
  MirrorFinder finder(parts, cell);
  const std::vector<Mirror> planes = finder.find();
  for (HeldPart& part : parts) {
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      for (const Mirror& plane : planes) {
        if (finder.lies_on(part.nodes[i], plane))
          part.held[i] = static_cast<Directions>(part.held[i] & ~along(plane.axis));
      }
    }
  }
  return planes;
}

std::optional<std::vector<NodeBox>> boxes_of_held_nodes(const HeldPart& part, std::size_t most) {
  const double margin = 1e-3 * part.shortest_edge;
  std::vector<NodeBox> all;
  for (int axis = 0; axis < 3; ++axis) {
    Indices chosen, others;
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      ((part.held[i] & along(axis)) != 0 ? chosen : others).push_back(i);
    if (chosen.empty()) continue;
    BoxFinder finder(part.nodes, margin, most);
    if (!finder.cover(std::move(chosen), others)) return std::nullopt;
    for (NodeBox& box : finder.boxes) {
      const auto same = std::ranges::find_if(
          all, [&](const NodeBox& other) { return other.lower == box.lower && other.upper == box.upper; });
      if (same == all.end()) {
        box.directions = along(axis);
        all.push_back(box);
      } else {
        same->directions = static_cast<Directions>(same->directions | along(axis));
      }
    }
  }
  if (all.size() > most) return std::nullopt;
  return all;
}

}  // namespace whipple::decks::dyna
