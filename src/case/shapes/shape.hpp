// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/core/base/catalogue.hpp"
#include "src/core/base/tensor.hpp"
#include "src/core/input/document.hpp"
#include "src/core/input/schema.hpp"
#include "src/fem/mesh.hpp"

namespace whipple::cases {

/// Names a file of another program that a shape was read from.
struct SourceFile {
  std::filesystem::path path;  ///< absolute
  std::string digest;          ///< SHA-256 of the file, and of its companions if there are any
  std::vector<std::filesystem::path> companions;  ///< absolute; further files that it names
};

/// Describes a particle that a shape gives itself, instead of being filled on a lattice.
struct GivenParticle {
  Vector3 position;
  double edge;  ///< m, of the cube that is its volume; in two dimensions of the square that is its area
};

/// Tells a shape with given particles what their masses and volumes mean.
struct Settling {
  double density =
      std::numeric_limits<double>::infinity();  ///< kg/m^3, of the body; infinite: that of the keys
  bool is_planar = false;
  std::function<double(const Vector3&)> depth = nullptr;  ///< m, at a place of a plane or axisymmetric domain
};

/// Describes the region of space that a body initially fills.
class Shape {
 public:
  struct Bounds {
    Vector3 lower, upper;  ///< m; infinite if the shape is unbounded
  };
  virtual ~Shape() = default;
  [[nodiscard]] virtual bool contains(const Vector3& point) const = 0;
  /// Returns whether a point within `radius` of this one may be inside; false only where none is. It spares shapes that
  /// take long to evaluate most of a lattice.
  [[nodiscard]] virtual bool may_hold(const Vector3& /*point*/, double /*radius*/) const { return true; }
  [[nodiscard]] virtual Bounds bounds() const = 0;
  /// Returns the volume (m^3), to assess a discretization: exact for primitives, to about 1e-3 for combinations.
  [[nodiscard]] virtual double volume() const = 0;
  /// Returns the smallest extent (m), to assess the number of cells across it; NaN for shapes that do not provide one.
  /// For a box it is the extent along `direction`, the direction of flight, as the section of a planar impact ends at
  /// mirror planes.
  [[nodiscard]] virtual double smallest_extent(const Vector3& /*direction*/) const {
    return std::numeric_limits<double>::quiet_NaN();
  }
  /// Returns whether whole cells of a lattice over its bounds fill it exactly, as for a box aligned with the axes.
  [[nodiscard]] virtual bool fills_lattice() const { return false; }
  /// Returns the particles that this shape gives itself; empty: a lattice fills it.
  [[nodiscard]] virtual std::span<const GivenParticle> particles() const { return {}; }
  /// Returns where a given particle comes from, for messages: "points.csv:7".
  [[nodiscard]] virtual std::string source_of(std::size_t /*particle*/) const { return {}; }
  /// Returns this shape with the edges of its given particles; null if there are none, or no density is known.
  /// @throws InputError if they are not those of this density, or have no volume
  [[nodiscard]] virtual std::unique_ptr<Shape> settled(const Settling& /*settling*/) const { return nullptr; }
  /// Calls f for this shape and for all that it is made of.
  virtual void visit(const std::function<void(const Shape&)>& f) const { f(*this); }
  /// Returns the file that this shape was read from, if any; of what it is made of, see `visit`.
  [[nodiscard]] virtual std::optional<SourceFile> source() const { return std::nullopt; }
  /// Returns what `whipple check` reports on this shape beyond its mass, a line each.
  [[nodiscard]] virtual std::vector<std::string> account() const { return {}; }
  /// Returns `{ NAME = ... }` as written in a case file.
  [[nodiscard]] virtual std::string toml() const = 0;
  /// Returns a structured mesh of the shape, or of its part within `clip`, whose finite faces halve it; elements beyond
  /// may remain. Returns nothing for shapes without structured mesh.
  /// @param size  target edge of the elements, m
  /// @throws InputError if it is not positive
  [[nodiscard]] virtual std::optional<fem::Hexahedra> hexahedra(double /*size*/,
                                                                const Bounds& /*clip*/) const {
    return std::nullopt;
  }
};

/// Describes a kind of shape. Its class has `name`, `summary` and either `parameters()`, or `describe()`, `schema` and
/// `read`; it needs one header, and one line in the catalogue.
struct ShapeEntry {
  std::string name;
  std::string summary;
  std::string (*describe)();
  /// Reads the key `name` of a table. Reports errors in the document and then returns null.
  std::unique_ptr<Shape> (*read)(input::Table& holder, const std::string& name);
  /// Fills in the schema of the value of the key `name`.
  void (*schema)(input::Schema& value);
};
/// Lists all shapes that `shape = { NAME = ... }` accepts, one per line.
const Catalogue<ShapeEntry>& shape_catalogue();

/// Fills in the schema of `{ NAME = ... }`, which refers to itself as "#/$defs/shape".
void add_shapes(input::Schema& holder);

/// Reads the single shape of a table `{ NAME = ... }`. Reports errors in the document and then returns null.
std::unique_ptr<Shape> read_only_shape(input::Table& holder);

/// Returns why a shape is not valid for a body ("is empty ..."); empty if it is valid.
std::string fault_of(const Shape& shape);

/// Reads `shape = { NAME = ... }` of a body, which must be bounded and not empty. Reports errors in the document and
/// then returns null.
std::unique_ptr<Shape> read_shape(input::Table& body);

}  // namespace whipple::cases
