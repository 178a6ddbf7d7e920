// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/case/build/placement.hpp"
#include "src/case/case.hpp"

namespace whipple::cases {
namespace {

struct FacePlane {
  int axis;
  double position;  // m
  double inward;    // 1 or -1
};

FacePlane plane_of(const grid::Geometry& geometry, Face face) {
  const int index = static_cast<int>(face), axis = index / 2;
  const bool low = index % 2 == 0;
  return {axis, low ? geometry.lower[axis] : geometry.upper(axis), low ? 1.0 : -1.0};
}

/// Returns the number of directions in which the case has an extent.
int directions(const Case& setup) { return setup.domain.is_planar() ? 2 : 3; }

}  // namespace

ParameterTable<LoadBox> LoadBox::parameters() {
  return {vector("lower", &LoadBox::lower, "m", range::any(), "corner with the smallest coordinates"),
          vector("upper", &LoadBox::upper, "m", range::any(), "corner with the largest coordinates")};
}

void LoadBox::check(const Case& setup, const Faults& faults) const {
  for (int a = 0; a < directions(setup); ++a) {
    if (lower[a] < upper[a]) continue;
    faults.add("upper", fmt::format("the box has no extent along {}: from {} m to {} m", "xyz"[a], lower[a],
                                    upper[a]));
  }
}

ParameterTable<AppliedLoad> AppliedLoad::parameters() {
  using L = AppliedLoad;
  return with_part(
      ParameterTable<L>{
          text("body", &L::body, "body on which it acts; empty: all").optional(),
          vector("acceleration", &L::acceleration, "m/s^2", range::any(), "acceleration of the material")
              .optional(),
          vector("force", &L::force, "N", range::any(),
                 "force, distributed over the material by its mass; of the model as computed, in plane "
                 "strain of 1 m")
              .optional(),
          real("pressure", &L::pressure, "Pa", range::any(),
               "pressure of the patch of `face` inside the box: a force into the domain, distributed over "
               "the material "
               "within a cell of the face by its mass")
              .optional("none"),
          choice("face", &L::face, "face of the domain, with a pressure").optional("none"),
          real("damping", &L::damping, "1/s", range::positive(),
               "acceleration -damping v, which takes energy away")
              .optional("none")},
      &L::table, TimeTable::parameters());
}

std::span<const Section<AppliedLoad>> AppliedLoad::sections() {
  static const std::vector<Section<AppliedLoad>> all = {
      section<&AppliedLoad::box>("box", ", of the material loaded")};
  return all;
}

void AppliedLoad::check(const Case& setup, const Faults& faults) const {
  const int given = (acceleration.isZero(0.0) ? 0 : 1) + (force.isZero(0.0) ? 0 : 1) +
                    (pressure != not_given ? 1 : 0) + (damping != not_given ? 1 : 0);
  if (given != 1) {
    faults.add(
        "",
        fmt::format("a load is one of 'acceleration', 'force', 'pressure' and 'damping', not zero: {} given",
                    given));
  }
  if ((face != Face::none) != (pressure != not_given)) {
    faults.add("face", face == Face::none ? "a 'pressure' needs the 'face' of the domain on which it acts"
                                          : "'face' is that of a 'pressure'");
  }
  if (setup.domain.is_planar() && face != Face::none && static_cast<int>(face) / 2 == 2) {
    faults.add("face", "in two dimensions there is no face across z");
  }
  if (setup.domain.is_planar()) {
    const bool rings = setup.domain.dimension == grid::Dimension::axisymmetric;
    for (const auto& [key, value] : {std::pair{"acceleration", &acceleration}, std::pair{"force", &force}}) {
      if ((*value)[2] == 0.0 && !(rings && (*value)[1] != 0.0)) continue;
      faults.add(key, fmt::format("'{}' must be {}", key, rings ? "along x, the axis" : "in the plane x, y"));
    }
  }
  if (!body.empty() && std::ranges::count(setup.bodies, body, &Body::name) == 0) {
    std::string names;
    for (const Body& known : setup.bodies) names += (names.empty() ? "" : ", ") + known.name;
    faults.add("body", fmt::format("there is no body \"{}\" (accepted: {})", body, names));
  }
  table.check(faults);
  if (damping != not_given &&
      std::ranges::any_of(table.factors, [](double factor) { return factor < 0.0; })) {
    faults.add("factors", "the 'factors' of a damping must not be negative: it would drive the motion");
  }
}

LoadedRegion AppliedLoad::region(const Case& setup) const {
  LoadedRegion region{.body = {},
                      .lower = Vector3::Constant(-std::numeric_limits<double>::infinity()),
                      .upper = Vector3::Constant(std::numeric_limits<double>::infinity())};
  for (int a = 0; box && a < directions(setup); ++a) {
    region.lower[a] = box->lower[a];
    region.upper[a] = box->upper[a];
  }
  if (face != Face::none) {
    const FacePlane plane = plane_of(setup.geometry, face);
    const double other = plane.position + plane.inward * setup.geometry.cell_size;
    region.lower[plane.axis] = std::min(plane.position, other);
    region.upper[plane.axis] = std::max(plane.position, other);
  }
  if (body.empty()) return region;
  const auto known = std::ranges::find(setup.bodies, body, &Body::name);
  region.body = static_cast<std::size_t>(known - setup.bodies.begin());
  return region;
}

Vector3 AppliedLoad::total_force(const Case& setup) const {
  if (face == Face::none) return force;
  const grid::Geometry& g = setup.geometry;
  const FacePlane plane = plane_of(g, face);
  const LoadedRegion patch = region(setup);
  double area = 1.0;
  for (int a = 0; a < directions(setup); ++a) {
    if (a == plane.axis) continue;
    const double from = std::max(patch.lower[a], g.lower[a]), to = std::min(patch.upper[a], g.upper(a));
    const bool radial = g.is_axisymmetric() && a == 1;
    area *= radial ? std::numbers::pi * (to * to - from * from) : std::max(to - from, 0.0);
  }
  if (g.is_axisymmetric() && plane.axis == 1) area *= 2.0 * std::numbers::pi * plane.position;
  return pressure * area * plane.inward * Vector3::Unit(plane.axis);
}

void check_places_of_loads(const Case& setup, const Faults& faults) {
  for (std::size_t i = 0; i < setup.loads.size(); ++i) {
    const AppliedLoad& load = setup.loads[i];
    if (!load.box && load.face == Face::none) continue;
    const LoadedRegion region = load.region(setup);
    bool touches = false;
    for (std::size_t b = 0; b < setup.bodies.size() && !touches; ++b) {
      if (region.body && *region.body != b) continue;
      const std::vector<Shape::Bounds> boxes =
          particle_boxes(setup, setup.bodies[b], {region.lower, region.upper});
      touches = std::ranges::any_of(boxes, [&](const Shape::Bounds& particle) {
        return region.contains(b, 0.5 * (particle.lower + particle.upper));
      });
    }
    if (touches) continue;
    faults.in("load").in(i).add(
        load.face == Face::none ? "box" : "face",
        load.face == Face::none
            ? "the box of the load touches nothing: no material is in it at the start"
            : "the patch of the load touches nothing: no material is within a cell of it at the start");
  }
}

}  // namespace whipple::cases
