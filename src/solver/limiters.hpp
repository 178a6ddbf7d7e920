// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "src/solver/ledger.hpp"

namespace whipple::solver {

/// A bound that material or the time step may run into: its column in history.csv and how it is told.
struct Limiter {
  const char* name;
  double Ledger::* count;
  const char* meaning;
};
/// All of them (docs/manual/output.md).
inline constexpr auto limiters = std::to_array<Limiter>({
    {"below_cold_curve", &Ledger::clamped_to_cold_curve, "temperature held at the cold curve, energy kept"},
    {"at_pressure_floor", &Ledger::held_at_pressure_floor, "pressure held at its floor"},
    {"limited_volume_changes", &Ledger::limited_volume_changes, "volume change of a step limited"},
    {"limited_densities", &Ledger::limited_densities, "density limited to its minimum"},
    {"limited_compressions", &Ledger::limited_compressions,
     "density limited to the end of the equation of state"},
    {"limited_void_steps", &Ledger::limited_void_steps, "change of material with a void limited"},
    {"limited_bulking", &Ledger::limited_bulking, "bulking of crushed brittle material limited"},
    {"limited_domains", &Ledger::limited_domains, "domain of a particle limited"},
    {"limited_hourglass", &Ledger::limited_hourglass,
     "hourglass forces of an element limited to its stored energy"},
    {"elements_beyond_range", &Ledger::elements_beyond_range, "element left its valid range"},
    {"held_pressures", &Ledger::held_pressures,
     "pressure held back in a fluid particle that has parted from its neighbours"},
    {"refused_divisions", &Ledger::refused_divisions,
     "division of a particle refused at splitting.maximum_particles"},
    {"held_time_steps", &Ledger::held_time_steps,
     "time step kept longer than the volumetric strain-rate limit"},
});

}  // namespace whipple::solver
