// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/common.hpp"

namespace whipple::material {
namespace {

/// Copies L to lanes, from components or from column-major matrices.
void gather_gradient(const Step& step, Chunk& chunk) {
  MatrixLanes& gradient = chunk.motion.gradient;
  if (step.gradient.empty()) {
    for (std::size_t e = 0; e < 9; ++e) {
      std::copy_n(step.components[e], chunk.size, gradient[e].begin());
      std::fill_n(gradient[e].data() + chunk.size, padded(chunk.size) - chunk.size, 0.0);
    }
    return;
  }
  const auto row_major = [](std::size_t e) { return e % 3 * 3 + e / 3; };
  const double* from = step.gradient[0].data();
  std::size_t k = 0;
  for (; k + 4 <= chunk.size; k += 4) {
    const double* m = from + 9 * k;
    for (std::size_t half = 0; half < 2; ++half) {
      const double* at = m + 4 * half;
      const auto columns = transposed({load(at), load(at + 9), load(at + 18), load(at + 27)});
      for (std::size_t e = 0; e < 4; ++e) store(&gradient[row_major(4 * half + e)][k], columns[e]);
    }
    store(&gradient[8][k], whipple::Lanes{m[8], m[17], m[26], m[35]});
  }
  for (; k < chunk.size; ++k) {
    for (std::size_t e = 0; e < 9; ++e) gradient[row_major(e)][k] = from[9 * k + e];
  }
  for (; k < padded(chunk.size); ++k) {
    for (Lanes& lane : gradient) lane[k] = 0.0;
  }
}

/// Sets the history lanes beyond the points of the chunk: kernels process whole registers.
void pad(std::span<Lanes> lanes, std::size_t size) {
  for (Lanes& lane : lanes) std::fill_n(lane.data() + size, padded(size) - size, 0.0);
}

/// Copies history fields to their lanes, convected with the material.
void gather_history(const Step& step, Chunk& chunk) {
  for (const auto& [field, lane] : step.material.constitutive->history()) {
    const History* const history = step.points.history.find(field.name);
    if (history == nullptr)
      throw InternalError("points without the history of their material: " + field.name);
    std::visit(
        [&]<class Value>(const std::vector<Value>& values) {
          if constexpr (std::is_same_v<Value, double>) {
            chunk.fetch(values, chunk.history[lane]);
          } else {
            chunk.fetch(values, chunk.field<sizeof(Value) / sizeof(double)>(lane));
          }
        },
        history->values);
    pad(std::span(&chunk.history[lane], components_of(field.rank)), chunk.size);
    if (field.convection == Convection::corotated) {
      turn(padded(chunk.size), step.settings.time_step, step.settings.rotation, chunk.motion.gradient,
           chunk.field<6>(lane));
    } else if (field.convection == Convection::deformed) {
      deform(padded(chunk.size), step.settings.time_step, chunk.motion.gradient, chunk.field<9>(lane));
    }
  }
}

void scatter_history(Chunk& chunk, const Constitutive& model, MaterialPoints& points) {
  for (const auto& [field, lane] : model.history()) {
    std::visit(
        [&]<class Value>(std::vector<Value>& values) {
          if constexpr (std::is_same_v<Value, double>) {
            chunk.deposit(chunk.history[lane], values);
          } else {
            chunk.deposit(std::span<const Lanes, sizeof(Value) / sizeof(double)>(
                              chunk.field<sizeof(Value) / sizeof(double)>(lane)),
                          values);
          }
        },
        points.history.add(field).values);
  }
}

/// Sets maximum = max(maximum, value) for the first `size` values.
/// @returns whether any maximum has changed
bool raise(Lanes& maximum, const Lanes& value, std::size_t size) {
  std::uint64_t rose = 0;
  for (std::size_t k = 0; k < size; ++k) {
    rose |= value[k] > maximum[k] ? 1U : 0U;
    maximum[k] = value[k] > maximum[k] ? value[k] : maximum[k];
  }
  return rose != 0;
}

}  // namespace

WHIPPLE_KERNEL void gather(const Step& step, Chunk& chunk) {
  const MaterialPoints& points = step.points;
  chunk.fetch(points.mass, chunk.mass);
  chunk.fetch(points.volume, chunk.old_volume);
  chunk.fetch(points.void_volume, chunk.void_volume);
  chunk.fetch(points.specific_internal_energy, chunk.specific_internal_energy);
  chunk.fetch(points.pressure, chunk.pressure);
  chunk.fetch(points.temperature, chunk.temperature);
  chunk.fetch(points.plastic_strain, chunk.plastic_strain);
  chunk.fetch(points.sound_speed, chunk.sound_speed);
  chunk.fetch(points.failed, chunk.failed);
  chunk.find_failed();
  chunk.codes_changed = false;
  chunk.any_void = any_positive(chunk.void_volume, chunk.size);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    chunk.old_density[k] = chunk.mass[k] / chunk.old_volume[k];
  }
  gather_gradient(step, chunk);
  gather_history(step, chunk);
}

WHIPPLE_KERNEL void scatter(const Step& step, Chunk& chunk, MaterialPoints& points) {
  Lanes maximum_pressure, maximum_temperature;
  const bool any_melted = any_positive(chunk.melted, chunk.size);
  chunk.fetch(points.maximum_pressure, maximum_pressure);
  chunk.fetch(points.maximum_temperature, maximum_temperature);
  const bool denser = raise(maximum_pressure, chunk.acting_pressure, chunk.size);
  const bool hotter = raise(maximum_temperature, chunk.temperature, chunk.size);
  const bool new_maximum = denser || hotter;
  if (any_melted || chunk.any_melted) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      double& time = points.melting_time[chunk.index[k]];
      if (chunk.melted[k] >= melted_share && time == never) time = step.settings.time;
    }
    chunk.deposit(chunk.melted, points.melted_fraction);
    chunk.deposit(chunk.vaporised, points.vaporised_fraction);
  }
  chunk.deposit(chunk.volume, points.volume);
  chunk.deposit(chunk.artificial_viscosity, points.artificial_viscosity);
  if (step.distinguishes_heating()) chunk.deposit(chunk.heating_viscosity, points.heating_viscosity);
  chunk.deposit(chunk.acting_pressure, points.pressure);
  chunk.deposit(chunk.plastic_strain, points.plastic_strain);
  chunk.deposit(chunk.temperature, points.temperature);
  chunk.deposit(chunk.sound_speed, points.sound_speed);
  if (new_maximum) {
    chunk.deposit(maximum_pressure, points.maximum_pressure);
    chunk.deposit(maximum_temperature, points.maximum_temperature);
  }
  if (chunk.any_void) chunk.deposit(chunk.void_volume, points.void_volume);
  if (chunk.codes_changed) chunk.deposit(chunk.failed, points.failed);
  chunk.deposit(chunk.motion.deviator, points.deviatoric_stress);
  scatter_history(chunk, *step.material.constitutive, points);
  if (step.energy == Energy::integrated) {
    chunk.deposit(chunk.specific_internal_energy, points.specific_internal_energy);
  }
}

}  // namespace whipple::material
