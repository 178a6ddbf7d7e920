// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/shape.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "src/case/shapes.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

namespace {

template <class Kind>
ShapeEntry entry() {
  if constexpr (requires { Kind::parameters(); }) {
    return {Kind::name, Kind::summary, [] { return describe_table(Kind::parameters()); },
            [](input::Table& holder, const std::string& key) -> std::unique_ptr<Shape> {
              auto table = holder.required_table(key);
              auto shape = std::make_unique<Kind>();
              if (!table || !table->read(Kind::parameters(), *shape)) return nullptr;
              if constexpr (requires { shape->settle(); }) {
                if (const std::string fault = shape->settle(); !fault.empty()) {
                  table->error(fmt::format("'{}': {}", table->name(), fault));
                  return nullptr;
                }
              }
              return shape;
            },
            [](input::Schema& value) { input::add_keys(value, Kind::parameters()); }};
  } else {
    return {Kind::name, Kind::summary, Kind::describe, Kind::read, Kind::schema};
  }
}

}  // namespace

const Catalogue<ShapeEntry>& shape_catalogue() {
  static const Catalogue<ShapeEntry> all("shape", {
                                                      entry<Sphere>(),
                                                      entry<Box>(),
                                                      entry<Cylinder>(),
                                                      entry<Tube>(),
                                                      entry<Cone>(),
                                                      entry<Ogive>(),
                                                      entry<HalfSpace>(),
                                                      entry<Prism>(),
                                                      entry<Extrude>(),
                                                      entry<Revolve>(),
                                                      // Structures in a box.
                                                      entry<MinimalSurface>(),
                                                      entry<Foam>(),
                                                      entry<Packing>(),
                                                      // From files.
                                                      entry<Surface>(),
                                                      entry<VoxelBody>(),
                                                      entry<Points>(),
                                                      // Combinations of other shapes.
                                                      entry<Union>(),
                                                      entry<Intersection>(),
                                                      entry<Difference>(),
                                                      entry<Moved>(),
                                                      entry<Scaled>(),
                                                      entry<Array>(),
                                                  });
  return all;
}

void add_shapes(input::Schema& holder) {
  for (const ShapeEntry& entry : shape_catalogue()) {
    input::Schema value;
    entry.schema(value);
    value["description"] = entry.summary;
    input::add_key(holder, entry.name, value);
  }
  holder["minProperties"] = 1;
  holder["maxProperties"] = 1;
}

std::unique_ptr<Shape> read_only_shape(input::Table& holder) {
  std::unique_ptr<Shape> shape;
  int found = 0;
  for (const ShapeEntry& entry : shape_catalogue()) {
    if (!holder.has(entry.name)) continue;
    shape = entry.read(holder, entry.name);
    ++found;
  }
  if (found == 1) return shape;
  holder.error(fmt::format("'{}' must hold exactly one of: {}", holder.name(),
                           fmt::join(shape_catalogue().names(), ", ")));
  return nullptr;
}

std::string fault_of(const Shape& shape) {
  bool has_points = false;
  shape.visit([&](const Shape& part) { has_points = has_points || !part.particles().empty(); });
  if (has_points && shape.particles().empty()) {
    return "combines 'points', which are particles and no solid: they are the shape of a body alone, or "
           "within "
           "'moved'";
  }
  const Shape::Bounds bounds = shape.bounds();
  if (!(bounds.lower.array() < bounds.upper.array()).all()) {
    return "is empty: the lower corner is not below the upper one";
  }
  if (!(bounds.upper - bounds.lower).allFinite()) return "has no end: intersect it with a bounded shape";
  return {};
}

std::unique_ptr<Shape> read_shape(input::Table& body) {
  auto holder = body.required_table("shape");
  if (!holder) return nullptr;
  std::unique_ptr<Shape> shape = read_only_shape(*holder);
  if (!shape) return nullptr;  // errors have already been reported
  const std::string fault = fault_of(*shape);
  if (fault.empty()) return shape;
  body.error_at("shape", fmt::format("'{}.shape' {}", body.name(), fault));
  return nullptr;
}

}  // namespace whipple::cases
