// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/combination.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace whipple::cases {

double counted_volume(const Shape& shape) {
  constexpr int points = 96;
  const Shape::Bounds box = shape.bounds();
  const Vector3 step = (box.upper - box.lower) / points;
  if (!step.allFinite()) return std::numeric_limits<double>::infinity();
  long inside = 0;
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      for (int k = 0; k < points; ++k) {
        inside += shape.contains(box.lower + step.cwiseProduct(Vector3(i + 0.5, j + 0.5, k + 0.5))) ? 1 : 0;
      }
    }
  }
  return static_cast<double>(inside) * step.prod();
}

std::string list_as_toml(const Parts& parts) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : ", ") + part->toml();
  return "[" + text + "]";
}

void visit_all(const Parts& parts, const std::function<void(const Shape&)>& f) {
  for (const auto& part : parts) part->visit(f);
}

void schema_of_list(input::Schema& value) {
  value["type"] = "array";
  value["items"] = input::reference_to("shape");
  value["minItems"] = 1;
}

void add_member(input::Schema& table, const char* key, bool is_list) {
  input::Schema value = input::reference_to("shape");
  if (is_list) {
    value.clear();
    schema_of_list(value);
  }
  input::add_key(table, key, value, true);
}

Parts read_parts(input::Table& holder, const std::string& key) {
  Parts parts;
  std::vector<input::Table> tables = holder.list(key);
  bool good = !tables.empty();
  if (!good)
    holder.error_at(key, fmt::format("'{}' must be a list of shapes, [{{ sphere = ... }}, ...]", key));
  for (input::Table& table : tables) {
    std::unique_ptr<Shape> part = read_only_shape(table);
    good = good && part != nullptr;
    parts.push_back(std::move(part));
  }
  if (!good) parts.clear();
  return parts;
}

std::unique_ptr<Shape> read_member(input::Table& table, const char* key) {
  auto holder = table.required_table(key);
  return holder ? read_only_shape(*holder) : nullptr;
}

}  // namespace whipple::cases
