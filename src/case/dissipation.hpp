// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "src/case/section.hpp"
#include "src/case/time_control.hpp"

namespace whipple::cases {

/// Selects the energy that receives the kinetic energy lost in transfers.
enum class Losses : std::uint8_t {
  unresolved,  ///< motion not resolved by the grid
  heat,
  by_scheme,  ///< not given: `default_losses`
};
constexpr std::array<Word<Losses>, 2> words(Losses) {
  return {{{Losses::unresolved, "unresolved"}, {Losses::heat, "heat"}}};
}
/// Returns the default treatment of losses for a scheme.
constexpr Losses default_losses(Scheme scheme) {
  return scheme == Scheme::symplectic ? Losses::unresolved : Losses::heat;
}

/// Holds the parameters that distribute the kinetic energy removed from the grid motion in a step
/// (docs/theory/dissipation.md): one set of values for all cases.
struct Dissipation {
  Losses losses = Losses::by_scheme;
  double heat_share = 0.1;           ///< f of eq. 3
  double allowance_time = 5.0;       ///< tau of eq. 3, in acoustic transit times of a cell
  double collision_rate = 1.0;       ///< r of eq. 4
  double affine_gain = 1.5;          ///< a of eq. 6
  double affine_compression = 0.25;  ///< g of eq. 6
  double shock_conduction = 1.0;     ///< 1/Pr of eq. 8
  double conduction_onset = 0.03;    ///< a0 of eq. 8
  double conduction_rise = 0.05;     ///< a1 of eq. 8
  [[nodiscard]] bool keeps_losses() const { return losses == Losses::unresolved; }

  static ParameterTable<Dissipation> parameters();
  void check(const Case& setup, const Faults& faults) const;
};

}  // namespace whipple::cases
