// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "src/decks/dyna_model.hpp"
#include "src/decks/report.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {

/// A part that burns.
struct Explosive {
  Id part = 0;
  std::string name;
  double velocity = 0.0;  ///< of detonation, in the units of the deck
  double burn = 0.0;      ///< BETA
  std::vector<Vector3> nodes;
};

/// Returns whether a point of detonation lights one of the explosives.
bool is_lit(const Model& model, std::span<const Explosive> explosives);

/// Returns the points of detonation of a deck and the rules of burning as tables of a case, with a remark on each point.
/// Beside shadows points of a part light all explosives in a case: where one would be lit too early by that, it is missing.
std::string lighting(const Model& model, std::span<const Explosive> explosives, const UnitSystem& units,
                     Import& import);

}  // namespace whipple::decks::dyna
