// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "eos/constant_heat_capacity.hpp"

/// Evaluates batches of states by the models with a constant heat capacity.
namespace whipple::eos {

template <Curve C>
RangeReport ConstantHeatCapacity<C>::evaluate(const Batch& batch, const Work& work) const {
  const std::size_t n = batch.density.size(), whole = n / width * width, rest = n - whole;
  const bool melted = !batch.melted_fraction.empty(), vaporised = !batch.vaporised_fraction.empty();
  RangeReport report =
      evaluate_whole(batch.density.data(), batch.specific_internal_energy.data(), work.energy.data(),
                     work.half_change.data(), batch.pressure.data(), batch.temperature.data(),
                     batch.sound_speed.data(), melted ? batch.melted_fraction.data() : nullptr,
                     vaporised ? batch.vaporised_fraction.data() : nullptr, whole);
  if (rest > 0) {
    // The last points, padded with the reference state.
    using Group = std::array<double, width>;
    Group density, energy, half_change{}, p{}, T, c, melt, vapour;
    density.fill(reference_density());
    energy.fill(reference_energy());
    const auto from = static_cast<std::ptrdiff_t>(whole);
    const bool works = !work.energy.empty();
    if (works) {
      std::copy_n(work.half_change.begin() + from, rest, half_change.begin());
      std::copy_n(batch.pressure.begin() + from, rest, p.begin());
    }
    std::copy_n(batch.density.begin() + from, rest, density.begin());
    std::copy_n(batch.specific_internal_energy.begin() + from, rest, energy.begin());
    RangeReport last =
        evaluate_whole(density.data(), energy.data(), works ? energy.data() : nullptr, half_change.data(),
                       p.data(), T.data(), c.data(), melt.data(), vapour.data(), width);
    if (works) std::copy_n(energy.begin(), rest, work.energy.begin() + from);
    if (last.first != RangeReport::none) last.first += whole;
    report.merge(last);
    std::copy_n(p.begin(), rest, batch.pressure.begin() + from);
    std::copy_n(T.begin(), rest, batch.temperature.begin() + from);
    std::copy_n(c.begin(), rest, batch.sound_speed.begin() + from);
    if (melted) std::copy_n(melt.begin(), rest, batch.melted_fraction.begin() + from);
    if (vaporised) std::copy_n(vapour.begin(), rest, batch.vaporised_fraction.begin() + from);
  }
  if (report.first != RangeReport::none) {
    report.bound = broken_bound(batch.density[report.first], batch.specific_internal_energy[report.first]);
  }
  return report;
}

template <Curve C>
RangeReport ConstantHeatCapacity<C>::evaluate_whole(const double* densities, const double* energies,
                                                    double* worked, const double* half_changes,
                                                    double* __restrict p, double* __restrict T,
                                                    double* __restrict c, double* __restrict melted,
                                                    double* __restrict vaporised, std::size_t n) const {
  constexpr double largest = std::numeric_limits<double>::max();
  const double greatest_density = maximum_density();
  double least_density = std::numeric_limits<double>::denorm_min();
  if constexpr (tabulated) least_density = curve_.least_usual_density();
  const double reference_rho = reference_density(), reference_e = reference_energy();
  const double heat = curve_.heat_capacity(), inverse_heat = 1 / heat;
  const Lanes least_squared =
      broadcast(std::pow(least_sound_speed_ratio * curve_.reference_sound_speed(), 2));
  std::size_t below = 0, out_of_range = 0, first = RangeReport::none;
  std::array<decltype(no_places()), block> places;
  for (std::size_t start = 0; start < n; start += block * width) {
    const std::size_t groups = std::min(block, (n - start) / width);
    if constexpr (tabulated) {
      for (std::size_t g = 0; g < groups; ++g) curve_.find(load(densities + start + g * width), places[g]);
    }
    for (std::size_t g = 0; g < groups; ++g) {
      const std::size_t i = start + g * width;
      Lanes density = load(densities + i), energy = load(energies + i);
      unsigned in_range = all_lanes;
      decltype(curve_.isochore(density)) isochore;
      // One test for the usual group, which also fails for NaN; a second one for its energies.
      if (bits((density >= least_density) & (density <= greatest_density)) == all_lanes) [[likely]] {
        if constexpr (tabulated) {
          isochore = curve_.usual_isochore(density, places[g]);
        } else {
          isochore = curve_.isochore(density);
        }
      } else {
        const LanesMask valid = (density > 0.0) & (density <= greatest_density);
        in_range = bits(valid);
        density = valid ? density : broadcast(reference_rho);
        energy = valid ? energy : broadcast(reference_e);
        isochore = curve_.isochore(density);
      }
      if constexpr (linear_in_energy) {
        if (worked != nullptr) {
          energy = solve_work(isochore, energy, load(half_changes + i),
                              isochore.cold_energy + heat * least_temperature, load(p + i));
          store(worked + i, energy);
        }
      }
      Lanes temperature = (energy - isochore.cold_energy) * inverse_heat;
      if (bits((temperature >= least_temperature) & (energy <= largest)) != all_lanes) [[unlikely]] {
        const LanesMask valid = absolute(energy) <= largest;
        in_range &= bits(valid);
        energy = valid ? energy : broadcast(reference_e);
        const Lanes coldest = isochore.cold_energy + heat * least_temperature;
        below += static_cast<std::size_t>(std::popcount(bits(energy < coldest)));
        energy = maximum(energy, coldest);
        temperature = maximum((energy - isochore.cold_energy) * inverse_heat, broadcast(least_temperature));
      }
      const Response r = isochore.response(energy);
      store(p + i, r.pressure);
      store(T + i, temperature);
      store(c + i, r.squared_sound_speed);
      Lanes fraction = {};
      if constexpr (requires { isochore.vaporised_fraction(energy); }) {
        fraction = isochore.vaporised_fraction(energy);
      }
      if (melted != nullptr) store(melted + i, fraction);
      if (vaporised != nullptr) store(vaporised + i, fraction);
      if (in_range != all_lanes) [[unlikely]] {
        for (std::size_t k = 0; k < width; ++k) {
          if ((in_range >> k & 1) != 0) continue;
          if (out_of_range++ == 0) first = i + k;
          for (double* const result : {p, T, c, melted, vaporised})
            if (result != nullptr) result[i + k] = State::unknown;
        }
      }
    }
    // The floor is the first operand: a NaN in the second operand is preserved.
    for (std::size_t g = 0; g < groups; ++g) {
      double* const at = c + start + g * width;
      store(at, sqrt(maximum(least_squared, load(at))));
    }
  }
  RangeReport report;
  report.out_of_range = out_of_range;
  report.first = first;
  report.below_cold_curve = below;
  return report;
}

}  // namespace whipple::eos
