// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/loci/hugoniot.hpp"

namespace whipple::eos {

/// Onset and completion of melting on the principal Hugoniot.
struct ShockMelting {
  ShockState onset;
  ShockState completion;
};
/// Nothing if the model is not solid at rest, never melts below the pressure or within its range, or has a gap on the
/// way.
std::optional<ShockMelting> shock_melting(const EquationOfState& eos, double highest_pressure = 2e12);

/// The weakest shocks after which release to a pressure melts or vaporises (equilibrium of liquid and vapour,
/// `release`). Nothing where the model does not go so far, or is there at rest already.
struct ReleaseThresholds {
  std::optional<ShockState> incipient_melting;
  std::optional<ShockState> complete_melting;
  std::optional<ShockState> incipient_vaporisation;
  std::optional<ShockState> complete_vaporisation;
};
ReleaseThresholds release_thresholds(const EquationOfState& eos, double pressure,
                                     double highest_pressure = 2e12);

}  // namespace whipple::eos
