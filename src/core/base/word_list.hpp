// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/words.hpp"

/// Words of enumerations outside of parameter tables: attributes of files, options of a command line.
namespace whipple {

/// Returns the value of a word; none if the enumeration does not have it.
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
