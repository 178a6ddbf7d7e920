// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"

namespace whipple::input {

/// Collects faults of the values of an input, below the key of one of its sections. Cheap to copy; valid while the list
/// exists.
class Faults {
 public:
  explicit Faults(std::vector<InputFault>& list) : list_(&list) {}

  /// Returns the collector for a sub-section, or for an entry of a list.
  [[nodiscard]] Faults in(std::string_view section) const { return {*list_, key_of(section)}; }
  [[nodiscard]] Faults in(std::size_t entry) const { return in(std::to_string(entry)); }

  /// Adds a fault of a key of the section, or of the whole section if the key is empty.
  void add(std::string_view key, std::string text) const {
    list_->push_back({.key = key_of(key), .text = std::move(text)});
  }

 private:
  Faults(std::vector<InputFault>& list, std::string section) : list_(&list), section_(std::move(section)) {}
  [[nodiscard]] std::string key_of(std::string_view name) const {
    return section_.empty() || name.empty() ? section_ + std::string(name)
                                            : fmt::format("{}.{}", section_, name);
  }

  std::vector<InputFault>* list_;
  std::string section_;
};

}  // namespace whipple::input
