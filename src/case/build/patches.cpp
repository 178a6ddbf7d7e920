// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/patches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "src/case/build/lattice.hpp"
#include "src/case/build/placement.hpp"

namespace whipple::cases {
namespace {

struct Interval {
  double from, to;
};
using Rectangle = std::array<Interval, 2>;

/// Measures rectangles in the plane of a face. In two dimensions the second side is the depth, or the circumference.
class FaceMeasure {
 public:
  FaceMeasure(const grid::Geometry& geometry, const FacePlane& plane)
      : first_(plane.axis == 0 ? 1 : 0),
        second_(plane.axis == 2 ? 1 : 2),
        planar_(geometry.is_planar()),
        radial_(geometry.is_axisymmetric() && first_ == 1),
        depth_(geometry.is_axisymmetric() && first_ == 0 ? 2.0 * std::numbers::pi * plane.position : 1.0) {}

  [[nodiscard]] Rectangle project(const Vector3& lower, const Vector3& upper) const {
    return {Interval{lower[first_], upper[first_]},
            planar_ ? Interval{0.0, depth_} : Interval{lower[second_], upper[second_]}};
  }
  /// Returns the area, m^2.
  [[nodiscard]] double area(const Interval& first, const Interval& second) const {
    const double length = first.to - first.from;
    return (radial_ ? std::numbers::pi * (first.to + first.from) * length : length) *
           (second.to - second.from);
  }

 private:
  int first_, second_;  // axes in the plane
  bool planar_, radial_;
  double depth_;
};

/// Returns the ends of the sides of rectangles along a direction, in ascending order, those apart by round-off once.
std::vector<double> ends_of(const std::vector<Rectangle>& rectangles, std::size_t side, double tolerance) {
  std::vector<double> ends;
  for (const Rectangle& r : rectangles) ends.insert(ends.end(), {r[side].from, r[side].to});
  std::ranges::sort(ends);
  const auto rest = std::ranges::unique(ends, [&](double a, double b) { return b - a < tolerance; });
  ends.erase(rest.begin(), rest.end());
  return ends;
}

/// Returns the area (m^2) that rectangles cover together: on the raster of all their ends.
double union_area(const std::vector<Rectangle>& rectangles, const FaceMeasure& measure, double tolerance) {
  const std::array ends = {ends_of(rectangles, 0, tolerance), ends_of(rectangles, 1, tolerance)};
  const std::size_t columns = ends[1].size();
  std::vector<std::uint8_t> covered(ends[0].size() * columns, 0);
  const auto place = [&](std::size_t side, double end) {
    return static_cast<std::size_t>(std::ranges::lower_bound(ends[side], end - tolerance) -
                                    ends[side].begin());
  };
  for (const Rectangle& r : rectangles) {
    const std::size_t first = place(1, r[1].from), end = place(1, r[1].to);
    for (std::size_t i = place(0, r[0].from); i < place(0, r[0].to); ++i) {
      for (std::size_t j = first; j < end; ++j) covered[i * columns + j] = 1;
    }
  }
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < ends[0].size(); ++i) {
    for (std::size_t j = 0; j + 1 < columns; ++j) {
      if (covered[i * columns + j] != 0)
        area += measure.area({ends[0][i], ends[0][i + 1]}, {ends[1][j], ends[1][j + 1]});
    }
  }
  return area;
}

/// Returns whether material of a body is in the region of a load. For bodies of elements and of bars, whose nodes are at
/// their surface, the bounds decide.
bool touches(const Case& setup, std::size_t body, const LoadedRegion& region) {
  const Body& of = setup.bodies[body];
  if (region.body && *region.body != body) return false;
  if (of.discretization.is_bars() || of.discretization.has_elements()) {
    const Shape::Bounds bounds = bounds_of(setup, of);
    return (bounds.lower.array() <= region.upper.array()).all() &&
           (region.lower.array() <= bounds.upper.array()).all();
  }
  return std::ranges::any_of(particle_boxes(setup, of, {region.lower, region.upper}),
                             [&](const Shape::Bounds& particle) {
                               return region.contains(body, 0.5 * (particle.lower + particle.upper));
                             });
}

}  // namespace

Patch patch_of(const Case& setup, const AppliedLoad& load) {
  const FacePlane plane = load.plane(setup);
  const LoadedRegion region = load.region(setup);
  const FaceMeasure measure(setup.geometry, plane);
  const Shape::Bounds patch = common_part({region.lower, region.upper}, domain_of(setup));
  if ((patch.upper.array() < patch.lower.array()).any()) return {0.0, 0.0};
  std::vector<Rectangle> covered;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    if ((region.body && *region.body != b) || body.discretization.is_bars()) continue;
    for (const Shape::Bounds& box : particle_boxes(setup, body, {region.lower, region.upper})) {
      const double centre = 0.5 * (box.lower + box.upper)[plane.axis];
      const double nearest = plane.inward > 0.0 ? box.lower[plane.axis] : box.upper[plane.axis];
      const double of_mass = body.discretization.has_elements() ? nearest : centre;
      if (of_mass < region.lower[plane.axis] || of_mass > region.upper[plane.axis]) continue;
      const Shape::Bounds part = common_part(box, patch);
      if ((part.upper.array() < part.lower.array()).any()) continue;
      covered.push_back(measure.project(part.lower, part.upper));
    }
  }
  const Rectangle whole = measure.project(patch.lower, patch.upper);
  return {measure.area(whole[0], whole[1]), union_area(covered, measure, setup.geometry.tolerance())};
}

void check_places_of_loads(const Case& setup, const Faults& faults) {
  for (std::size_t i = 0; i < setup.loads.size(); ++i) {
    const AppliedLoad& load = setup.loads[i];
    const Faults of_load = faults.in("load").in(i);
    if (load.face != Face::none) {
      if (!(patch_of(setup, load).covered > 0.0)) {
        of_load.add("face",
                    "the patch of the load touches nothing: no material is within a cell of it at the start");
      }
      continue;
    }
    if (!load.box) continue;
    const LoadedRegion region = load.region(setup);
    bool found = false;
    for (std::size_t b = 0; b < setup.bodies.size() && !found; ++b) found = touches(setup, b, region);
    if (!found) of_load.add("box", "the box of the load touches nothing: no material is in it at the start");
  }
}

std::vector<std::string> describe_patches(const Case& setup) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < setup.loads.size(); ++i) {
    const AppliedLoad& load = setup.loads[i];
    if (load.face == Face::none) continue;
    const Patch patch = patch_of(setup, load);
    lines.push_back(
        fmt::format("load {}: {:.6g} Pa on {}: a force of {:.6g} N at a factor of 1, on {:.6g} mm^2 of "
                    "material, {:.3g} % "
                    "of the patch of {:.6g} mm^2",
                    i + 1, load.pressure, word_of(load.face), load.pressure * patch.covered,
                    1e6 * patch.covered, 1e2 * patch.covered / patch.area, 1e6 * patch.area));
  }
  return lines;
}

}  // namespace whipple::cases
