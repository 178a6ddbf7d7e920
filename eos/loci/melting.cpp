// SPDX-License-Identifier: BSD-3-Clause
#include "eos/loci/melting.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "eos/inversions.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {

std::optional<MeltingPoint> melting_point(const EquationOfState& eos, double pressure,
                                          double highest_temperature) {
  double density = eos.reference_density();
  const auto at = [&](double T) { return state_at_pressure_and_temperature(eos, pressure, T, density); };
  // Find the first temperature of an increasing sequence with the fraction beyond the edge, and the last one before
  // it. The sequence increases, since a hot metal may have no condensed state at the pressure: it melts before.
  State solid = at(std::max(eos.least_temperature(), 1e-3));
  if (solid.melted_fraction > 0) return std::nullopt;
  State melting, liquid;  // first with any melt, first without solid
  State last_solid = solid, last_mixed = solid;
  for (double T = std::max(solid.temperature, 0.05 * eos.reference_temperature());; T *= 1.05) {
    if (T > highest_temperature) return std::nullopt;
    State s;
    try {
      s = at(T);
    } catch (const StateError& error) {
      // The condensed branch ends as a solid, or evaporates without a liquid.
      if (melting.phase.empty() || melting.melted_fraction <= melting.vaporised_fraction) return std::nullopt;
      throw StateError(fmt::format(
          "melting at {:.4g} Pa begins at {:.5g} K, but at {:.5g} K, melted to {:.3g}, the condensed "
          "branch has no state left: {}",
          pressure, last_solid.temperature, last_mixed.temperature, last_mixed.melted_fraction,
          error.what()));
    }
    density = s.density;
    if (s.melted_fraction <= 0) last_solid = s;
    if (s.melted_fraction > 0 && melting.phase.empty()) melting = s;
    if (s.melted_fraction >= 1) {
      liquid = s;
      break;
    }
    last_mixed = s;
  }
  if (melting.melted_fraction <= melting.vaporised_fraction) return std::nullopt;  // it evaporates
  const auto edge = [&](State below, State above, auto beyond) {
    for (int i = 0; i < 60 && above.temperature - below.temperature > 1e-9 * above.temperature; ++i) {
      density = below.density;
      const State middle = at(0.5 * (below.temperature + above.temperature));
      (beyond(middle.melted_fraction) ? above : below) = middle;
    }
    return std::pair(below, above);
  };
  return MeltingPoint{edge(last_solid, melting, [](double f) { return f > 0; }).first,
                      edge(last_mixed, liquid, [](double f) { return f >= 1; }).second};
}

}  // namespace whipple::eos
