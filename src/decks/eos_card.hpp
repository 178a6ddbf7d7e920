// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "eos/equation_of_state.hpp"
#include "src/core/base/words.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks {

/// Lists programs with input cards for an equation of state.
enum class CardFormat {
  ls_dyna,     ///< *EOS_GRUNEISEN, *EOS_JWL
  openradioss  ///< /EOS/GRUNEISEN
};
constexpr std::array<Word<CardFormat>, 2> words(CardFormat) {
  return {{{CardFormat::ls_dyna, "ls-dyna"}, {CardFormat::openradioss, "openradioss"}}};
}

/// Writes the equation of state of a material as a card of another program. Comments name material, units, reference
/// density, and the differences between the other program's law and that of the material.
/// @param number  of the equation of state or material in that program
/// @throws InputError if the program has no such law: it names those that have a card
std::string eos_card(const std::string& material, const eos::EquationOfState& eos, CardFormat format,
                     const UnitSystem& units, int number);

}  // namespace whipple::decks
