// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "src/decks/dyna_model.hpp"
#include "src/decks/report.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {

/// Describes a part that is an explosive.
struct Explosive {
  Id part = 0;
  std::string name;
  double velocity = 0.0;  ///< detonation velocity, in the units of the deck
  double burn = 0.0;      ///< BETA
  std::vector<Vector3> nodes;
};

/// Returns whether a detonation point lights one of the explosives.
bool is_lit(const Model& model, std::span<const Explosive> explosives);

/// Returns the detonation points of a deck and the burn rules as tables of a case, with a remark on each point. With
/// shadows, the points of one part light all explosives of a case: where that would light an explosive too early, the
/// point is reported as missing.
std::string lighting(const Model& model, std::span<const Explosive> explosives, const UnitSystem& units,
                     Import& import);

}  // namespace whipple::decks::dyna
