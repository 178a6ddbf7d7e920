// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src/decks/dyna_deck.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::dyna {

/// Describes how a case uses a field of a card.
enum class FieldUse : std::uint8_t {
  read,     ///< becomes part of the case
  method,   ///< belongs to the methods or the output of that code: any value is accepted
  neutral,  ///< not read: without effect if blank or equal to a neutral value, otherwise missing physics
};

struct FieldRule {
  std::string_view name;
  FieldUse use = FieldUse::read;
  std::string_view meaning = {};        ///< of values that are not neutral
  std::vector<double> neutral = {0.0};  ///< in addition to blank
  bool until_forever =
      false;  ///< values from 1e16 on are also neutral: a time or limit that is never reached
};

struct CardRule {
  std::vector<FieldRule> fields;
  bool is_text = false;  ///< a heading
};

/// Holds the rules for the cards of a keyword, in their order.
struct KeywordRule {
  std::vector<CardRule> cards;
  bool repeats = false;  ///< the cards are repeated for every part, node, section ...
};

/// Returns the rule of a keyword, by its name without options that only add cards before those of the rule; null if
/// there is none.
const KeywordRule* rule_of(std::string_view keyword);

/// Returns the name of a material or equation of state given by number: MAT_JOHNSON_COOK for MAT_015.
std::string_view by_name(std::string_view keyword);

/// Reports all fields of a block with values that its rule does not read: as "missing" if they are physics, as
/// "dropped" if they belong to a method. Cards and fields beyond those of the rule must be blank or zero.
/// @param subject  prefix of every remark, such as the name of a part; may be empty
/// @param first    index of the card to which the first card of the rule applies
void check_fields(const Deck& deck, const Block& block, const KeywordRule& rule, Import& import,
                  std::string_view subject = {}, std::size_t first = 0);

}  // namespace whipple::decks::dyna
