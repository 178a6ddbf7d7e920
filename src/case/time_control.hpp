// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/section.hpp"
#include "src/material/kinematics.hpp"

namespace whipple::cases {

/// Selects the time integration (docs/theory/mpm.md, section 5).
enum class Scheme : std::uint8_t {
  symplectic,    ///< exact energy balance
  musl,          ///< modified update stress last
  usl,           ///< update stress last
  usf,           ///< update stress first
  quasi_static,  ///< implicit load steps without inertia
};
constexpr std::array<Word<Scheme>, 5> words(Scheme) {
  return {{{Scheme::symplectic, "symplectic"},
           {Scheme::musl, "musl"},
           {Scheme::usl, "usl"},
           {Scheme::usf, "usf"},
           {Scheme::quasi_static, "quasi_static"}}};
}
/// Returns whether a scheme integrates the motion over time; otherwise its states are at rest.
constexpr bool has_inertia(Scheme scheme) { return scheme != Scheme::quasi_static; }
/// Returns the number of transfers from particles to nodes per step.
constexpr int transfers_per_step(Scheme scheme) {
  return scheme == Scheme::musl || scheme == Scheme::usf ? 2 : 1;
}

struct TimeControl {
  double end = 0.0;  ///< s
  double courant = 0.5;
  double first_step = 0.05;
  double maximum_growth = 1.05;
  double acceleration_limit = 0.1;
  double compression_limit = 0.04;
  double element_safety = 0.9;
  Scheme scheme = Scheme::symplectic;
  material::StressRotation stress_rotation = material::StressRotation::hughes_winget;

  static constexpr bool required = true;
  static ParameterTable<TimeControl> parameters();
};

}  // namespace whipple::cases
