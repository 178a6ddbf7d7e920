// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "src/case/build/patches.hpp"
#include "src/case/case.hpp"

namespace whipple::cases {
namespace {

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
               "pressure of the patch of `face` inside the box: a force into the domain on the area that "
               "material covers at the start, distributed by mass over the material within a cell of the "
               "face")
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
  if (pressure != not_given && face == Face::none) {
    faults.add("face", "a 'pressure' needs the 'face' of the domain on which it acts");
  } else if (pressure == not_given && face != Face::none && given > 0) {
    faults.add("face", "'face' is that of a 'pressure'");
  }
  if (setup.domain.is_planar() && face != Face::none && static_cast<int>(face) / 2 == 2) {
    faults.add("face", "in two dimensions there is no face across z");
  } else if (face != Face::none && setup.geometry.cell_size > 0.0) {
    check_face(setup, faults);
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

/// Adds faults for a face that would pull material back, and for a box that does not reach the face.
void AppliedLoad::check_face(const Case& setup, const Faults& faults) const {
  const FacePlane of_face = plane(setup);
  if (setup.geometry.mirrors(static_cast<std::size_t>(face))) {
    const bool is_axis = setup.geometry.is_axisymmetric() && face == Face::y_lower;
    faults.add("face",
               is_axis ? "there is no pressure on the axis of rings: it has no area"
                       : fmt::format("'{}' is of kind \"{}\", to which material is bonded, and would hold it "
                                     "against the pressure: expected a face of kind \"separating\", "
                                     "\"friction\" or \"outflow\"",
                                     word_of(face),
                                     word_of(setup.geometry.boundary[static_cast<std::size_t>(face)])));
  }
  if (!box) return;
  const double inner = of_face.position + of_face.inward * setup.geometry.cell_size;
  const double low = std::min(of_face.position, inner), high = std::max(of_face.position, inner);
  const double tolerance = setup.geometry.tolerance();
  if (box->lower[of_face.axis] <= low + tolerance && box->upper[of_face.axis] >= high - tolerance) return;
  faults.add(
      "box",
      fmt::format("a pressure acts on material within a cell of its face, {0} = {1:.6g} m to "
                  "{2:.6g} m: expected a box that contains it, found {0} = {3:.6g} m to {4:.6g} m",
                  "xyz"[of_face.axis], low, high, box -> lower[of_face.axis], box -> upper[of_face.axis]));
}

FacePlane AppliedLoad::plane(const Case& setup) const {
  const int index = static_cast<int>(face), axis = index / 2;
  return index % 2 == 0 ? FacePlane{axis, setup.geometry.lower[axis], 1.0}
                        : FacePlane{axis, setup.geometry.upper(axis), -1.0};
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
    const FacePlane of_face = plane(setup);
    const double other = of_face.position + of_face.inward * setup.geometry.cell_size;
    region.lower[of_face.axis] = std::min(of_face.position, other);
    region.upper[of_face.axis] = std::max(of_face.position, other);
  }
  if (body.empty()) return region;
  const auto known = std::ranges::find(setup.bodies, body, &Body::name);
  region.body = static_cast<std::size_t>(known - setup.bodies.begin());
  return region;
}

Vector3 AppliedLoad::total_force(const Case& setup) const {
  if (face == Face::none) return force;
  const FacePlane of_face = plane(setup);
  return pressure * patch_of(setup, *this).covered * of_face.inward * Vector3::Unit(of_face.axis);
}

}  // namespace whipple::cases
