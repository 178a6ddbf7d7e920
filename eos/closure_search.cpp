// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md, "Mixtures in pressure-temperature equilibrium".
#include "eos/closure_search.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double tolerance = 1e-10;  ///< relative spread of pressure and temperature
constexpr double round_off = 1e-14;  ///< of the pressure, relative to the stiffest component
constexpr int newton_steps = 60;
constexpr double greatest_change = 0.25;  ///< |dV_i/V_i| in one step, maximum

double stiffness(const State& s) { return s.density * s.sound_speed * s.sound_speed; }
/// Returns c^2 without the lower limit that models apply inside a van der Waals loop.
double squared_sound_speed(const State& s) {
  const double from_moduli =
      s.isothermal_bulk_modulus / s.density + s.gruneisen * s.gruneisen * s.heat_capacity * s.temperature;
  return std::isfinite(from_moduli) ? from_moduli : s.sound_speed * s.sound_speed;
}
/// Returns whether a component is stable: beyond its spinodal it is unstable at the common pressure; on melting
/// isochores K_T is negative in the equation of state.
bool stable(const State& s) {
  const bool melting = s.melted_fraction > 0 && s.melted_fraction < 1;
  return melting || s.isothermal_bulk_modulus > 0;
}
/// Holds the spread of p and T over the components; the scales are frozen during one step.
struct Spread {
  double pressure = 0, temperature = 0;  ///< means
  double pressure_scale = 0, temperature_scale = 0;
  double stiffest = 0;  ///< largest rho c^2

  Spread(std::span<const Component> components, const std::vector<State>& states) {
    double softest = INFINITY;
    for (std::size_t i = 0; i < states.size(); ++i) {
      stiffest = std::max(stiffest, stiffness(states[i]));
      pressure += components[i].mass_fraction * states[i].pressure;
      temperature += components[i].mass_fraction * states[i].temperature;
      softest = std::min(softest, stiffness(states[i]));
    }
    pressure_scale = std::abs(pressure) + softest;
    temperature_scale = temperature;
  }
  /// Returns the sum of the squared deviations from the means of `states`, in the scales of this spread.
  [[nodiscard]] double measure(std::span<const Component> components,
                               const std::vector<State>& states) const {
    double P = 0, T = 0, sum = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      P += components[i].mass_fraction * states[i].pressure;
      T += components[i].mass_fraction * states[i].temperature;
    }
    for (const State& s : states) {
      sum += std::pow((s.pressure - P) / pressure_scale, 2) +
             std::pow((s.temperature - T) / temperature_scale, 2);
    }
    return sum;
  }
  /// @param noise  pressure (Pa) equivalent to the round-off of V and e
  [[nodiscard]] bool equal(const std::vector<State>& states, double noise) const {
    return std::ranges::all_of(states, [&](const State& s) {
      return std::abs(s.pressure - pressure) <= tolerance * pressure_scale + noise &&
             std::abs(s.temperature - temperature) <= tolerance * temperature;
    });
  }
};

}  // namespace

Response response(const State& s) {
  // P_e = rho Gamma, T_e = 1/C_v, P_V = P P_e - rho^2 c^2, T_V = P T_e - T P_e
  const double P_e = s.density * s.gruneisen;
  const double T_e = std::isfinite(s.heat_capacity) ? 1 / s.heat_capacity : 0.0;
  const double P_V = s.pressure * P_e - s.density * s.density * squared_sound_speed(s);
  const double T_V = s.pressure * T_e - s.temperature * P_e;
  const double determinant = P_V * T_e - P_e * T_V;
  return {T_e / determinant, -P_e / determinant, -T_V / determinant, P_V / determinant};
}

bool ClosureSearch::accept(const std::vector<State>& states) {
  if (std::ranges::all_of(states, stable)) return true;
  beyond_spinodal_ = fmt::format(
      "the equilibrium at {:.6g} Pa, {:.6g} K has a component beyond its spinodal, which would part into "
      "two phases",
      states.front().pressure, states.front().temperature);
  return false;
}

std::optional<std::vector<State>> ClosureSearch::stable_equilibrium(const Trial& start) {
  auto found = newton(start);
  if (found && !accept(*found)) return std::nullopt;
  return found;
}

std::vector<State> ClosureSearch::evaluate(const Trial& trial) const {
  std::vector<State> states;
  states.reserve(components_.size());
  for (std::size_t i = 0; i < components_.size(); ++i) {
    states.push_back(components_[i].eos->state(1 / trial.volume[i], trial.energy[i]));
  }
  return states;
}

std::optional<std::vector<State>> ClosureSearch::newton(Trial trial) {
  const std::size_t n = components_.size();
  std::vector<State> states;
  try {
    states = evaluate(trial);
  } catch (const StateError& fault) {
    last_attempt_ = fault.what();
    return std::nullopt;
  }
  bool last_step = false;
  for (int step = 0; step < newton_steps; ++step) {
    const Spread spread(components_, states);
    double missing_volume = volume_, missing_energy = energy_, energy_scale = 0;
    for (std::size_t i = 0; i < n; ++i) {
      missing_volume -= components_[i].mass_fraction * trial.volume[i];
      missing_energy -= components_[i].mass_fraction * trial.energy[i];
      energy_scale += components_[i].mass_fraction * std::abs(trial.energy[i]);
    }
    const bool conserved = std::abs(missing_volume) <= 1e-13 * volume_ &&
                           std::abs(missing_energy) <= 1e-13 * (energy_scale + std::abs(energy_)) + 1e-9;
    if (conserved && spread.equal(states, 0.0)) return states;
    if (conserved && spread.equal(states, round_off * spread.stiffest)) {
      if (last_step) return states;
      last_step = true;  // one more step, to round-off
    }
    last_attempt_ = fmt::format("Newton's method stopped at {:.6g} to {:.6g} Pa and {:.6g} to {:.6g} K",
                                std::ranges::min(states, {}, &State::pressure).pressure,
                                std::ranges::max(states, {}, &State::pressure).pressure,
                                std::ranges::min(states, {}, &State::temperature).temperature,
                                std::ranges::max(states, {}, &State::temperature).temperature);
    // Common changes of p and T such that the changes of V_i and e_i sum to the residuals (K3).
    std::vector<Response> responses;
    Response sum;
    double right_volume = missing_volume, right_energy = missing_energy;
    for (std::size_t i = 0; i < n; ++i) {
      const Response r = responses.emplace_back(response(states[i]));
      const double x = components_[i].mass_fraction, P = states[i].pressure, T = states[i].temperature;
      sum.add(x, r);
      right_volume += x * (r.volume_by_pressure * P + r.volume_by_temperature * T);
      right_energy += x * (r.energy_by_pressure * P + r.energy_by_temperature * T);
    }
    const double determinant = sum.determinant();
    const double P =
        (right_volume * sum.energy_by_temperature - right_energy * sum.volume_by_temperature) / determinant;
    const double T =
        (sum.volume_by_pressure * right_energy - sum.energy_by_pressure * right_volume) / determinant;
    if (!std::isfinite(P) || !std::isfinite(T)) return std::nullopt;
    std::vector<double> volume_step(n), energy_step(n);
    double part = 1;
    for (std::size_t i = 0; i < n; ++i) {
      const Response& r = responses[i];
      const double dP = P - states[i].pressure, dT = T - states[i].temperature;
      volume_step[i] = r.volume_by_pressure * dP + r.volume_by_temperature * dT;
      energy_step[i] = r.energy_by_pressure * dP + r.energy_by_temperature * dT;
      const double change = std::abs(volume_step[i] / trial.volume[i]);
      if (change > greatest_change) part = std::min(part, greatest_change / change);
    }
    const double before = spread.measure(components_, states);
    const double noise = std::pow(round_off * spread.stiffest / spread.pressure_scale, 2) + 1e-28;
    bool accepted = false;
    for (int halving = 0; halving < 30 && !accepted; ++halving, part *= 0.5) {
      Trial next = trial;
      for (std::size_t i = 0; i < n; ++i) {
        next.volume[i] += part * volume_step[i];
        next.energy[i] += part * energy_step[i];
      }
      try {
        std::vector<State> next_states = evaluate(next);
        // A step that only restores the sums need not reduce the spread.
        const double after = spread.measure(components_, next_states);
        if (!(after <= (conserved ? 1 - 0.1 * part : 1.0) * before || after <= noise)) continue;
        trial = std::move(next);
        states = std::move(next_states);
        accepted = true;
      } catch (const StateError&) {
        // Outside a model: use a shorter step.
      }
    }
    if (!accepted) {
      if (last_step) return states;
      break;
    }
  }
  return std::nullopt;
}

std::vector<double> ClosureSearch::equal_compression() const {
  double reference = 0;
  for (const Component& c : components_) reference += c.mass_fraction / c.eos->reference_density();
  std::vector<double> volume;
  for (const Component& c : components_) volume.push_back(volume_ / (reference * c.eos->reference_density()));
  return volume;
}

std::optional<std::vector<double>> ClosureSearch::softest_fills() const {
  std::vector<double> volume;
  double left = volume_, least = INFINITY;
  std::size_t softest = 0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const EquationOfState& eos = *components_[i].eos;
    volume.push_back(1 / eos.reference_density());
    left -= components_[i].mass_fraction * volume.back();
    const double modulus =
        stiffness(eos.state_at_temperature(eos.reference_density(), eos.reference_temperature()));
    if (modulus < least) {
      least = modulus;
      softest = i;
    }
  }
  volume[softest] += left / components_[softest].mass_fraction;
  if (volume[softest] > 0) return volume;
  return std::nullopt;
}

std::optional<ClosureSearch::Trial> ClosureSearch::equal_temperature(
    const std::vector<double>& volume) const {
  Isochores cold, hot;
  const auto at = [&](double T) {
    Isochores result{T, {volume, {}}, -energy_};
    for (std::size_t i = 0; i < volume.size(); ++i) {
      const double e = components_[i].eos->state_at_temperature(1 / volume[i], T).specific_internal_energy;
      result.trial.energy.push_back(e);
      result.excess += components_[i].mass_fraction * e;
    }
    return result;
  };
  try {
    double T = components_.front().eos->reference_temperature();
    double least = 0;
    for (const Component& c : components_) least = std::max(least, c.eos->least_temperature());
    hot = cold = at(T);
    while (hot.excess < 0) {
      cold = hot;
      hot = at(T *= 1.5);
    }
    while (cold.excess > 0) {
      hot = cold;
      if (T <= least) return hot.trial;
      cold = at(T = std::max(least, T / 1.5));
    }
    while (hot.temperature - cold.temperature > 1e-13 * hot.temperature) {
      const double middle = 0.5 * (cold.temperature + hot.temperature);
      if (middle <= cold.temperature || middle >= hot.temperature) break;
      Isochores next = at(middle);
      (next.excess > 0 ? hot : cold) = std::move(next);
    }
  } catch (const StateError&) {
    return std::nullopt;
  }
  // Isochoric melting is between the last two: some of the components take a fraction of the step.
  const double span = hot.excess - cold.excess;
  const double part = span > 0 ? std::clamp(-cold.excess / span, 0.0, 1.0) : 0.0;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    cold.trial.energy[i] += part * (hot.trial.energy[i] - cold.trial.energy[i]);
  }
  return cold.trial;
}

ClosureSearch::Trial ClosureSearch::trial_of(const std::vector<State>& states) {
  Trial trial;
  for (const State& s : states) {
    trial.volume.push_back(1 / s.density);
    trial.energy.push_back(s.specific_internal_energy);
  }
  return trial;
}

std::vector<State> ClosureSearch::others(double volume, double energy) const {
  if (components_.size() == 2) return {components_[1].eos->state(1 / volume, energy)};
  std::vector<Component> rest(components_.begin() + 1, components_.end());
  for (Component& c : rest) c.mass_fraction /= 1 - components_.front().mass_fraction;
  return mixture_at_energy(rest, 1 / volume, energy).components;
}

/// Divides the energy: at given volumes the temperature of the first component increases with its part of the
/// energy and that of the others decreases, so that one division makes them equal.
std::optional<ClosureSearch::Division> ClosureSearch::divide(double log_ratio) const {
  const Component& first = components_.front();
  const double x = first.mass_fraction;
  const double V = volume_ / (1 + std::exp(-log_ratio)) / x,
               V_rest = volume_ / (1 + std::exp(log_ratio)) / (1 - x);
  try {
    double low = first.eos->minimum_energy(1 / V), least = 0;
    if (components_.size() == 2) least = components_[1].eos->minimum_energy(1 / V_rest);
    double high = (energy_ - (1 - x) * least) / x;
    if (components_.size() > 2) high = std::max(high, low) + 1e7 / x;  // the other components set the limit
    if (!(high > low)) return std::nullopt;                            // colder than the coldest states
    std::vector<State> rest;
    State state;
    for (int i = 0; i < 200 && (i == 0 || high - low > 4e-16 * (std::abs(high) + std::abs(low))); ++i) {
      const double e = 0.5 * (low + high);
      state = first.eos->state(1 / V, e);
      try {
        rest = others(V_rest, (energy_ - x * e) / (1 - x));
      } catch (const StateError&) {
        high = e;
        continue;
      }
      const double difference = state.temperature - rest.front().temperature;
      if (std::abs(difference) < 1e-13 * state.temperature) break;
      (difference < 0 ? low : high) = e;
    }
    if (rest.empty()) return std::nullopt;
    Division result;
    result.log_ratio = log_ratio;
    result.difference = state.pressure - rest.front().pressure;
    result.states.push_back(state);
    result.states.insert(result.states.end(), rest.begin(), rest.end());
    return result;
  } catch (const StateError&) {
    return std::nullopt;
  }
}

std::vector<double> ClosureSearch::divisions() const {
  constexpr double reach = 28;
  std::vector<double> grid;
  for (double u = -reach; u <= reach; u += 0.25) grid.push_back(u);
  // A condensed component stores little energy of compression: use a finer grid around the reference densities.
  double rest = 0;
  for (const Component& c : components_.subspan(1)) rest += c.mass_fraction / c.eos->reference_density();
  const double first = components_.front().mass_fraction / components_.front().eos->reference_density();
  for (double ratio = 0.4; ratio < 1.4; ratio += 0.01) {
    if (const double V = ratio * first; V < volume_) grid.push_back(std::log(V / (volume_ - V)));
    if (const double V = ratio * rest; V < volume_) grid.push_back(std::log((volume_ - V) / V));
  }
  std::ranges::sort(grid);
  return grid;
}

ClosureSearch::Division ClosureSearch::edge(double inside, Division division, double outside) const {
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (inside + outside);
    auto next = divide(middle);
    (next ? inside : outside) = middle;
    if (next) division = std::move(*next);
  }
  return division;
}

std::optional<std::vector<State>> ClosureSearch::between(Division left, Division right) {
  for (int i = 0; i < 80 && right.log_ratio - left.log_ratio > 1e-15 * (1 + std::abs(left.log_ratio)); ++i) {
    if (i % 8 == 0) {
      for (const Division& start : {left, right}) {
        if (auto found = stable_equilibrium(trial_of(start.states))) return found;
      }
    }
    auto next = divide(0.5 * (left.log_ratio + right.log_ratio));
    if (!next) break;
    const bool same = (next->difference <= 0) == (left.difference <= 0);
    (same ? left : right) = std::move(*next);
  }
  // At the edge of melting Newton's method may oscillate: the bracket is then the solution.
  const Spread spread(components_, left.states);
  if (spread.equal(left.states, 100 * round_off * spread.stiffest) && accept(left.states)) {
    return left.states;
  }
  return std::nullopt;
}

std::optional<std::vector<State>> ClosureSearch::split() {
  // The difference of the pressures is a continuous function of the division of the volume, positive where the
  // first component is compressed: every sign change is an equilibrium.
  std::optional<Division> before;
  double u_before = -INFINITY;
  for (const double u : divisions()) {
    auto here = divide(u);
    auto left = before, right = here;
    if (std::isinf(u_before)) left = right;
    if (left && !right) right = edge(u_before, *left, u);
    if (right && !left) left = edge(u, *right, u_before);
    if (left && right && (left->difference <= 0) != (right->difference <= 0)) {
      if (auto found = between(std::move(*left), std::move(*right))) return found;
    }
    before = std::move(here);
    u_before = u;
  }
  return std::nullopt;
}

}  // namespace whipple::eos
