// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string>

#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

/// Returns `{ NAME = { ... } }` with all keys of a shape described by a single parameter table that are
/// given or have a default.
template <class Primitive>
std::string shape_as_toml(Primitive shape) {
  std::string keys;
  for (const BoundParameter& parameter : whipple::bind(Primitive::parameters(), shape)) {
    if (is_unset(parameter)) continue;
    keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", parameter.info.name, value_as_toml(parameter));
  }
  return fmt::format("{{ {} = {{ {} }} }}", Primitive::name, keys);
}

}  // namespace whipple::cases
