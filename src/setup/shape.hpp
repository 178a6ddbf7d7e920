// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "src/base/tensor.hpp"
#include "src/input/document.hpp"

namespace whipple::setup {

/// Region of space that a body fills at the start.
class Shape {
 public:
  struct Bounds {
    Vector3 lower, upper;  ///< m
  };
  virtual ~Shape() = default;
  [[nodiscard]] virtual bool contains(const Vector3& point) const = 0;
  [[nodiscard]] virtual Bounds bounds() const = 0;
  /// Exact volume (m^3), to judge a discretisation by.
  [[nodiscard]] virtual double volume() const = 0;
  /// `{ NAME = { key = value, ... } }` as it stands in a case file.
  [[nodiscard]] virtual std::string toml() const = 0;
};

/// A kind of shape: one line of the catalogue per primitive.
struct ShapeEntry {
  std::string name;
  std::string summary;
  std::string (*describe)();
  std::unique_ptr<Shape> (*read)(input::Table& table);
};
std::span<const ShapeEntry> shape_catalogue();

/// Reads `shape = { NAME = { ... } }`. Reports errors in the document and returns null then.
std::unique_ptr<Shape> read_shape(input::Table& body);

}  // namespace whipple::setup
