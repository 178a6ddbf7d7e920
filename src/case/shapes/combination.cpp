// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/combination.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "src/case/shapes/spread_points.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::cases {

double counted_volume(const Shape& shape) {
  const Shape::Bounds box = shape.bounds();
  const Vector3 edges = box.upper - box.lower;
  if (!edges.allFinite()) return std::numeric_limits<double>::infinity();
  // Points of a lattice would agree with the cells of periodic shapes.
  constexpr std::size_t points = 1000000, first = 1000000;  // far from the points that calibrate fillings
  constexpr std::size_t portion = 10000;
  std::vector<std::size_t> inside(points / portion, 0);
  parallel::for_each_uneven(inside.size(), [&](std::size_t p) {
    for (std::size_t i = 0; i < portion; ++i) {
      const Vector3 part = spread_point(first + p * portion + i);
      inside[p] += shape.contains(box.lower + part.cwiseProduct(edges)) ? 1 : 0;
    }
  });
  const std::size_t count = std::accumulate(inside.begin(), inside.end(), std::size_t{0});
  return static_cast<double>(count) / static_cast<double>(points) * edges.prod();
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
