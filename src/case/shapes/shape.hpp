// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "src/core/base/catalogue.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/input/document.hpp"
#include "src/core/input/schema.hpp"
#include "src/fem/mesh.hpp"

namespace whipple::cases {

/// Region of space that a body fills at the start.
class Shape {
 public:
  struct Bounds {
    Vector3 lower, upper;  ///< m; infinite where the shape has no end
  };
  virtual ~Shape() = default;
  [[nodiscard]] virtual bool contains(const Vector3& point) const = 0;
  [[nodiscard]] virtual Bounds bounds() const = 0;
  /// Volume (m^3), to judge a discretisation by: exact for primitives, to about 1e-3 for combinations.
  [[nodiscard]] virtual double volume() const = 0;
  /// Returns the smallest extent (m), to judge how many cells lie across it; NaN of shapes that state none. Of a box it is
  /// the extent along `direction`, in which it flies: the section of a planar impact ends at mirror planes.
  [[nodiscard]] virtual double smallest_extent(const Vector3& /*direction*/) const {
    return std::numeric_limits<double>::quiet_NaN();
  }
  /// Returns whether whole cells of a lattice over its bounds fill it, as they do a box along the axes.
  [[nodiscard]] virtual bool fills_lattice() const { return false; }
  /// `{ NAME = ... }` as it stands in a case file.
  [[nodiscard]] virtual std::string toml() const = 0;
  /// Structured mesh of the shape, or of its part within `clip`, whose finite faces halve it; elements
  /// beyond may be left. Nothing for shapes that have none.
  /// @param size  wanted edge of the elements, m
  /// @throws InputError if it is not positive
  [[nodiscard]] virtual std::optional<fem::Hexahedra> hexahedra(double /*size*/,
                                                                const Bounds& /*clip*/) const {
    return std::nullopt;
  }
};

/// A kind of shape. Its class has `name`, `summary` and either `parameters()`, or `describe()`, `schema` and `read`: one
/// header, and one line in the catalogue.
struct ShapeEntry {
  std::string name;
  std::string summary;
  std::string (*describe)();
  /// Reads the key `name` of a table. Reports errors in the document and returns null then.
  std::unique_ptr<Shape> (*read)(input::Table& holder, const std::string& name);
  /// Fills in the schema of the value of the key `name`.
  void (*schema)(input::Schema& value);
};
/// All shapes that `shape = { NAME = ... }` may hold, one line each.
const Catalogue<ShapeEntry>& shape_catalogue();

/// Fills in the schema of `{ NAME = ... }`, which refers to itself as "#/$defs/shape".
void add_shapes(input::Schema& holder);

/// Reads the one shape that a table `{ NAME = ... }` holds. Reports errors in the document and returns null
/// then.
std::unique_ptr<Shape> read_only_shape(input::Table& holder);

/// Returns why a shape cannot be that of a body ("is empty ..."); empty if it can.
std::string fault_of(const Shape& shape);

/// Reads `shape = { NAME = ... }` of a body: bounded, not empty. Reports errors in the document and returns
/// null then.
std::unique_ptr<Shape> read_shape(input::Table& body);

}  // namespace whipple::cases
