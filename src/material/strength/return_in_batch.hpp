// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>

#include "src/material/kinematics.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

constexpr std::size_t batch_size = material::chunk_size;  ///< points that are solved together
using BatchValues = std::array<double, batch_size>;

/// Points of a batch that may yield, one array per quantity. The arrays are padded to a multiple of eight,
/// with points like the last one, so that loops over them have no rest.
struct YieldingPoints {
  std::size_t size = 0;  ///< with the padding
  BatchValues trial, plastic_strain, temperature, modulus, solid;
  BatchValues increment;  ///< of the equivalent plastic strain: the result
};

/// A law with costly functions, which it computes for many points at a time.
template <class Law>
concept BatchLaw = requires(const Law& law, YieldingPoints& points, double number) {
  law.solve(points, number);
  { law.may_yield(number, number, number, number) } -> std::same_as<bool>;
};

/// Solves the return for a batch, as specified by Strength::plastic_increment. The increments of points that
/// cannot yield are 0.
template <BatchLaw Law>
void return_in_batch(const Law& law, const State& state, std::span<const double> trial,
                     std::span<const double> modulus, std::span<const double> solid_fraction, double dt,
                     std::span<double> increment) {
  YieldingPoints points;
  std::array<std::size_t, batch_size> index;
  for (std::size_t begin = 0; begin < trial.size(); begin += batch_size) {
    const std::size_t size = std::min(batch_size, trial.size() - begin);
    const auto may_yield = [&](std::size_t k) {
      const std::size_t i = begin + k;
      return law.may_yield(trial[i], state.temperature[i], modulus[i], solid_fraction[i]);
    };
    std::size_t count = 0;
    for (std::size_t k = 0; k < size; ++k) count += may_yield(k) ? 1 : 0;
    const bool all = count == size;
    if (!all) std::fill_n(increment.begin() + begin, size, 0.0);
    if (count == 0) continue;
    if (!all) {
      count = 0;
      for (std::size_t k = 0; k < size; ++k) {  // without branches: nothing foretells who yields
        index[count] = begin + k;
        count += may_yield(k) ? 1 : 0;
      }
    }
    points.size = material::padded(count);
    const auto take = [&](std::span<const double> from, BatchValues& to) {
      if (all) {
        std::copy_n(from.begin() + begin, count, to.begin());
      } else {
        for (std::size_t k = 0; k < count; ++k) to[k] = from[index[k]];
      }
      for (std::size_t k = count; k < points.size; ++k) to[k] = to[count - 1];
    };
    take(trial, points.trial);
    take(state.plastic_strain, points.plastic_strain);
    take(state.temperature, points.temperature);
    take(modulus, points.modulus);
    take(solid_fraction, points.solid);
    law.solve(points, dt);
    if (all) {
      std::copy_n(points.increment.begin(), count, increment.begin() + begin);
    } else {
      for (std::size_t k = 0; k < count; ++k) increment[index[k]] = points.increment[k];
    }
  }
}

/// The increment of one point.
template <BatchLaw Law>
double increment_of_one(const Law& law, double trial, double plastic_strain, double temperature,
                        double modulus, double solid_fraction, double dt) {
  YieldingPoints points;
  points.size = material::lane_count;
  std::fill_n(points.trial.begin(), points.size, trial);
  std::fill_n(points.plastic_strain.begin(), points.size, plastic_strain);
  std::fill_n(points.temperature.begin(), points.size, temperature);
  std::fill_n(points.modulus.begin(), points.size, modulus);
  std::fill_n(points.solid.begin(), points.size, solid_fraction);
  law.solve(points, dt);
  return points.increment[0];
}

}  // namespace whipple::strength
