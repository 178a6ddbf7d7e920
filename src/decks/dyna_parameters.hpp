// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "src/decks/dyna_deck.hpp"

namespace whipple::decks::dyna {

/// Returns the value of a parameter in a file of a deck: that of the file if it has one, otherwise that of the deck.
std::optional<double> parameter(const Deck& deck, const std::string& file, std::string_view name);

/// Reads the parameters of a block *PARAMETER, _LOCAL or _EXPRESSION; texts (type C) are skipped. An already defined
/// parameter keeps its value, as in LS-DYNA, with a note.
/// @returns false if the keyword is none of these
/// @throws InputError for values that are not a number, expression or integer as required
bool read_parameters(Deck& deck, const Block& block);

/// Returns the value of an expression: numbers, names (with or without &), + - * / ** ^, parentheses and the usual
/// functions.
/// @param value_of  returns the value of a name
/// @throws InputError that describes the error
double evaluate(std::string_view expression,
                const std::function<std::optional<double>(std::string_view name)>& value_of);

}  // namespace whipple::decks::dyna
