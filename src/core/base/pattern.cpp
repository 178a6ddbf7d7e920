// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/pattern.hpp"

#include <regex>
#include <utility>

namespace whipple {
namespace {

std::vector<std::string> groups(const std::smatch& found) {
  std::vector<std::string> all;
  for (const std::ssub_match& group : found) all.push_back(group.str());
  return all;
}

}  // namespace

struct Pattern::Compiled {
  explicit Compiled(std::regex expression) : regex(std::move(expression)) {}
  std::regex regex;
};

Pattern::Pattern(const std::string& expression, Case letters)
    : compiled_(std::make_shared<const Compiled>(
          std::regex(expression, letters == Case::ignored ? std::regex::ECMAScript | std::regex::icase
                                                          : std::regex::ECMAScript))) {}

bool Pattern::matches(const std::string& text) const { return std::regex_match(text, compiled_->regex); }

std::optional<std::vector<std::string>> Pattern::match(const std::string& text) const {
  std::smatch found;
  if (!std::regex_match(text, found, compiled_->regex)) return std::nullopt;
  return groups(found);
}

bool Pattern::is_in(const std::string& text) const { return std::regex_search(text, compiled_->regex); }

std::optional<std::vector<std::string>> Pattern::find(const std::string& text) const {
  std::smatch found;
  if (!std::regex_search(text, found, compiled_->regex)) return std::nullopt;
  return groups(found);
}

std::string Pattern::replace(const std::string& text, const std::string& by) const {
  return std::regex_replace(text, compiled_->regex, by);
}

}  // namespace whipple
