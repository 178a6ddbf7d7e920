// SPDX-License-Identifier: BSD-3-Clause
#include "eos/experiments/comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos::experiments {
namespace {

bool is_hugoniot(ExperimentKind kind) {
  return kind == ExperimentKind::shock_velocity || kind == ExperimentKind::shock_pressure ||
         kind == ExperimentKind::sound_speed || kind == ExperimentKind::shock_temperature;
}

/// Returns the density of the model that corresponds to a point of a volume scale.
double density_of(VolumeScale scale, double abscissa, double reference) {
  return scale == VolumeScale::density ? abscissa : reference / abscissa;
}

}  // namespace

bool is_pressure(ExperimentKind kind) {
  return kind == ExperimentKind::isotherm || kind == ExperimentKind::isentrope ||
         kind == ExperimentKind::shock_pressure;
}

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
    const bool porous = is_hugoniot(experiment.kind) && stated > 0.0 && stated < (1.0 - same_density) * solid;
    densities.push_back(porous ? stated : solid);
  }
  return densities;
}

std::vector<double> curve(const EquationOfState& eos, const State& initial, const Experiment& experiment,
                          const CurvePoints& points) {
  std::vector<double> values;
  values.reserve(points.abscissa.size());
  const auto guarded = [&](const auto& function) {
    for (std::size_t i = 0; i < points.abscissa.size(); ++i) {
      try {
        values.push_back(function(i, points.abscissa[i]));
      } catch (const StateError&) {
        values.push_back(nan);  // outside the range of the material; counted by the caller
      }
    }
  };
  if (experiment.kind == ExperimentKind::melting) {
    guarded([&](std::size_t, double pressure) {
      const auto melting = melting_point(eos, pressure);
      return melting ? 0.5 * (melting->solidus.temperature + melting->liquidus.temperature) : nan;
    });
    return values;
  }
  if (experiment.kind == ExperimentKind::isotherm) {
    double reference = nan;
    if (experiment.volume == VolumeScale::ratio) {
      try {
        reference = density_at_pressure(eos, 0.0, experiment.volume_temperature);
      } catch (const StateError&) {  // no condensed state there: all points are out of range
        return std::vector<double>(points.abscissa.size(), nan);
      }
    }
    guarded([&](std::size_t i, double x) {
      return eos.state_at_temperature(density_of(experiment.volume, x, reference), points.temperature[i])
          .pressure;
    });
    return values;
  }
  if (experiment.kind == ExperimentKind::isentrope) {
    guarded([&](std::size_t, double x) {
      return isentrope(eos, initial, {density_of(experiment.volume, x, initial.density)})
          .back()
          .state.pressure;
    });
    return values;
  }
  if (experiment.kind == ExperimentKind::heat_capacity || experiment.kind == ExperimentKind::expansion) {
    guarded([&](std::size_t, double temperature) {
      const State state = eos.state_at_temperature(density_at_pressure(eos, 0.0, temperature), temperature);
      return experiment.kind == ExperimentKind::expansion ? state.thermal_expansion / 3.0
                                                          : state.isobaric_heat_capacity;
    });
    return values;
  }
  const Hugoniot principal(eos, initial.density, initial.specific_internal_energy);
  guarded([&](std::size_t i, double x) {
    const double start = points.initial_density[i];
    const Hugoniot hugoniot = start < initial.density ? Hugoniot::porous(eos, start) : principal;
    switch (experiment.kind) {
      case ExperimentKind::sound_speed:
        return hugoniot.at_pressure(x).state.sound_speed;
      case ExperimentKind::shock_temperature:
        return hugoniot.at_pressure(x).state.temperature;
      case ExperimentKind::shock_velocity:
        return hugoniot.at_particle_velocity(x).shock_velocity;
      default:
        return hugoniot.at_density(density_of(experiment.volume, x, start)).state.pressure;
    }
  });
  return values;
}

Comparison compare(const EquationOfState& eos, const State& initial, const Experiment& experiment) {
  Comparison result;
  const std::vector<double> densities = initial_densities(initial.density, experiment);
  result.model = curve(eos, initial, experiment, {experiment.abscissa, densities, experiment.temperatures});
  for (std::size_t i = 0; i < experiment.abscissa.size(); ++i) {
    const double measured = experiment.ordinate[i];
    const double difference = result.model[i] - measured;
    const double deviation = !is_pressure(experiment.kind) ? 100.0 * difference / measured : difference;
    result.deviation.push_back(deviation);
    if (densities[i] < initial.density) result.porous.push_back(experiment.lines[i]);
    if (is_hugoniot(experiment.kind) &&
        experiment.initial_density[i] > (1.0 + same_density) * initial.density) {
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
