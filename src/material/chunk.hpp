// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/material/kinematics.hpp"
#include "src/material/update.hpp"

/// The working set of the constitutive update (update.cpp) and its second half, failure (failing.cpp).
namespace whipple::material {

constexpr double greatest_bulking = 2.0;         ///< distension of bulked material
constexpr double least_sound_speed_ratio = 0.1;  ///< of the bulk sound speed of the reference state

/// Scratch of one chunk, on the stack; entry k belongs to point `index[k]`.
struct Chunk {
  std::size_t size = 0;
  std::array<std::size_t, chunk_size> index;
  /// Points that follow one another in memory: index[k + 1] = index[k] + 1 for k in [begin, end - 1).
  struct Run {
    std::size_t begin, end;
  };
  std::array<Run, chunk_size> runs;
  std::size_t run_count = 0;
  // Of the points, as they were before the step until they are replaced:
  Lanes mass, volume, void_volume, specific_internal_energy, artificial_viscosity, sound_speed;
  Lanes density, pressure, temperature, plastic_strain, melted, damage;
  std::array<std::uint8_t, chunk_size> failed;
  Lanes intact;                                                   // 1, or 0 of what has failed
  bool any_failed = false, any_void = false, any_melted = false;  // any_melted: before the step
  // And what is derived:
  Lanes solid_fraction;
  Lanes old_volume;                    // m^3 of material
  Lanes volume_change;                 // m^3 of material, on which its pressure does work
  Kinematics motion;                   // its deviator becomes the new one
  SymmetricLanes old_deviator;         // of schemes that integrate the energy
  SymmetricLanes back_stress, strain;  // of materials that need them only
  Lanes solid_modulus, increment;
  Lanes energy, bulk_sound_speed, vaporised;
  Lanes acting_pressure;   // after failure
  Lanes distension;        // of porous material only
  Lanes least_pressure;    // of brittle material only: the tension at which its gaps open
  Lanes stored_cold_work;  // of materials that store some only
  Lanes heating_viscosity;  // of points with an affine field only

  template <class Array>
  auto view(Array& array) {
    return std::span(array.data(), size);
  }
  strength::State strength_state() {
    return {view(density), view(pressure), view(temperature), view(plastic_strain)};
  }

  /// One field of the points into the chunk, and back.
  template <class Value, class To>
  void fetch(const std::vector<Value>& from, To& to) const {
    for (const Run& run : std::span(runs).first(run_count)) {
      copy(from.data() + index[run.begin], to.data() + run.begin, run.end - run.begin);
    }
  }
  template <class Value, class From>
  void deposit(const From& from, std::vector<Value>& to) const {
    for (const Run& run : std::span(runs).first(run_count)) {
      copy(from.data() + run.begin, to.data() + index[run.begin], run.end - run.begin);
    }
  }
  void fetch(const std::vector<SymmetricTensor>& from, SymmetricLanes& to) const;
  void deposit(const SymmetricLanes& from, std::vector<SymmetricTensor>& to) const;

  /// The scatter of the failure threshold: 1 where no point has any.
  void fetch_threshold_factor(const MaterialPoints& points, Lanes& factor) const {
    if (points.failure_threshold_factor.empty()) {
      std::fill_n(factor.data(), size, 1.0);
    } else {
      fetch(points.failure_threshold_factor, factor);
    }
  }

  void find_runs();
  /// Sets the quantities that follow from the codes in `failed`.
  void find_failed();

 private:
  /// Runs are short, a call of `memcpy` would take longer than the copy: the empty statement keeps the
  /// compiler from making one.
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

/// Returns whether any of the first `size` values is positive, whole vectors at a time.
inline bool any_positive(const Lanes& values, std::size_t size) {
  std::uint64_t positive = 0;
  for (std::size_t k = 0; k < size; ++k) positive |= values[k] > 0.0 ? 1U : 0U;
  return positive != 0;
}

struct Step {
  const Material& material;
  MaterialPoints& points;
  std::span<const Matrix3> gradient;  // of this chunk, or
  GradientComponents components;      // the same by components
  std::span<const double> affine_divergence;  // of this chunk, or empty
  const UpdateSettings& settings;
  MaterialReport& report;

  /// Returns whether the points distinguish the viscosity that heats.
  [[nodiscard]] bool keeps_losses() const { return !points.heating_viscosity.empty(); }
};

constexpr std::array<double SymmetricTensor::*, 6> components = {&SymmetricTensor::xx, &SymmetricTensor::yy,
                                                                 &SymmetricTensor::zz, &SymmetricTensor::xy,
                                                                 &SymmetricTensor::yz, &SymmetricTensor::zx};

inline SymmetricTensor tensor(const SymmetricLanes& s, std::size_t k) {
  return {s[0][k], s[1][k], s[2][k], s[3][k], s[4][k], s[5][k]};
}

inline void scale(SymmetricLanes& lanes, std::size_t k, double factor) {
  for (Lanes& lane : lanes) lane[k] *= factor;
}

/// Returns the remaining fraction of the stiffness of a point: that of the solid, less its damage if that softens; 0
/// failed.
inline double solid_fraction(const Step& step, const Chunk& chunk, std::size_t k) {
  return chunk.intact[k] * shear_bearing_fraction(chunk.melted[k], chunk.vaporised[k]) *
         (step.material.softens ? 1.0 - chunk.damage[k] : 1.0);
}

/// Returns the fraction of a change of the total volume that goes to the voids of a point: all of it where the point has
/// failed and of brittle material, its damage where cracks open in softening material, and that of the porosity
/// in porous material.
inline double void_share(const Step& step, const Chunk& chunk, std::size_t k) {
  const double porosity = chunk.void_volume[k] / (chunk.volume[k] + chunk.void_volume[k]);
  const double share = step.material.softens ? chunk.damage[k] : porosity;
  return chunk.intact[k] == 0.0 || step.material.brittle ? 1.0 : share;
}

/// Voids grow, criteria are asked: between the equation of state and `finish`.
void apply_failure(Step& step, Chunk& chunk);

/// Strength, damage and bulking of brittle material (docs/theory/concrete_and_ceramics.md).
void relax_brittle(Step& step, Chunk& chunk);

/// Cracks and voids, loss of the deviator by melting and damage, sound speed; writes the new state, all but
/// the energy.
void finish(Step& step, Chunk& chunk);

}  // namespace whipple::material
