// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "src/decks/dyna_deck.hpp"
#include "src/decks/import.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::dyna {

/// D1 to D5 of the failure strain of Johnson and Cook.
using DamageConstants = std::array<double, 5>;

/// Returns D3 for a triaxiality that counts tension positive, with a remark. Both signs are in use in decks: if the user
/// does not say which is meant, it is that with which tension breaks earlier than compression.
double d3_of_tension(const DamageConstants& d, Triaxiality triaxiality, const std::string& part,
                     const Block& material, Import& import);

/// Warns of constants that break a material as soon as it yields, mostly a mistake.
/// @param least  failure strain
void remark_on_failure_strain(const DamageConstants& d, double least, const std::string& part,
                              const Block& material, Import& import);

}  // namespace whipple::decks::dyna
