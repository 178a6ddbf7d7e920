// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "src/base/vector_math.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// A law with costly functions that solves groups of four points: it has a struct `Return` with trial,
/// plastic_strain, temperature, modulus, solid (in) and increment (out), and solve(groups, dt).
template <class Law>
concept FourfoldLaw =
    requires(const Law& law, typename Law::Return group, double dt) { law.solve(std::span(&group, 1), dt); };

/// The increments of the points that may yield, gathered by fours; 0 for the others.
/// @param may_yield  may_yield(i); false: the increment is 0
template <FourfoldLaw Law, class MayYield>
void return_by_fours(const Law& law, const State& state, std::span<const double> trial,
                     std::span<const double> modulus, std::span<const double> solid_fraction, double dt,
                     std::span<double> increment, MayYield&& may_yield) {
  constexpr std::size_t groups = 8;  // that are solved together
  std::array<std::size_t, 4 * groups> yielding;
  std::size_t count = 0;
  const auto solve = [&] {
    std::array<typename Law::Return, groups> returns;
    const std::size_t used = (count + 3) / 4;
    for (std::size_t g = 0; g < used; ++g) {
      for (std::size_t k = 0; k < 4; ++k) {
        // What is missing in the last group repeats its first point.
        const std::size_t i = yielding[4 * g + k < count ? 4 * g + k : 4 * g];
        returns[g].trial[k] = trial[i];
        returns[g].plastic_strain[k] = state.plastic_strain[i];
        returns[g].temperature[k] = state.temperature[i];
        returns[g].modulus[k] = modulus[i];
        returns[g].solid[k] = solid_fraction[i];
      }
    }
    law.solve(std::span(returns.data(), used), dt);
    for (std::size_t n = 0; n < count; ++n) increment[yielding[n]] = returns[n / 4].increment[n % 4];
    count = 0;
  };
  for (std::size_t i = 0; i < trial.size(); ++i) {
    increment[i] = 0.0;
    yielding[count] = i;
    count += may_yield(i) ? 1 : 0;
    if (count == yielding.size()) solve();
  }
  if (count > 0) solve();
}

}  // namespace whipple::strength
