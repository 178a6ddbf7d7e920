// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/input/overlay.hpp"

#include <optional>
#include <utility>

#include "src/core/base/error.hpp"

namespace whipple::input {
namespace {

std::optional<std::pair<std::filesystem::path, std::string>> overlaid;

}  // namespace

Overlay::Overlay(std::filesystem::path file, std::string text) {
  if (overlaid) throw InternalError("a second overlay");
  overlaid.emplace(std::move(file), std::move(text));
}

Overlay::~Overlay() { overlaid.reset(); }

const std::string* Overlay::text_of(const std::filesystem::path& file) {
  return overlaid && overlaid->first == file ? &overlaid->second : nullptr;
}

}  // namespace whipple::input
