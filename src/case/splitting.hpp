// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/section.hpp"

namespace whipple::cases {

/// Selects the material whose particles are split.
enum class Divided : std::uint8_t { fluid, all };
constexpr std::array<Word<Divided>, 2> words(Divided) {
  return {{{Divided::fluid, "fluid"}, {Divided::all, "all"}}};
}

/// Controls particle splitting; length 0 disables it.
struct Splitting {
  Divided of = Divided::fluid;
  double length = 1.2;  ///< of a particle along its longest direction, in cells
  std::int64_t maximum_generations = 6;
  std::int64_t maximum_particles = 100'000'000;  ///< total on all ranks

  static ParameterTable<Splitting> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases
