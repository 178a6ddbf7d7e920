// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md, "Mixtures in pressure-temperature equilibrium".
#include "eos/closure.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "eos/closure_search.hpp"
#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

void check(std::span<const Component> components) {
  double sum = 0;
  for (const Component& c : components) {
    if (!(c.mass_fraction > 0)) {
      throw InputError(fmt::format("mixture: mass fractions must be positive, not {}", c.mass_fraction));
    }
    sum += c.mass_fraction;
  }
  if (components.empty() || !(std::abs(sum - 1) < 1e-9)) {
    throw InputError(fmt::format("mixture: the mass fractions must add up to 1, not {:.12g}", sum));
  }
}

Mixture mixture(std::span<const Component> components, std::vector<State> states) {
  Mixture m;
  State& s = m.state;
  s.specific_internal_energy = s.specific_entropy = s.pressure = s.temperature = 0;
  s.phase = states.front().phase;
  double V = 0;
  Response sum;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double x = components[i].mass_fraction;
    const State& c = states[i];
    V += x / c.density;
    s.specific_internal_energy += x * c.specific_internal_energy;
    s.specific_entropy += x * c.specific_entropy;
    s.pressure += x * c.pressure;  // all equal
    s.temperature += x * c.temperature;
    s.melted_fraction += x * c.melted_fraction;
    s.vaporised_fraction += x * c.vaporised_fraction;
    if (c.phase != s.phase) s.phase = "mixture";
    sum.add(x, response(c));
  }
  s.density = 1 / V;
  // (K4)
  const double determinant = sum.determinant();
  const double P_e = -sum.volume_by_temperature / determinant, P_V = sum.energy_by_temperature / determinant;
  s.gruneisen = V * P_e;
  s.heat_capacity = determinant / sum.volume_by_pressure;
  s.isothermal_bulk_modulus = -V / sum.volume_by_pressure;
  const double squared = V * V * (s.pressure * P_e - P_V);
  s.sound_speed = squared >= 0 ? std::sqrt(squared) : State::unknown;
  derive(s);
  for (std::size_t i = 0; i < states.size(); ++i) {
    m.volume_fractions.push_back(components[i].mass_fraction / (states[i].density * V));
  }
  m.components = std::move(states);
  return m;
}

}  // namespace

Mixture mixture_at_energy(std::span<const Component> components, double density,
                          double specific_internal_energy) {
  check(components);
  if (!(density > 0) || !std::isfinite(density) || !std::isfinite(specific_internal_energy)) {
    throw StateError(
        fmt::format("mixture: density and energy must be finite and the density positive ({:.6g} "
                    "kg/m^3, {:.6g} J/kg)",
                    density, specific_internal_energy));
  }
  ClosureSearch search(components, density, specific_internal_energy);
  for (const auto& volumes : {std::optional(search.equal_compression()), search.softest_fills()}) {
    const auto start = volumes ? search.equal_temperature(*volumes) : std::nullopt;
    if (!start) continue;
    if (auto found = search.stable_equilibrium(*start)) {
      return mixture(components, std::move(*found));
    }
  }
  if (components.size() > 1) {
    if (auto found = search.split()) return mixture(components, std::move(*found));
  }
  throw StateError(
      fmt::format("mixture: no equilibrium of pressure and temperature at {:.6g} kg/m^3 and {:.6g} "
                  "J/kg; {}",
                  density, specific_internal_energy, search.reason()));
}

Mixture mixture_at_pressure_and_temperature(std::span<const Component> components, double pressure,
                                            double temperature) {
  check(components);
  std::vector<State> states;
  for (const Component& c : components) {
    states.push_back(state_at_pressure_and_temperature(*c.eos, pressure, temperature));
  }
  return mixture(components, std::move(states));
}

}  // namespace whipple::eos
