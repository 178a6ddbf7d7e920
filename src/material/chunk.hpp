// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/material/kinematics.hpp"
#include "src/material/material.hpp"
#include "src/material/update.hpp"

/// Working set of the constitutive update: the input of a step and the chunk that it updates.
namespace whipple::material {

/// Selects the source of the internal energy of a step: the exact work identity of the grid, or the work of the
/// stresses.
enum class Energy : std::uint8_t { from_grid, integrated };

/// Maximum number of components of the history fields of a material.
constexpr std::size_t most_history = 32;

/// Holds the input of a chunk; models only read it.
struct Step {
  const Material& material;
  const MaterialPoints& points;       // before the step
  std::span<const Matrix3> gradient;  // of this chunk; empty if `components` is given
  GradientComponents components;      // the same by component
  // Tr C of this chunk, 1/s, for HeatingViscosity::of_affine_field
  std::span<const double> affine_divergence;
  const UpdateSettings& settings;
  Energy energy;

  /// Returns whether the points store the heating part of the artificial viscosity.
  [[nodiscard]] bool distinguishes_heating() const {
    return settings.heating != HeatingViscosity::not_distinguished;
  }
};

/// Holds the data of one chunk, on the stack; entry k belongs to point `index[k]`.
struct Chunk {
  std::size_t size = 0;
  std::array<std::size_t, chunk_size> index;
  /// Describes points that are contiguous in memory: index[k + 1] = index[k] + 1 for k in [begin, end - 1).
  struct Run {
    std::size_t begin, end;
  };
  std::array<Run, chunk_size> runs;
  std::size_t run_count = 0;
  MaterialReport report;  // of all chunks so far
  // State of the points, before the step until replaced:
  Lanes mass, volume, void_volume, specific_internal_energy, artificial_viscosity, sound_speed;
  Lanes pressure, temperature, plastic_strain;
  Lanes melted = {}, vaporised = {};  // zero unless the model has phases and fetches them
  std::array<std::uint8_t, chunk_size> failed;
  Lanes intact;                                                   // 1; 0 of failed points
  bool any_failed = false, any_void = false, any_melted = false;  // any_melted: before the step
  bool codes_changed = false;                                     // `failed` has changed for some point
  std::array<Lanes, most_history> history;  // declared fields of the model, convected over the step
  // Derived quantities:
  Lanes old_volume, old_density;
  Lanes density;
  Lanes volume_change;      // of the material, m^3: change on which its pressure does work
  Lanes heating_viscosity;  // only of steps that distinguish it
  Kinematics motion;        // its deviator becomes the new one
  Lanes acting_pressure;    // at the end of the step, after failure, Pa
  // Scratch of the models:
  Lanes solid_fraction;         // fraction of the stiffness that a point retains
  SymmetricLanes old_deviator;  // for schemes that integrate the energy
  Lanes solid_modulus, increment;
  Lanes elastic_energy;       // of the deviator, J/m^3
  Lanes energy, half_change;  // input of the equation of state, J/kg and m^3/kg
  Lanes bulk_sound_speed, bulk_modulus;
  Lanes least_pressure;    // of brittle material only: pressure at which voids open, Pa
  Lanes threshold_factor;  // scatter factor of the failure threshold
  Lanes whole_volume;      // of material and void, before voids grow
  Lanes band;              // width to which strain localises, m
  std::array<std::uint8_t, chunk_size> old_failed;
  Lanes kept;  // fraction of the deviator that is retained, where the chunk loses some
  bool loses = false;
  Lanes old_distension;  // of porous material only
  Lanes dilation;        // of soil that dilates only: fraction of its dilation that is left
  bool burns = false;    // whether any point is at a detonation front
  Lanes burning;         // if so: 1 for points that burn or are about to

  template <class Array>
  auto view(Array& array) {
    return std::span(array.data(), size);
  }
  /// Returns the state of the points for the strength model.
  /// @param threshold  lane of the threshold stress, or one that no model reads
  strength::State strength_state(Lanes& at_density, std::size_t threshold) {
    return {view(at_density), view(pressure), view(temperature), view(plastic_strain),
            view(history[threshold])};
  }
  /// Returns the lanes of a history field.
  template <std::size_t components>
  [[nodiscard]] std::span<Lanes, components> field(std::size_t lane) {
    return std::span<Lanes, components>(&history[lane], components);
  }

  /// Copies one field of the points into the chunk (`fetch`) or back (`deposit`).
  template <class Value, class To>
    requires std::is_arithmetic_v<Value>
  void fetch(const std::vector<Value>& from, To& to) const {
    for (const Run& run : std::span(runs).first(run_count)) {
      copy(from.data() + index[run.begin], to.data() + run.begin, run.end - run.begin);
    }
  }
  template <class Value, class From>
    requires std::is_arithmetic_v<Value>
  void deposit(const From& from, std::vector<Value>& to) const {
    for (const Run& run : std::span(runs).first(run_count)) {
      copy(from.data() + run.begin, to.data() + index[run.begin], run.end - run.begin);
    }
  }
  void fetch(const std::vector<SymmetricTensor>& from, std::span<Lanes, 6> to) const;
  void deposit(std::span<const Lanes, 6> from, std::vector<SymmetricTensor>& to) const;
  void fetch(const std::vector<Vector3>& from, std::span<Lanes, 3> to) const;
  void deposit(std::span<const Lanes, 3> from, std::vector<Vector3>& to) const;
  void fetch(const std::vector<Matrix3>& from, std::span<Lanes, 9> to) const;
  void deposit(std::span<const Lanes, 9> from, std::vector<Matrix3>& to) const;

  /// Books plastic work (J) that becomes heat.
  void dissipate(double work) {
    report.dissipation += work;
    report.plastic_heat += work;
  }

  /// Copies the scatter factors of the failure threshold; 1 if no point has one.
  void fetch_threshold_factor(const MaterialPoints& points, Lanes& factor) const {
    if (points.failure_threshold_factor.empty()) {
      std::fill_n(factor.data(), size, 1.0);
    } else {
      fetch(points.failure_threshold_factor, factor);
    }
  }

  void find_runs();
  /// Updates the quantities that depend on the codes in `failed`.
  void find_failed();

 private:
  /// Copies a short run. A call of `memcpy` would take longer than the copy; the empty statement prevents the compiler
  /// from generating one.
  template <class Value>
  static void copy(const Value* from, Value* to, std::size_t n) {
    constexpr std::size_t step = 32 / sizeof(Value);
    if (n < step) {
      for (std::size_t k = 0; k < n; ++k) {
        to[k] = from[k];
        asm volatile("");
      }
      return;
    }
    const auto some = [&](std::size_t k) {
      if constexpr (std::is_same_v<Value, double>) {
        store(to + k, load(from + k));
      } else {
        std::memcpy(to + k, from + k, 32);
      }
    };
    for (std::size_t k = 0; k + step < n; k += step) {
      some(k);
      asm volatile("");
    }
    some(n - step);
  }
};

/// Returns whether any of the first `size` values is positive; processes whole vectors.
inline bool any_positive(const Lanes& values, std::size_t size) {
  std::uint64_t positive = 0;
  for (std::size_t k = 0; k < size; ++k) positive |= values[k] > 0.0 ? 1U : 0U;
  return positive != 0;
}

constexpr std::array<double SymmetricTensor::*, 6> components = {&SymmetricTensor::xx, &SymmetricTensor::yy,
                                                                 &SymmetricTensor::zz, &SymmetricTensor::xy,
                                                                 &SymmetricTensor::yz, &SymmetricTensor::zx};

inline SymmetricTensor tensor(const SymmetricLanes& s, std::size_t k) {
  return {s[0][k], s[1][k], s[2][k], s[3][k], s[4][k], s[5][k]};
}

/// Records the points whose state is out of the range of the equation of state.
inline void book(Chunk& chunk, eos::RangeReport range) {
  if (range.first != eos::RangeReport::none) range.first = chunk.index[range.first];
  chunk.report.equation_of_state.merge(range);
}

}  // namespace whipple::material
