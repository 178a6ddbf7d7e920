// SPDX-License-Identifier: BSD-3-Clause
#include "eos/experiments/comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::experiments {
namespace {}  // namespace

bool belongs_to(const Experiment& experiment, std::string_view material) {
  const auto lower = [](std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
    return result;
  };
  return lower(material).find(lower(experiment.material)) != std::string::npos;
}

std::vector<double> initial_densities(double solid, const Experiment& experiment) {
  std::vector<double> densities;
  for (std::size_t i = 0; i < experiment.abscissa.size(); ++i) {
    const double stated = std::isnan(experiment.initial_density[i]) ? solid / experiment.porosity[i]
                                                                    : experiment.initial_density[i];
    densities.push_back(stated > 0.0 && stated < (1.0 - same_density) * solid ? stated : solid);
  }
  return densities;
}

std::vector<double> curve(const EquationOfState& eos, const State& initial, const Experiment& experiment,
                          const std::vector<double>& abscissa, const std::vector<double>& initial_density) {
  std::vector<double> values;
  values.reserve(abscissa.size());
  const auto guarded = [&](const auto& function) {
    for (std::size_t i = 0; i < abscissa.size(); ++i) {
      try {
        values.push_back(function(abscissa[i], initial_density[i]));
      } catch (const StateError&) {
        values.push_back(nan);  // outside the material's range: counted by the caller
      }
    }
  };
  if (experiment.kind == ExperimentKind::melting) {
    guarded([&](double pressure, double) {
      const auto melting = melting_point(eos, pressure);
      return melting ? 0.5 * (melting->solidus.temperature + melting->liquidus.temperature) : nan;
    });
    return values;
  }
  if (experiment.kind == ExperimentKind::isotherm) {
    const double density = density_at_pressure(eos, 0.0, experiment.temperature);
    guarded([&](double ratio, double) {
      return eos.state_at_temperature(density / ratio, experiment.temperature).pressure;
    });
    return values;
  }
  if (experiment.kind == ExperimentKind::isentrope) {
    guarded([&](double ratio, double) {
      return isentrope(eos, initial, {initial.density / ratio}).back().state.pressure;
    });
    return values;
  }
  const Hugoniot principal(eos, initial.density, initial.specific_internal_energy);
  guarded([&](double x, double density) {
    const Hugoniot hugoniot = density < initial.density ? Hugoniot::porous(eos, density) : principal;
    if (experiment.kind == ExperimentKind::sound_speed) return hugoniot.at_pressure(x).state.sound_speed;
    return experiment.kind == ExperimentKind::shock_velocity
               ? hugoniot.at_particle_velocity(x).shock_velocity
               : hugoniot.at_density(density / x).state.pressure;
  });
  return values;
}

Comparison compare(const EquationOfState& eos, const State& initial, const Experiment& experiment) {
  Comparison result;
  const std::vector<double> densities = initial_densities(initial.density, experiment);
  result.model = curve(eos, initial, experiment, experiment.abscissa, densities);
  for (std::size_t i = 0; i < experiment.abscissa.size(); ++i) {
    const double measured = experiment.ordinate[i];
    const double difference = result.model[i] - measured;
    const bool relative = experiment.kind == ExperimentKind::shock_velocity ||
                          experiment.kind == ExperimentKind::melting ||
                          experiment.kind == ExperimentKind::sound_speed;
    const double deviation = relative ? 100.0 * difference / measured : difference;
    result.deviation.push_back(deviation);
    if (densities[i] < initial.density) result.porous.push_back(experiment.lines[i]);
    if (experiment.initial_density[i] > (1.0 + same_density) * initial.density) {
      result.denser.push_back(experiment.lines[i]);
    }
    if (std::isnan(deviation)) {
      result.out_of_range.push_back(experiment.lines[i]);
      continue;
    }
    ++result.points;
    result.rms += deviation * deviation;
    result.mean += deviation;
    if (std::abs(deviation) > std::abs(result.maximum)) result.maximum = deviation;
  }
  if (result.points > 0) {
    result.rms = std::sqrt(result.rms / result.points);
    result.mean /= result.points;
  }
  return result;
}

}  // namespace whipple::eos::experiments
