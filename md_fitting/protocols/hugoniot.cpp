// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/hugoniot.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Minimum relative temperature difference of two runs for which their slope is better than that of the model.
constexpr double secant_share = 0.1;

/// Relative error of dP/dT, one standard deviation: a guessed Grueneisen coefficient, or the noise of a secant.
constexpr double slope_error = 0.15;

/// Holds dG/dT and the isochoric slopes of energy and pressure.
struct Slopes {
  double energy = 0.0;    ///< dE/dT at constant V, J/(kg K)
  double pressure = 0.0;  ///< dP/dT at constant V, Pa/K
  [[nodiscard]] double residual(double half_compression) const {
    return energy - half_compression * pressure;
  }
};

struct Run {
  double temperature = 0.0;
  State state;
};

/// Holds the final values as a function of the measured numbers E, P, E0, V0 (V is exact) and the slopes;
/// differentiated numerically for the errors.
struct Solution {
  std::array<double, 5> values;  ///< temperature, pressure, energy, shock velocity, particle velocity
};

Solution finish(const Run& run, const Slopes& slopes, double energy, double pressure, double reference_energy,
                double reference_volume, double reference_pressure, double volume) {
  const double half = 0.5 * (reference_volume - volume);
  const double residual = energy - reference_energy - half * (pressure + reference_pressure);
  const double step = -residual / slopes.residual(half);
  const double p = pressure + slopes.pressure * step;
  const double jump = p - reference_pressure;
  // Jump conditions of mass and momentum (equation 9).
  const double shock = reference_volume * std::sqrt(jump / (reference_volume - volume));
  const double particle = std::sqrt(jump * (reference_volume - volume));
  return {{run.temperature + step, p, energy + slopes.energy * step, shock, particle}};
}

}  // namespace

ReferenceState reference_state(const PointRecord& zero_pressure) {
  const auto point = read_as<ZeroPressurePoint>(zero_pressure);
  return {point.specific_volume, required(zero_pressure, &ZeroPressurePoint::specific_internal_energy),
          point.pressure, required(zero_pressure, &ZeroPressurePoint::error_correlation)};
}

HugoniotState solve_hugoniot(StateSource& source, const ReferenceState& reference, double specific_volume,
                             const HugoniotSearch& search) {
  const double reference_volume = reference.specific_volume.value;
  if (!(specific_volume > 0.0 && specific_volume < reference_volume)) {
    throw StateError(
        fmt::format("no shock leads from V = {} m^3/kg to V = {} m^3/kg", reference_volume, specific_volume));
  }
  const double half = 0.5 * (reference_volume - specific_volume);
  Slopes slopes{search.specific_heat, search.gruneisen * search.specific_heat / specific_volume};
  if (!(slopes.residual(half) > 0.0)) {
    // At compressions where the slope of the model changes sign, only the energy part is reliable.
    slopes.pressure = 0.0;
  }
  const auto residual = [&](const State& state) {
    return state.specific_internal_energy.value - reference.specific_internal_energy.value -
           half * (state.pressure.value + reference.pressure);
  };
  double temperature = search.first_temperature;
  Run former;
  int runs = 0;
  for (;; ++runs) {
    if (runs == search.most_runs) {
      throw StateError(
          fmt::format("no Hugoniot temperature found at V = {} m^3/kg in {} runs; the last was {:.1f} K",
                      specific_volume, runs, temperature));
    }
    const Run run{temperature, source.state(specific_volume, temperature, StateSource::Effort::search)};
    const double difference = run.temperature - former.temperature;
    if (runs > 0 && std::abs(difference) > secant_share * run.temperature) {
      slopes.energy =
          (run.state.specific_internal_energy.value - former.state.specific_internal_energy.value) /
          difference;
      slopes.pressure = (run.state.pressure.value - former.state.pressure.value) / difference;
    }
    const double slope = slopes.residual(half);
    const double next = temperature - residual(run.state) / slope;
    if (!std::isfinite(next) || !(slope > 0.0)) {
      throw StateError(
          fmt::format("the search for the Hugoniot temperature at V = {} m^3/kg failed at {:.1f} K: "
                      "dG/dT = {} J/(kg K)",
                      specific_volume, temperature, slope));
    }
    former = run;
    const double change = std::abs(next - temperature);
    // A step may not leave the region in which the slope is valid.
    temperature = std::fmin(std::fmax(next, 0.4 * temperature), 2.5 * temperature);
    if (change < search.temperature_tolerance * temperature) break;
  }
  const Run last{temperature, source.state(specific_volume, temperature, StateSource::Effort::final)};

  // Values and errors: E and P of the final run are correlated; those of E0 and V0, from another run, too.
  using Inputs = std::array<double, 5>;  // E, P, E0, V0, dP/dT
  const Inputs inputs = {last.state.specific_internal_energy.value, last.state.pressure.value,
                         reference.specific_internal_energy.value, reference_volume, slopes.pressure};
  const Inputs errors = {last.state.specific_internal_energy.error, last.state.pressure.error,
                         reference.specific_internal_energy.error, reference.specific_volume.error,
                         slope_error * slopes.pressure};
  const auto solve = [&](const Inputs& x) {
    return finish(last, {slopes.energy, x[4]}, x[0], x[1], x[2], x[3], reference.pressure, specific_volume)
        .values;
  };
  const std::array<double, 5> values = solve(inputs);
  std::array<Inputs, 5> changes{};  // of each value by one error of each input
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    Inputs up = inputs;
    Inputs down = inputs;
    up[i] += errors[i];
    down[i] -= errors[i];
    const auto above = solve(up);
    const auto below = solve(down);
    for (std::size_t k = 0; k < values.size(); ++k) changes[k][i] = 0.5 * (above[k] - below[k]);
  }
  HugoniotState result;
  result.specific_volume = specific_volume;
  const std::array<Estimate*, 5> targets = {&result.temperature, &result.pressure,
                                            &result.specific_internal_energy, &result.shock_velocity,
                                            &result.particle_velocity};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto& d = changes[k];
    const double variance = d[0] * d[0] + d[1] * d[1] + 2 * last.state.correlation * d[0] * d[1] +
                            d[2] * d[2] + d[3] * d[3] + 2 * reference.correlation * d[2] * d[3] + d[4] * d[4];
    *targets[k] = {values[k], std::sqrt(std::fmax(variance, 0.0))};
    if (!std::isfinite(values[k])) throw StateError("a Hugoniot state is not finite");
  }
  if (!(result.temperature.value > 0.0)) {
    throw StateError(
        fmt::format("the Hugoniot temperature at V = {} m^3/kg is not positive", specific_volume));
  }
  result.mean_square_displacement = last.state.mean_square_displacement;
  result.solid = last.state.solid;
  result.crystal_share = last.state.crystal_share;
  result.runs = runs + 2;
  for (std::size_t b = 0; b < last.state.pressure_blocks.size(); ++b) {
    result.pressure_blocks.push_back(solve(
        {last.state.energy_blocks[b], last.state.pressure_blocks[b], inputs[2], inputs[3], inputs[4]})[1]);
  }
  return result;
}

}  // namespace whipple::md
