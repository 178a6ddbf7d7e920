// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/shape.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace whipple::cases {

std::span<const ShapeEntry> shape_catalogue() {
  static const std::vector<ShapeEntry> all = [] {
    std::vector<ShapeEntry> entries(primitives().begin(), primitives().end());
    entries.insert(entries.end(), combinations().begin(), combinations().end());
    return entries;
  }();
  return all;
}

std::unique_ptr<Shape> read_only_shape(input::Table& holder) {
  std::unique_ptr<Shape> shape;
  std::string names;
  int found = 0;
  for (const ShapeEntry& entry : shape_catalogue()) {
    names += (names.empty() ? "" : ", ") + entry.name;
    if (!holder.has(entry.name)) continue;
    shape = entry.read(holder, entry.name);
    ++found;
  }
  if (found == 1) return shape;
  holder.error(fmt::format("'{}' must hold exactly one of: {}", holder.name(), names));
  return nullptr;
}

std::unique_ptr<Shape> read_shape(input::Table& body) {
  auto holder = body.required_table("shape");
  if (!holder) return nullptr;
  std::unique_ptr<Shape> shape = read_only_shape(*holder);
  if (!shape) return nullptr;  // its errors are reported
  const Shape::Bounds bounds = shape->bounds();
  const auto refuse = [&](const char* why) {
    body.error_at("shape", fmt::format("'{}.shape' {}", body.name(), why));
    return nullptr;
  };
  if (!(bounds.lower.array() < bounds.upper.array()).all()) {
    return refuse("is empty: the lower corner is not below the upper one");
  }
  if (!(bounds.upper - bounds.lower).allFinite()) {
    return refuse("has no end: intersect it with a bounded shape");
  }
  return shape;
}

}  // namespace whipple::cases
