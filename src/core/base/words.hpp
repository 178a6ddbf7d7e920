// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whipple {

/// Holds one value of an enumeration with its word in input files. The words of an enumeration are declared once, next
/// to it, by a constexpr function `words(Enum)`, found by argument-dependent lookup, that returns an array of these in
/// the order used by `whipple describe`. A value without a word cannot be selected in an input.
template <class Enum>
struct Word {
  Enum value;
  std::string_view text;
};

/// Returns the word of a value; empty if it has none.
template <class Enum>
constexpr std::string_view word_of(Enum value) {
  for (const Word<Enum>& word : words(value)) {
    if (word.value == value) return word.text;
  }
  return {};
}

/// Returns the value of a word; nothing if the enumeration does not have it.
template <class Enum>
constexpr std::optional<Enum> value_of(std::string_view text) {
  for (const Word<Enum>& word : words(Enum{})) {
    if (word.text == text) return word.value;
  }
  return std::nullopt;
}

/// Lists the words of an enumeration in the order in which they are declared.
template <class Enum>
std::vector<std::string> word_list() {
  std::vector<std::string> list;
  for (const Word<Enum>& word : words(Enum{})) list.emplace_back(word.text);
  return list;
}

}  // namespace whipple
