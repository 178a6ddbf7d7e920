// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "src/decks/dyna_deck.hpp"
#include "src/decks/import.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::dyna {

/// Holds D1 to D5 of the Johnson-Cook failure strain.
using DamageConstants = std::array<double, 5>;

/// Returns D3 for a triaxiality that is positive in tension, with a remark. Decks use both signs: unless the user
/// specifies one, the sign is chosen so that failure occurs earlier in tension than in compression.
double d3_of_tension(const DamageConstants& d, Triaxiality triaxiality, const std::string& part,
                     const Block& material, Import& import);

/// Warns of constants for which a material fails at first yield, which is usually a mistake.
/// @param least  minimum failure strain
void remark_on_failure_strain(const DamageConstants& d, double least, const std::string& part,
                              const Block& material, Import& import);

}  // namespace whipple::decks::dyna
