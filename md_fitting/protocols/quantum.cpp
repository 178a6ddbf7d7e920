// SPDX-License-Identifier: BSD-3-Clause
// Quantum corrections to classical nuclei at a volume and a temperature, from the vibrations of the crystal.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/vibrations.hpp"

namespace whipple::md {
namespace {

/// Relative spacing of the volumes adjacent to the point, for derivatives: V (1 -+ step) and V (1 -+ 2 step).
constexpr double volume_step = 0.01;

double mean_of(const std::vector<double>& frequencies, double (*function)(double)) {
  double sum = 0.0;
  for (const double frequency : frequencies) sum += function(frequency);
  return sum / static_cast<double>(frequencies.size());
}

/// Returns -df/dV from the four values adjacent to the point; the error is the difference from the two-point
/// derivative.
Estimate negative_slope(const std::array<double, 5>& f, double volume) {
  const double near = -(f[3] - f[1]) / (2.0 * volume_step * volume);
  const double far = -(f[4] - f[0]) / (4.0 * volume_step * volume);
  const double value = (4.0 * near - far) / 3.0;
  return {value, std::abs(value - near)};
}

TaskResult measure(const Potential& potential, const QuantumPlan& section, double volume,
                   double temperature) {
  TaskResult result;
  QuantumPoint point{.specific_volume = volume, .temperature = temperature};
  const double per_mass = 3.0 / (potential.mass() * metal::dalton);  // three vibrations per atom
  std::array<double, 5> free_energy{}, zero_point{}, logarithm{};
  for (std::size_t i = 0; i < free_energy.size(); ++i) {
    const double here = volume * (1.0 + volume_step * (static_cast<double>(i) - 2.0));
    const ForceConstants constants = measure_force_constants(
        potential, here, section.cells, section.displacement / metal::angstrom, result.transcript);
    const std::vector<double> frequencies = vibration_frequencies(constants);
    const QuantumExcess excess = quantum_excess(frequencies, temperature);
    free_energy[i] = per_mass * excess.free_energy;
    zero_point[i] = per_mass * 0.5 * si::hbar * mean_of(frequencies, [](double w) { return w; });
    logarithm[i] = mean_of(frequencies, [](double w) { return std::log(w); });
    if (i != 2) continue;
    const double square = mean_of(frequencies, [](double w) { return w * w; });
    point.quantum_free_energy = per_mass * excess.free_energy;
    point.quantum_energy = per_mass * excess.energy;
    point.quantum_heat_capacity = per_mass * excess.heat_capacity;
    point.debye_temperature = si::hbar / si::boltzmann * std::sqrt(5.0 / 3.0 * square);
    point.zero_point_energy = zero_point[i];
  }
  point.quantum_pressure = negative_slope(free_energy, volume);
  point.zero_point_pressure = negative_slope(zero_point, volume);
  const Estimate gruneisen = negative_slope(logarithm, volume);
  point.vibration_gruneisen = {gruneisen.value * volume, gruneisen.error * volume};
  result.results = results_of(point);
  return result;
}

}  // namespace

void add_quantum(const Plan& plan, TaskList& list) {
  if (!plan.quantum) return;
  const QuantumPlan section = *plan.quantum;
  for (const double ratio : section.volume_ratio) {
    list.require_range(ratio * (1.0 - 2.0 * volume_step));
    const double volume = ratio * list.potential().static_volume();
    for (const double temperature : section.temperature) {
      list.add(
          {conditions_of(QuantumPoint{.specific_volume = volume, .temperature = temperature}),
           {{"cells", std::to_string(section.cells)},
            {"displacement", fmt::format("{} m", section.displacement)}},
           {}},
          [&potential = list.potential(), section, volume, temperature](std::int64_t, const PointRecord*) {
            return measure(potential, section, volume, temperature);
          });
    }
  }
}

}  // namespace whipple::md
