// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "src/decks/dyna_deck.hpp"

namespace whipple::decks::dyna {

/// Returns the value of a parameter in a file of a deck: that of the file itself, or that of the deck.
std::optional<double> parameter(const Deck& deck, const std::string& file, std::string_view name);

/// Takes the parameters of a block *PARAMETER, _LOCAL or _EXPRESSION; texts (type C) are left out. A parameter that is
/// there already keeps its value, as in LS-DYNA, with a note.
/// @returns false if the keyword is none of these
/// @throws InputError for what is no number, no expression or no integer
bool read_parameters(Deck& deck, const Block& block);

/// Returns the value of an expression: numbers, names (with or without &), + - * / ** ^, parentheses and the usual
/// functions.
/// @param value_of  of a name
/// @throws InputError that says what is wrong
double evaluate(std::string_view expression,
                const std::function<std::optional<double>(std::string_view name)>& value_of);

}  // namespace whipple::decks::dyna
