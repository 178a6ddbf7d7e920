// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "eos/equation_of_state.hpp"
#include "src/core/base/words.hpp"
#include "src/decks/unit_system.hpp"

namespace whipple::decks {

/// Programs whose inputs have a card for an equation of state.
enum class CardFormat {
  ls_dyna,     ///< *EOS_GRUNEISEN, *EOS_JWL
  openradioss  ///< /EOS/GRUNEISEN
};
constexpr std::array<Word<CardFormat>, 2> words(CardFormat) {
  return {{{CardFormat::ls_dyna, "ls-dyna"}, {CardFormat::openradioss, "openradioss"}}};
}

/// Writes the equation of state of a material as a card of another program, whose comments name material, units,
/// reference density, and in what the other program's law differs from the material's.
/// @param number  of the equation of state or material there
/// @throws InputError if the program has no such law: it names those that have a card
std::string eos_card(const std::string& material, const eos::EquationOfState& eos, CardFormat format,
                     const UnitSystem& units, int number);

}  // namespace whipple::decks
