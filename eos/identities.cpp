// SPDX-License-Identifier: BSD-3-Clause
#include "eos/identities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr int reach = 4;  ///< nodes on each side of the eighth-order stencil

/// Returns the states at offsets -4..4 of the stencil, or nothing if one leaves the phase or the model.
template <class At>
std::optional<std::array<State, 2 * reach + 1>> stencil(const At& at, std::string_view phase) {
  std::array<State, 2 * reach + 1> states;
  for (int i = -reach; i <= reach; ++i) {
    try {
      states[i + reach] = at(i);
    } catch (const StateError&) {
      return std::nullopt;
    }
    if (states[i + reach].phase != phase) return std::nullopt;
  }
  return states;
}

double derivative(const std::array<State, 2 * reach + 1>& s, double State::* quantity, double h) {
  constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  double sum = 0;
  for (int i = 1; i <= reach; ++i) sum += weights[i - 1] * (s[reach + i].*quantity - s[reach - i].*quantity);
  return sum / h;
}

/// Returns whether further points of the stencil, besides the middle, have exactly this sound speed.
bool repeated(const std::array<State, 2 * reach + 1>& states, double sound_speed) {
  return std::ranges::count(states, sound_speed, &State::sound_speed) > 1;
}

}  // namespace

double IdentityDefects::largest() const {
  double result = 0;
  for (const double defect : {pressure, sound_speed, heat_capacity, gruneisen, bulk_modulus, entropy_energy,
                              entropy_volume, round_trip}) {
    if (!std::isnan(defect)) result = std::max(result, std::abs(defect));
  }
  return result;
}

IdentityDefects check_identities(const EquationOfState& eos, double density, double specific_internal_energy,
                                 double step) {
  IdentityDefects defects;
  const State s = eos.state(density, specific_internal_energy);
  const double V = 1 / density, T = s.temperature, P = s.pressure;
  const double dV = step * V, dT = step * T, stiffness = density * s.sound_speed * s.sound_speed;

  // (V, E): valid in every phase, even where T is a function of V alone.
  const double dE = step * (std::isfinite(s.heat_capacity) ? s.heat_capacity * T
                                                           : 0.01 * std::abs(specific_internal_energy));
  // Where a model limits the temperature (below its cold curve), the energy is no longer a function of it.
  const bool thermal = std::isfinite(s.heat_capacity);
  const auto unclamped = [&](double rho, double e) {
    const State node = eos.state(rho, e);
    if (thermal && std::abs(eos.state_at_temperature(rho, node.temperature).specific_internal_energy - e) >
                       1e-9 * (std::abs(e) + node.heat_capacity * node.temperature)) {
      throw StateError("temperature limited to the minimum of the model");
    }
    return node;
  };
  const auto along_energy =
      stencil([&](int i) { return unclamped(density, specific_internal_energy + i * dE); }, s.phase);
  // At constant energy the work -P dV of the cold curve heats the point: the step must change T only slightly.
  const double thermal_energy = thermal ? s.heat_capacity * T : dE / step;
  const double dVe = std::min(dV, 0.02 * thermal_energy / (std::abs(P) + 1.0));
  const auto along_volume =
      stencil([&](int i) { return unclamped(1 / (V + i * dVe), specific_internal_energy); }, s.phase);
  if (along_energy) {
    const double slope = derivative(*along_energy, &State::pressure, dE);
    defects.gruneisen = (s.gruneisen - V * slope) / (std::abs(s.gruneisen) + 1);
    defects.entropy_energy = T * derivative(*along_energy, &State::specific_entropy, dE) - 1;
    if (along_volume) {
      const double by_volume = derivative(*along_volume, &State::pressure, dVe);
      const double squared = V * V * (P * slope - by_volume);
      // In the loop of a metastable fluid c^2 may fall below the limit of the model, which is detected by
      // c^2 = V K_T + Gamma^2 C_v T.
      const double from_moduli =
          V * s.isothermal_bulk_modulus + s.gruneisen * s.gruneisen * s.heat_capacity * T;
      const double reported = s.sound_speed * s.sound_speed;
      // Without an entropy the moduli are inconclusive: a limited c is equal at adjacent points.
      const bool held = std::isnan(s.specific_entropy)
                            ? repeated(*along_energy, s.sound_speed) && repeated(*along_volume, s.sound_speed)
                            : from_moduli < 0.999999 * reported;
      if (!held) {
        defects.sound_speed = (reported - squared) / (V * V * (std::abs(P * slope) + std::abs(by_volume)));
      }
    }
  }
  if (along_volume) {
    defects.entropy_volume =
        (T * derivative(*along_volume, &State::specific_entropy, dVe) - P) / (std::abs(P) + stiffness);
  }

  // (V, T), where temperature and volume are independent.
  if (!thermal) return defects;
  const auto hotter = stencil([&](int i) { return eos.state_at_temperature(density, T + i * dT); }, s.phase);
  const auto wider = stencil([&](int i) { return eos.state_at_temperature(1 / (V + i * dV), T); }, s.phase);
  if (hotter) {
    defects.heat_capacity =
        (s.heat_capacity - derivative(*hotter, &State::specific_internal_energy, dT)) / s.heat_capacity;
    defects.round_trip = ((*hotter)[reach].specific_internal_energy - specific_internal_energy) /
                         (std::abs(specific_internal_energy) + s.heat_capacity * T);
  }
  if (wider) {
    const double slope = derivative(*wider, &State::pressure, dV);
    defects.bulk_modulus =
        (s.isothermal_bulk_modulus + V * slope) / (std::abs(s.isothermal_bulk_modulus) + stiffness);
  }
  // Consistency of temperature and pressure is required only of a model with an entropy.
  if (hotter && wider && !std::isnan(s.specific_entropy)) {
    const double by_temperature = derivative(*hotter, &State::pressure, dT);
    const double by_volume = derivative(*wider, &State::specific_internal_energy, dV);
    defects.pressure = (P - (T * by_temperature - by_volume)) /
                       (std::abs(P) + T * std::abs(by_temperature) + std::abs(by_volume));
  }
  return defects;
}

}  // namespace whipple::eos
