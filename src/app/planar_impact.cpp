// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/planar_impact.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "eos/loci/impedance.hpp"
#include "eos/loci/isentrope.hpp"
#include "src/core/base/error.hpp"

namespace whipple::app {
namespace {

nlohmann::json as_json(const eos::State& state) {
  return {{"density", state.density},
          {"temperature", state.temperature},
          {"melted_fraction", state.melted_fraction},
          {"vaporised_fraction", state.vaporised_fraction}};
}

/// Behind the shock and after release to zero pressure, null if the model ends before.
nlohmann::json states_of(const std::string& body, const Material& material, const eos::State& shocked) {
  nlohmann::json entry = {
      {"body", body}, {"material", material.name}, {"shocked", as_json(shocked)}, {"released", nullptr}};
  try {
    entry["released"] = as_json(eos::release(*material.eos, shocked, 0.0).end.state);
  } catch (const StateError&) {
  }
  return entry;
}

nlohmann::json impact(const cases::Case& setup, std::size_t projectile, std::size_t target, double velocity) {
  const Material &left = *setup.materials[projectile], &right = *setup.materials[target];
  const eos::ImpedanceMatch match =
      eos::match_impact(eos::Hugoniot(*left.eos), eos::Hugoniot(*right.eos), velocity);
  nlohmann::json result = {
      {"projectile", setup.bodies[projectile].name},
      {"target", setup.bodies[target].name},
      {"velocity", velocity},
      {"pressure", match.pressure},
      {"interface_velocity", match.velocity},
      {"free_surface_velocity", nullptr},
      {"states", nlohmann::json::array({states_of(setup.bodies[projectile].name, left, match.left),
                                        states_of(setup.bodies[target].name, right, match.right)})}};
  try {
    result["free_surface_velocity"] =
        eos::free_surface_velocity(*right.eos, {match.right, match.right_shock_velocity, match.velocity});
  } catch (const StateError&) {
  }
  return result;
}

}  // namespace

nlohmann::json planar_impacts(const cases::Case& setup, int axis) {
  nlohmann::json impacts = nlohmann::json::array();
  const auto fastest = std::ranges::max_element(
      setup.bodies, {}, [](const cases::Body& body) { return body.velocity.norm(); });
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
