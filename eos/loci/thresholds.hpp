// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/loci/hugoniot.hpp"

namespace whipple::eos {

/// Holds onset and completion of melting on the principal Hugoniot.
struct ShockMelting {
  ShockState onset;
  ShockState completion;
};
/// Finds onset and completion of shock melting; nothing if the model is not solid at rest, never melts below the
/// pressure or within its range, or has a gap before that.
std::optional<ShockMelting> shock_melting(const EquationOfState& eos, double highest_pressure = 2e12);

/// Holds the weakest shocks after which release to a pressure melts or vaporises (liquid-vapour equilibrium,
/// `release`). Nothing if the range of the model is too small, or if the phase exists already at rest.
struct ReleaseThresholds {
  std::optional<ShockState> incipient_melting;
  std::optional<ShockState> complete_melting;
  std::optional<ShockState> incipient_vaporisation;
  std::optional<ShockState> complete_vaporisation;
};
ReleaseThresholds release_thresholds(const EquationOfState& eos, double pressure,
                                     double highest_pressure = 2e12);

}  // namespace whipple::eos
