// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "src/case/section.hpp"
#include "src/core/base/tensor.hpp"
#include "src/material/material.hpp"

namespace whipple::cases {

/// Selects how an explosive is ignited.
enum class Ignition : std::uint8_t {
  detonators,     ///< by the detonators of the case
  none,           ///< never: it does not react
  instantaneous,  ///< it has burnt from the start, at constant volume
};
constexpr std::array<Word<Ignition>, 3> words(Ignition) {
  return {{{Ignition::detonators, "detonators"},
           {Ignition::none, "none"},
           {Ignition::instantaneous, "instantaneous"}}};
}

/// Selects the shape of a detonator.
enum class DetonatorShape : std::uint8_t { point, line, plane, sphere, cord };
constexpr std::array<Word<DetonatorShape>, 5> words(DetonatorShape) {
  return {{{DetonatorShape::point, "point"},
           {DetonatorShape::line, "line"},
           {DetonatorShape::plane, "plane"},
           {DetonatorShape::sphere, "sphere"},
           {DetonatorShape::cord, "cord"}}};
}

/// Describes a location where detonation starts (docs/theory/burn.md, section 2).
struct Detonation {
  DetonatorShape shape = DetonatorShape::point;
  Vector3 position = Vector3::Zero();  ///< m: point, centre, one end, or a point on the plane
  Vector3 end = Vector3::Zero();       ///< m: other end
  Vector3 normal = Vector3::Zero();    ///< of the plane, of any length
  double radius = 0.0;                 ///< m, of the sphere
  double velocity = 0.0;               ///< m/s, of the detonation along the cord, starting at `position`
  double delay = 0.0;                  ///< s
  std::string body;                    ///< the only body that it lights; empty: all

  [[nodiscard]] bool lights(const std::string& name) const { return body.empty() || body == name; }

  static ParameterTable<Detonation> parameters();
  void check(const Case& setup, const Faults& faults) const;

  /// Describes where and when the straight ray that lights a point starts.
  struct Ray {
    Vector3 from;
    double time;  ///< start time, s
  };
  /// Returns the ray that reaches a point first. @param detonation_velocity  m/s, around the point
  [[nodiscard]] Ray ray_to(const Vector3& point, double detonation_velocity) const;
  /// Returns the arrival time (s) of an unobstructed detonation at a point.
  [[nodiscard]] double arrival(const Vector3& point, double detonation_velocity) const {
    const Ray ray = ray_to(point, detonation_velocity);
    return ray.time + (point - ray.from).norm() / detonation_velocity;
  }
};

/// Selects how lighting times are determined.
enum class LightingRule : std::uint8_t {
  shadowed,  ///< first arrival through explosive, around inert bodies
  straight,  ///< straight lines from the detonators, regardless of obstacles
};
constexpr std::array<Word<LightingRule>, 2> words(LightingRule) {
  return {{{LightingRule::shadowed, "shadowed"}, {LightingRule::straight, "straight"}}};
}

/// Controls the programmed burn of the explosives of a case.
struct BurnControl {
  BurnMode mode = BurnMode::both;
  double width = 2.0;  ///< of the burn front, in cells
  LightingRule lighting = LightingRule::shadowed;
  double lighting_cell = 0.5;  ///< cell size of the grid for lighting times, in cells
  double retire_below = 0.0;   ///< Pa, below which products are removed and counted; 0: never

  static ParameterTable<BurnControl> parameters();
  [[nodiscard]] BurnSettings settings(double cell_size) const {
    return {.mode = mode, .width = width * cell_size, .early = 2.0 * cell_size};
  }
};

/// Returns the material of a body in the form selected by its key `detonation`: burning, unreacted, or burnt.
/// @throws InputError if the material has no such form
std::shared_ptr<const Material> ignited(const Case& setup, std::size_t body,
                                        std::shared_ptr<const Material> material);

/// Adds faults for explosives without detonators, detonators without explosives, and settings that explosives do not
/// support.
void check_explosives(const Case& setup, const Faults& faults);

}  // namespace whipple::cases
