// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// Holds the melting range at one pressure: the temperatures between which the melted fraction of the condensed
/// state increases from 0 to 1. They are equal if the model melts at a single temperature.
struct MeltingPoint {
  State solidus;   ///< the last solid
  State liquidus;  ///< the first liquid
};

/// Computes solidus and liquidus at a pressure by bisection of the temperature on the condensed branch
/// (eos/inversions.hpp) to 1e-9 relative.
/// @param highest_temperature  end of the search, K
/// @returns nothing if the model's state is not solid at its least temperature, or does not melt below the
/// highest one or before the condensed branch ends
/// @throws StateError if there is no condensed state at the pressure
std::optional<MeltingPoint> melting_point(const EquationOfState& eos, double pressure,
                                          double highest_temperature = 1e5);

}  // namespace whipple::eos
