// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <vector>

#include "src/solver/device/problem.hpp"

namespace whipple::solver {
namespace {

using device::Component;

/// Calls f(first component, values of the particles, their neutral value) for all fields that a device keeps; values may
/// be empty.
template <class P, class Function>
void for_each_column(P& particles, Function&& f) {
  f(Component::position, particles.position, 0.0);
  f(Component::velocity, particles.velocity, 0.0);
  f(Component::affine, particles.affine_velocity, 0.0);
  f(Component::deviator, particles.deviatoric_stress, 0.0);
  f(Component::extent, particles.extent, 0.0);
  f(Component::mass, particles.mass, 0.0);
  f(Component::volume, particles.volume, 0.0);
  f(Component::void_volume, particles.void_volume, 0.0);
  f(Component::energy, particles.specific_internal_energy, 0.0);
  f(Component::pressure, particles.pressure, 0.0);
  f(Component::artificial_viscosity, particles.artificial_viscosity, 0.0);
  f(Component::heating_viscosity, particles.heating_viscosity, 0.0);
  f(Component::temperature, particles.temperature, 0.0);
  f(Component::sound_speed, particles.sound_speed, 0.0);
  f(Component::plastic_strain, particles.plastic_strain, 0.0);
  f(Component::melted, particles.melted_fraction, 0.0);
  f(Component::vaporised, particles.vaporised_fraction, 0.0);
  f(Component::failed, particles.failed, 0.0);
  f(Component::maximum_pressure, particles.maximum_pressure, 0.0);
  f(Component::maximum_temperature, particles.maximum_temperature, 0.0);
  f(Component::melting_time, particles.melting_time, 0.0);
  f(Component::threshold_factor, particles.failure_threshold_factor, 1.0);
  f(Component::unresolved, particles.unresolved_energy, 0.0);
  f(Component::allowance, particles.heat_allowance, 0.0);
  f(Component::closing_rate, particles.closing_rate, 0.0);
  f(Component::generation, particles.generation, 0.0);
  const auto history = [&](Component component, const char* name) {
    if (particles.history.find(name) != nullptr) f(component, particles.history.scalar(name), 0.0);
  };
  history(Component::damage, "damage");
  history(Component::fragment_size, "fragment_size");
  history(Component::cold_work, "stored_cold_work");
}

/// Returns the numbers of a value, in the order of a device's components.
template <class Value>
auto* numbers_of(Value& value) {
  if constexpr (requires { value.data(); }) {
    return value.data();
  } else if constexpr (requires { value.xx; }) {
    return &value.xx;
  } else {
    return &value;
  }
}
template <class Value>
constexpr std::size_t numbers_in = std::is_arithmetic_v<Value> ? 1 : sizeof(Value) / sizeof(double);

}  // namespace

void to_columns(const Particles& particles, device::PointsOnHost& points) {
  const std::size_t n = particles.size();
  points.body = particles.body;
  points.origin.resize(n);
  std::iota(points.origin.begin(), points.origin.end(), 0U);
  for (std::vector<double>& column : points.numbers) column.assign(n, 0.0);
  for_each_column(particles,
                  [&]<class Value>(Component first, const std::vector<Value>& values, double neutral) {
                    for (std::size_t k = 0; k < numbers_in<Value>; ++k) {
                      std::vector<double>& column = points.numbers[first + k];
                      if (values.empty()) std::ranges::fill(column, neutral);
                      for (std::size_t p = 0; p < values.size(); ++p)
                        column[p] = static_cast<double>(numbers_of(values[p])[k]);
                    }
                  });
}

void from_columns(const device::PointsOnHost& points, Particles& particles) {
  SortBuffers buffers;
  reorder(particles, points.origin, buffers);
  for_each_column(particles, [&]<class Value>(Component first, std::vector<Value>& values, double) {
    for (std::size_t k = 0; k < numbers_in<Value>; ++k) {
      const std::vector<double>& column = points.numbers[first + k];
      for (std::size_t p = 0; p < values.size(); ++p) {
        auto& number = numbers_of(values[p])[k];
        number = static_cast<std::remove_reference_t<decltype(number)>>(column[p]);
      }
    }
  });
}

}  // namespace whipple::solver
