// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/case/shapes/shape.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/input/document.hpp"

namespace whipple::cases {

using Parts = std::vector<std::unique_ptr<Shape>>;

/// Returns the volume of a shape (m^3) by counting a million quasi-random points of its bounds.
double counted_volume(const Shape& shape);

/// Returns "[{ ... }, { ... }]" as written in a case file.
std::string list_as_toml(const Parts& parts);

/// Calls f for the shapes of a list, and for all that they are made of.
void visit_all(const Parts& parts, const std::function<void(const Shape&)>& f);

/// Fills in the schema of a list of shapes.
void schema_of_list(input::Schema& value);

/// Adds a key whose value is a shape, or a list of shapes.
void add_member(input::Schema& table, const char* key, bool is_list);

/// Reads the shapes of a list; returns an empty list if one of them is invalid, or there are none.
Parts read_parts(input::Table& holder, const std::string& key);

/// Reads the shape of a required key. Reports errors in the document and then returns null.
std::unique_ptr<Shape> read_member(input::Table& table, const char* key);

/// Returns `{ NAME = { KEYS, shape = ... } }` of a shape made of one other and the keys of a parameter table.
template <class Keys>
std::string holder_as_toml(const char* name, Keys keys, const Shape& shape) {
  std::string text;
  for (const BoundParameter& parameter : whipple::bind(Keys::parameters(), keys)) {
    text += fmt::format("{} = {}, ", parameter.info.name, value_as_toml(parameter));
  }
  return fmt::format("{{ {} = {{ {}shape = {} }} }}", name, text, shape.toml());
}

/// Reads a combination given by a list. Reports errors in the document and then returns null.
template <class Combination>
std::unique_ptr<Shape> read_list(input::Table& holder, const std::string& key) {
  Parts parts = read_parts(holder, key);
  if (parts.empty()) return nullptr;
  return std::make_unique<Combination>(std::move(parts));
}

}  // namespace whipple::cases
