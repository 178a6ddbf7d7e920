// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src/decks/dyna_deck.hpp"
#include "src/decks/report.hpp"

namespace whipple::decks::dyna {

/// What a field of a card is to a case.
enum class FieldUse : std::uint8_t {
  read,    ///< it becomes part of the case
  method,  ///< of the methods and the output of that code: any value
  neutral,  ///< not read: without effect if it is blank or has one of some values, else physics that is missing
};

struct FieldRule {
  std::string_view name;
  FieldUse use = FieldUse::read;
  std::string_view meaning = {};        ///< of values that are not neutral
  std::vector<double> neutral = {0.0};  ///< beside a blank
  bool until_forever =
      false;  ///< values from 1e16 on are neutral, too: a time or a limit that nothing reaches
};

struct CardRule {
  std::vector<FieldRule> fields;
  bool is_text = false;  ///< a heading
};

/// The cards of a keyword in their order.
struct KeywordRule {
  std::vector<CardRule> cards;
  bool repeats = false;  ///< the cards come again for every part, node, section ...
};

/// Returns the rule of a keyword, by its name without options that only add cards before those of the rule; null if there
/// is none.
const KeywordRule* rule_of(std::string_view keyword);

/// Returns the name of a material or equation of state that the deck calls by its number: MAT_JOHNSON_COOK for MAT_015.
std::string_view by_name(std::string_view keyword);

/// Names all fields of a block that are set to something that its rule does not read: "missing" where that is physics,
/// "dropped" where it is a method. Cards and fields that the rule does not know must be blank or zero.
/// @param subject  before every remark, as the name of a part; may be empty
/// @param first    card of the block that is the first of the rule
void check_fields(const Deck& deck, const Block& block, const KeywordRule& rule, Import& import,
                  std::string_view subject = {}, std::size_t first = 0);

}  // namespace whipple::decks::dyna
