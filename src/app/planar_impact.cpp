// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/planar_impact.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "eos/curves/planar_impact.hpp"
#include "src/core/base/error.hpp"

namespace whipple::app {
namespace {

nlohmann::json as_json(const eos::State& state) {
  return {{"density", state.density},
          {"temperature", state.temperature},
          {"melted_fraction", state.melted_fraction},
          {"vaporised_fraction", state.vaporised_fraction}};
}

nlohmann::json as_json(const std::string& body, const Material& material,
                       const eos::curves::ImpactSide& side) {
  return {{"body", body},
          {"material", material.name},
          {"shocked", as_json(side.shocked)},
          {"released", side.released ? as_json(*side.released) : nlohmann::json()}};
}

nlohmann::json impact(const cases::Case& setup, std::size_t projectile, std::size_t target, double velocity) {
  const Material &left = *setup.materials[projectile], &right = *setup.materials[target];
  const std::string &projectile_name = setup.bodies[projectile].name,
                    &target_name = setup.bodies[target].name;
  const eos::curves::PlanarImpact impact = eos::curves::planar_impact(*left.eos, *right.eos, velocity);
  const auto& free_surface = impact.free_surface_velocity;
  return {{"projectile", projectile_name},
          {"target", target_name},
          {"velocity", velocity},
          {"pressure", impact.pressure},
          {"interface_velocity", impact.interface_velocity},
          {"free_surface_velocity", free_surface ? nlohmann::json(*free_surface) : nlohmann::json()},
          {"states", nlohmann::json::array({as_json(projectile_name, left, impact.projectile),
                                            as_json(target_name, right, impact.target)})}};
}

}  // namespace

nlohmann::json planar_impacts(const cases::Case& setup, int axis) {
  nlohmann::json impacts = nlohmann::json::array();
  const auto fastest = std::ranges::max_element(setup.bodies, {},
                                                [](const cases::Body& body) { return body.velocity.norm(); });
  const auto projectile = static_cast<std::size_t>(fastest - setup.bodies.begin());
  std::set<std::string> seen;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (b == projectile || !seen.insert(setup.materials[b]->name).second) continue;
    const double velocity = std::abs(fastest->velocity[axis] - setup.bodies[b].velocity[axis]);
    if (velocity == 0.0) continue;
    try {
      impacts.push_back(impact(setup, projectile, b, velocity));
    } catch (const StateError&) {
    }
  }
  return impacts;
}

}  // namespace whipple::app
