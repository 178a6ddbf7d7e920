// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/lithostatic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "src/case/build/lattice.hpp"
#include "src/case/build/placement.hpp"
#include "src/core/base/error.hpp"

namespace whipple::cases {
namespace {

/// Integrates the weight of the material above: d(sigma_v)/dh = rho(p) g, p = (1 + 2 K0)/3 sigma_v.
class Overburden {
 public:
  Overburden(const Case& setup, const Body& body, const Material& material)
      : material_(material), body_(body), k0_(body.initial.lithostatic->k0) {
    const Vector3 gravity = setup.gravity.at(0.0);
    gravity.cwiseAbs().maxCoeff(&axis_);
    gravity_ = std::abs(gravity[axis_]);
    upward_ = gravity[axis_] < 0.0 ? 1.0 : -1.0;
    const Shape::Bounds bounds = bounds_of(setup, body);
    deepest_ = std::max(depth(bounds.lower), depth(bounds.upper));
    highest_ = std::min(depth(bounds.lower), depth(bounds.upper));
    vertical_.push_back(0.0);
    for (int i = 0; i < layers; ++i) vertical_.push_back(below(vertical_.back(), thickness()));
  }

  [[nodiscard]] int axis() const { return static_cast<int>(axis_); }
  [[nodiscard]] double depth(const Vector3& x) const {
    return upward_ * (body_.initial.lithostatic->surface - x[axis_]);
  }
  [[nodiscard]] double deepest() const { return deepest_; }
  [[nodiscard]] double highest() const { return highest_; }
  /// Returns the vertical stress (Pa) at a depth (m).
  [[nodiscard]] double vertical(double depth) const {
    if (!(depth > 0.0)) return 0.0;
    const auto layer = std::min(static_cast<std::size_t>(depth / thickness()), vertical_.size() - 1);
    return below(vertical_[layer], depth - static_cast<double>(layer) * thickness());
  }
  [[nodiscard]] double pressure(double vertical) const { return (1.0 + 2.0 * k0_) / 3.0 * vertical; }
  /// Returns the equivalent stress, Pa.
  [[nodiscard]] double equivalent(double vertical) const { return std::abs(1.0 - k0_) * vertical; }
  [[nodiscard]] eos::State state(double pressure) const {
    const double kelvin = body_.initial.temperature;
    return initial_state(material_, {}, std::isfinite(kelvin) ? std::optional(kelvin) : std::nullopt,
                         pressure);
  }

 private:
  static constexpr int layers = 256;
  [[nodiscard]] double thickness() const { return std::max(deepest_, 0.0) / layers; }
  /// Returns the vertical stress a distance (m) below a point, by the midpoint rule.
  [[nodiscard]] double below(double vertical, double distance) const {
    const auto weight = [&](double stress) { return state(pressure(stress)).density * gravity_; };
    return vertical + distance * weight(vertical + 0.5 * distance * weight(vertical));
  }

  const Material& material_;
  const Body& body_;
  double k0_, gravity_ = 0.0, upward_ = 1.0, deepest_ = 0.0, highest_ = 0.0;
  Eigen::Index axis_ = 0;
  std::vector<double> vertical_;  // at the bounds of the layers, Pa
};

double shear_modulus(const Material& material, const eos::State& state) {
  if (!material.strength->carries_deviator()) return 0.0;
  const std::array rho = {state.density}, p = {state.pressure}, kelvin = {state.temperature}, strain = {0.0};
  std::array<double, 1> modulus = {};
  material.strength->shear_modulus({rho, p, kelvin, strain}, modulus);
  return modulus[0];
}

double strength(const Material& material, const eos::State& state) {
  const std::array rho = {state.density}, p = {state.pressure}, kelvin = {state.temperature}, strain = {0.0},
                   rate = {0.0};
  std::array<double, 1> stress = {};
  material.strength->flow_stress({rho, p, kelvin, strain}, rate, stress);
  return stress[0];
}

constexpr const char *surface_key = "lithostatic.surface", *k0_key = "lithostatic.k0", *whole = "lithostatic";

struct Fault {
  const char* key;
  std::string text;
};

/// Returns the fault of the stress at the bottom of a body; without text if there is none.
Fault fault_of_stress(const Case& setup, const Body& body, const Material& material) {
  const double k0 = body.initial.lithostatic->k0;
  const Overburden overburden(setup, body, material);
  if (overburden.highest() < -setup.geometry.tolerance()) {
    return {surface_key, fmt::format("the body reaches {:.6g} m above the 'surface'", -overburden.highest())};
  }
  const double vertical = overburden.vertical(overburden.deepest()), q = overburden.equivalent(vertical);
  const eos::State state = overburden.state(overburden.pressure(vertical));
  if (k0 == 1.0 || q <= strength(material, state)) return {};
  return {
      k0_key,
      fmt::format("'k0' is {}: at the bottom of the body the stress difference of {:.6g} Pa is beyond the "
                  "strength of {:.6g} Pa at the pressure of {:.6g} Pa: it would flow at once",
                  k0, q, strength(material, state), state.pressure)};
}

/// Returns the fault of a lithostatic state; without text if there is none.
Fault fault_of(const Case& setup, const Body& body, const Material& material) {
  const double k0 = body.initial.lithostatic->k0;
  if ((setup.gravity.at(0.0).array() != 0.0).count() != 1) {
    return {surface_key,
            "a lithostatic state needs a gravity along x, y or z that acts from the start: give "
            "'gravity.acceleration', without 'rise_time', and with no factor of 0 at t = 0"};
  }
  if (std::isfinite(body.initial.pressure) || std::isfinite(body.initial.density)) {
    return {whole,
            "the weight determines pressure and density: give at most 'temperature' beside 'lithostatic'"};
  }
  if (body.discretization.has_elements() || body.discretization.is_bars()) {
    return {whole, "a lithostatic state is that of a body of particles"};
  }
  if (k0 < 0.0) {
    return {
        k0_key,
        fmt::format("'k0' is {}: the weight presses material together horizontally as well, nothing pulls "
                    "it: expected 0 to 1",
                    k0)};
  }
  if (k0 > 1.0) {
    return {k0_key,
            fmt::format("'k0' is {}: weight alone presses no more horizontally than vertically; more is left "
                        "by a load that was removed, which can be simulated: expected 0 to 1",
                        k0)};
  }
  if (k0 != 1.0 && !material.strength->carries_deviator()) {
    return {k0_key, fmt::format("'k0' is {}: material \"{}\" carries no shear stress at rest: expected 1", k0,
                                material.name)};
  }
  try {
    return fault_of_stress(setup, body, material);
  } catch (const InputError& error) {  // of the equation of state, below the depths that it describes
    return {surface_key,
            fmt::format("the material cannot carry its weight below this 'surface': {}", error.what())};
  }
}

}  // namespace

void set_lithostatic(const Case& setup, std::size_t body, Particles& particles, std::size_t begin,
                     std::size_t end) {
  const Material& material = *setup.materials[body];
  const Overburden overburden(setup, setup.bodies[body], material);
  struct Layer {
    eos::State state;
    double vertical, modulus, sound_speed;
  };
  std::map<double, Layer> layers;  // particles of a lattice have few depths
  for (std::size_t i = begin; i < end; ++i) {
    const double depth = overburden.depth(particles.position[i]);
    auto found = layers.find(depth);
    if (found == layers.end()) {
      const double vertical = overburden.vertical(depth);
      const eos::State state = overburden.state(overburden.pressure(vertical));
      const double sound = material.constitutive->sound_speed(material, state);
      found = layers.insert({depth, {state, vertical, shear_modulus(material, state), sound}}).first;
    }
    const auto& [state, vertical, modulus, sound_speed] = found->second;
    particles.mass[i] = particles.volume[i] * state.density;
    particles.pressure[i] = particles.maximum_pressure[i] = state.pressure;
    particles.temperature[i] = particles.maximum_temperature[i] =
        std::isnan(state.temperature) ? 0.0 : state.temperature;
    particles.sound_speed[i] = sound_speed;
    // Tension positive: the vertical deviator is p - sigma_v, the horizontal ones half of it with the other sign.
    std::array<double, 3> s{};
    s.fill(state.pressure - setup.bodies[body].initial.lithostatic->k0 * vertical);
    s[static_cast<std::size_t>(overburden.axis())] = state.pressure - vertical;
    SymmetricTensor& deviator = particles.deviatoric_stress[i];
    deviator = {.xx = s[0], .yy = s[1], .zz = s[2]};
    const double elastic = modulus > 0.0 ? deviator.squared_norm() / (4.0 * modulus * state.density) : 0.0;
    particles.specific_internal_energy[i] = state.specific_internal_energy + elastic;
  }
}

void check_lithostatic(const Case& setup, const Faults& faults) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (!setup.bodies[b].initial.lithostatic || setup.materials[b] == nullptr) continue;
    const auto [key, text] = fault_of(setup, setup.bodies[b], *setup.materials[b]);
    if (!text.empty()) faults.in("body").in(b).in("initial").add(key, text);
  }
}

/// Returns how far the upper surface of a body lies below `surface` (m), where it is lowest, from the particles that are
/// the highest ones of their columns.
static double lowest_surface(const Case& setup, const Body& body) {
  const Vector3 gravity = setup.gravity.at(0.0);
  Eigen::Index axis = 0;
  gravity.cwiseAbs().maxCoeff(&axis);
  const double upward = gravity[axis] < 0.0 ? 1.0 : -1.0, scale = 8.0 / setup.geometry.cell_size;
  const double surface = body.initial.lithostatic->surface;
  std::map<std::array<long, 2>, double> depth_of_column;
  const Shape::Bounds whole_domain = domain_of(setup);
  for (const Shape::Bounds& box : particle_boxes(setup, body, whole_domain)) {
    const Vector3 centre = 0.5 * (box.lower + box.upper);
    const std::array column = {std::lround(scale * centre[(axis + 1) % 3]),
                               std::lround(scale * centre[(axis + 2) % 3])};
    const double top = upward * (surface - (upward > 0.0 ? box.upper : box.lower)[axis]);
    const auto [found, is_new] = depth_of_column.insert({column, top});
    if (!is_new) found->second = std::min(found->second, top);
  }
  double lowest = 0.0;
  for (const auto& [column, depth] : depth_of_column) lowest = std::max(lowest, depth);
  return lowest;
}

std::vector<std::string> lithostatic_warnings(const Case& setup) {
  std::vector<std::string> warnings;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Body& body = setup.bodies[b];
    if (!body.initial.lithostatic) continue;
    if (const double lowest = lowest_surface(setup, body); lowest > 0.5 * setup.geometry.cell_size) {
      warnings.push_back(
          fmt::format("the upper surface of \"{}\" is up to {:.4g} m below 'initial.lithostatic.surface', "
                      "with the stress "
                      "of that depth: it moves unless other material there carries it",
                      body.name, lowest));
    }
    for (const AppliedLoad& load : setup.loads) {
      const LoadedRegion region = load.region(setup);
      if (load.is_damping() || load.table.at(0.0) == 0.0 || (region.body && *region.body != b)) continue;
      warnings.push_back(fmt::format(
          "'initial.lithostatic' of \"{}\" is the state under gravity alone: a load from the start moves it",
          body.name));
      break;
    }
  }
  return warnings;
}

}  // namespace whipple::cases
