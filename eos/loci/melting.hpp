// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// Melting at one pressure: the temperatures between which the melted fraction of the condensed state goes
/// from 0 to 1. Equal if the model melts at a point.
struct MeltingPoint {
  State solidus;   ///< the last solid
  State liquidus;  ///< the first liquid
};

/// Solidus and liquidus at a pressure, by bisection of the temperature on the condensed branch
/// (eos/inversions.hpp) to 1e-9 relative.
/// @param highest_temperature  where the search ends, K
/// @returns nothing if the model's state is not solid at its least temperature, or does not melt below the
/// highest one or before the condensed branch ends
/// @throws StateError if there is no condensed state at the pressure
std::optional<MeltingPoint> melting_point(const EquationOfState& eos, double pressure,
                                          double highest_temperature = 1e5);

}  // namespace whipple::eos
