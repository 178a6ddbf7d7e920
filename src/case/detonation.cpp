// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/detonation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Detonation> Detonation::parameters() {
  using D = Detonation;
  return {
      choice("shape", &D::shape,
             "detonation starts at a point | along a line, everywhere at the same time | on a plane, on both "
             "sides | "
             "on a sphere | along a line, from one end on with a velocity of its own")
          .optional(),
      vector("position", &D::position, "m", range::any(),
             "the point, a point of the plane, the centre of the sphere, the end where line or cord begin"),
      vector("end", &D::end, "m", range::any(), "other end of line or cord").optional(),
      vector("normal", &D::normal, "", range::any(), "normal of the plane, of any length").optional(),
      real("radius", &D::radius, "m", range::non_negative(), "of the sphere").optional(),
      real("velocity", &D::velocity, "m/s", range::non_negative(), "of detonation along the cord").optional(),
      real("delay", &D::delay, "s", range::non_negative(), "time at which it starts").optional(),
      text("body", &D::body, "the only body that it lights, with burn.lighting = \"straight\"; empty: all")
          .optional()};
}

void Detonation::check(const Case& setup, const Faults& faults) const {
  if (!body.empty() && setup.burn.lighting != LightingRule::straight) {
    faults.add("body", "a detonator lights one body alone with burn.lighting = \"straight\" only");
  }
  const bool there = std::ranges::any_of(setup.bodies, [&](const Body& each) { return lights(each.name); });
  if (!body.empty() && !there) faults.add("body", fmt::format("there is no body \"{}\"", body));
  const bool is_line = shape == DetonatorShape::line || shape == DetonatorShape::cord;
  if (is_line && !((end - position).norm() > 0.0)) {
    faults.add("end", fmt::format("a {} takes 'end', another place than 'position'", word_of(shape)));
  }
  if (shape == DetonatorShape::plane && !(normal.norm() > 0.0)) {
    faults.add("normal", "a plane takes 'normal', a direction such as [0, 0, 1]");
  }
  if (shape == DetonatorShape::sphere && !(radius > 0.0))
    faults.add("radius", "a sphere takes 'radius', above 0");
  if (shape == DetonatorShape::cord && !(velocity > 0.0)) {
    faults.add("velocity", "a cord takes 'velocity', that of its own detonation, above 0");
  }
  const auto refuse = [&](const char* key, bool given, const char* of) {
    if (given) faults.add(key, fmt::format("'{}' belongs to {}, not to a {}", key, of, word_of(shape)));
  };
  refuse("end", !is_line && !end.isZero(0.0), "line or cord");
  refuse("normal", shape != DetonatorShape::plane && !normal.isZero(0.0), "a plane");
  refuse("radius", shape != DetonatorShape::sphere && radius != 0.0, "a sphere");
  refuse("velocity", shape != DetonatorShape::cord && velocity != 0.0, "a cord");
}

Detonation::Ray Detonation::ray_to(const Vector3& point, double detonation_velocity) const {
  const Vector3 offset = point - position;
  switch (shape) {
    case DetonatorShape::point:
      return {position, delay};
    case DetonatorShape::sphere: {
      const double distance = offset.norm();
      return distance > radius ? Ray{position + radius / distance * offset, delay} : Ray{point, delay};
    }
    case DetonatorShape::plane: {
      const Vector3 unit = normal.normalized();
      return {point - unit.dot(offset) * unit, delay};
    }
    case DetonatorShape::line:
    case DetonatorShape::cord:
      break;
  }
  const double length = (end - position).norm();
  const Vector3 along = (end - position) / length;
  const double foot = along.dot(offset);
  if (shape == DetonatorShape::line) return {position + std::clamp(foot, 0.0, length) * along, delay};
  // Point of the cord from which the detonation arrives first: the wave along the cord makes the Mach angle with it.
  const double across = (offset - foot * along).norm(), ratio = detonation_velocity / velocity;
  const double behind = ratio < 1.0 ? across * ratio / std::sqrt(1.0 - ratio * ratio) : foot;
  const double start = std::clamp(foot - behind, 0.0, length);
  return {position + start * along, delay + start / velocity};
}

ParameterTable<BurnControl> BurnControl::parameters() {
  using B = BurnControl;
  return {
      choice(
          "mode", &B::mode,
          "an explosive burns by the time since its lighting, or by compression as soon as the front is two "
          "cells away | by the time alone | by compression anywhere, by the time within four cells of the "
          "detonators")
          .optional(),
      real("width", &B::width, "", range::between(0.5, 20.0), "width of the burning front, in cells")
          .optional(),
      choice("lighting", &B::lighting,
             "detonation runs through explosive only, around everything else | in straight lines from the "
             "detonators, through everything")
          .optional(),
      real("lighting_cell", &B::lighting_cell, "", range::between(0.05, 4.0),
           "cells of the grid on which the arrival of a shadowed detonation is found, in cells; larger where "
           "there "
           "would be more than two million")
          .optional(),
      real("retire_below", &B::retire_below, "Pa", range::non_negative(),
           "pressure below which products are removed and counted as outflow; 0: never")
          .optional()};
}

std::shared_ptr<const Material> ignited(const Case& setup, std::size_t body,
                                        std::shared_ptr<const Material> material) {
  const Body& of_body = setup.bodies[body];
  if (material->burns()) return material;  // the case was already completed
  if (material->explosive == nullptr) {
    if (of_body.ignition == Ignition::detonators && std::isinf(of_body.detonation_velocity)) return material;
    throw InputError(fmt::format("material '{}' is no explosive: omit the key", material->name));
  }
  switch (of_body.ignition) {
    case Ignition::instantaneous:
      return material;
    case Ignition::none:
      return std::make_shared<const Material>(unreacted(*material));
    case Ignition::detonators:
      break;
  }
  if (setup.detonations.empty() && !material->explosive->reaction)
    return material;  // reported by check_explosives
  const double velocity = of_body.detonation_velocity;
  return std::make_shared<const Material>(burning(*material, std::isinf(velocity) ? 0.0 : velocity));
}

void check_explosives(const Case& setup, const Faults& faults) {
  bool any = false;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (setup.materials[b] == nullptr) continue;
    const Body& body = setup.bodies[b];
    const Material& material = *setup.materials[b];
    const Faults of_body = faults.in("body").in(b);
    const bool lit = material.explosive != nullptr && body.ignition == Ignition::detonators;
    any = any || lit;
    if (lit && setup.detonations.empty() && material.explosive->reaction == nullptr) {
      of_body.add(
          "",
          fmt::format("body \"{}\" is an explosive, and nothing lights it: expected a [[detonation]], or of "
                      "the body detonation = \"instantaneous\" (burnt from the start, at constant volume) or "
                      "\"none\" (it never reacts)",
                      body.name));
    }
    if (lit && (body.discretization.has_elements() || body.discretization.is_bars())) {
      of_body.add("discretization", "explosives that burn are made of particles");
    }
    if (lit && body.equation_of_state == Evaluation::table) {
      of_body.add("equation_of_state", "an explosive that burns takes no table: its models are explicit");
    }
    if (std::isfinite(body.detonation_velocity) && body.ignition != Ignition::detonators) {
      of_body.add("detonation_velocity", "no detonation runs through the body: omit the key");
    }
  }
  if (!any && !setup.detonations.empty()) {
    faults.in("detonation")
        .in(std::size_t{0})
        .add("",
             "there is no explosive to light: no body has a material of detonation "
             "products without a key 'detonation'");
  }
  if (!any && setup.burn.retire_below > 0.0) {
    faults.in("burn").add("retire_below",
                          "no body burns in the run, and products that are there from the start are not "
                          "removed: omit the key");
  }
}

}  // namespace whipple::cases
