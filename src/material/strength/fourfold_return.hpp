// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
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

/// The increments of the points that may yield, by fours; 0 for the others.
/// @param may_yield  may_yield(group of four) -> LanesMask; false: the increment is 0
template <FourfoldLaw Law, class MayYield>
void return_by_fours(const Law& law, const State& state, std::span<const double> trial,
                     std::span<const double> modulus, std::span<const double> solid_fraction, double dt,
                     std::span<double> increment, MayYield&& may_yield) {
  using Return = typename Law::Return;
  using Indices = std::array<std::size_t, 4>;
  constexpr std::size_t groups = 8;  // that are solved together
  std::array<Return, groups> returns;
  std::array<Indices, groups> at;
  std::size_t used = 0;
  const auto solve = [&] {
    law.solve(std::span(returns.data(), used), dt);
    for (std::size_t g = 0; g < used; ++g) {
      for (std::size_t k = 0; k < 4; ++k) increment[at[g][k]] = returns[g].increment[k];
    }
    used = 0;
  };
  const auto accept = [&](const Indices& points) {
    at[used++] = points;
    if (used == groups) solve();
  };
  // Where not all four may yield, those that may wait until there are four of them.
  constexpr auto inputs = std::array{&Return::trial, &Return::plastic_strain, &Return::temperature,
                                     &Return::modulus, &Return::solid};
  Return rest;
  Indices waiting;
  std::size_t wait = 0;
  const auto accept_waiting = [&] {
    for (const auto input : inputs) returns[used].*input = rest.*input;
    accept(waiting);
    wait = 0;
  };
  for (std::size_t i = 0; i < trial.size(); i += 4) {
    const std::size_t count = std::min<std::size_t>(4, trial.size() - i);
    Return& group = returns[used];
    group.trial = load(&trial[i], count, 0.0);
    group.plastic_strain = load(&state.plastic_strain[i], count, 0.0);
    group.temperature = load(&state.temperature[i], count, 0.0);
    group.modulus = load(&modulus[i], count, 1.0);
    group.solid = load(&solid_fraction[i], count, 1.0);
    const unsigned yielding = bits(may_yield(group)) & ((1U << count) - 1);
    if (yielding == all_lanes) {
      accept({i, i + 1, i + 2, i + 3});
      continue;
    }
    store(&increment[i], Lanes{}, count);
    const Return some = group;
    for (std::size_t k = 0; k < count; ++k) {
      if ((yielding >> k & 1U) == 0) continue;
      for (const auto input : inputs) (rest.*input)[wait] = (some.*input)[k];
      waiting[wait] = i + k;
      if (++wait == 4) accept_waiting();
    }
  }
  if (wait > 0) {
    for (std::size_t k = wait; k < 4; ++k) {  // what is missing repeats the first
      for (const auto input : inputs) (rest.*input)[k] = (rest.*input)[0];
      waiting[k] = waiting[0];
    }
    accept_waiting();
  }
  if (used > 0) solve();
}

}  // namespace whipple::strength
