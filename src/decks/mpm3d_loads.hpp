// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/decks/mpm3d_bodies.hpp"
#include "src/decks/mpm3d_deck.hpp"
#include "src/decks/report.hpp"
#include "src/decks/toml_text.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks::mpm3d {

/// Writes gravity, forces and damping of a deck as tables of the case, with remarks on every `load`, `qulo` and `damp`.
/// @param faults  receives a fault for each load that no case can have
void write_loads(const Deck& deck, std::span<const CaseBody> bodies, const UnitSystem& units, TomlText& toml,
                 Import& import, std::vector<InputFault>& faults);

}  // namespace whipple::decks::mpm3d
