// SPDX-License-Identifier: BSD-3-Clause
#include "src/setup/shape.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace whipple::setup {
namespace {

constexpr double pi = std::numbers::pi;

template <class Primitive>
std::string shape_as_toml(const char* name, Primitive shape) {
  std::string keys;
  for (const BoundParameter& parameter : whipple::bind(Primitive::parameters(), shape)) {
    keys += fmt::format("{}{} = {}", keys.empty() ? "" : ", ", parameter.info.name, value_as_toml(parameter));
  }
  return fmt::format("{{ {} = {{ {} }} }}", name, keys);
}

class Sphere final : public Shape {
 public:
  static ParameterTable<Sphere> parameters() {
    return {vector("center", &Sphere::center_, "m", range::any(), "centre of the sphere"),
            real("radius", &Sphere::radius_, "m", range::positive(), "radius")};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return (point - center_).squaredNorm() < radius_ * radius_;
  }
  [[nodiscard]] Bounds bounds() const override {
    const Vector3 half = Vector3::Constant(radius_);
    return {center_ - half, center_ + half};
  }
  [[nodiscard]] double volume() const override { return 4.0 / 3.0 * pi * radius_ * radius_ * radius_; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("sphere", *this); }

 private:
  Vector3 center_ = Vector3::Zero();
  double radius_ = 1.0;
};

class Box final : public Shape {
 public:
  static ParameterTable<Box> parameters() {
    return {vector("lower", &Box::lower_, "m", range::any(), "corner with the least coordinates"),
            vector("upper", &Box::upper_, "m", range::any(), "corner with the greatest coordinates")};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return (point.array() > lower_.array()).all() && (point.array() < upper_.array()).all();
  }
  [[nodiscard]] Bounds bounds() const override { return {lower_, upper_}; }
  [[nodiscard]] double volume() const override { return (upper_ - lower_).prod(); }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("box", *this); }

 private:
  Vector3 lower_ = Vector3::Zero();
  Vector3 upper_ = Vector3::Ones();
};

class Cylinder final : public Shape {
 public:
  static ParameterTable<Cylinder> parameters() {
    return {vector("center", &Cylinder::center_, "m", range::any(), "centre, at half height"),
            choice("axis", &Cylinder::axis_, {"x", "y", "z"}, "direction of the axis").optional(),
            real("radius", &Cylinder::radius_, "m", range::positive(), "radius"),
            real("height", &Cylinder::height_, "m", range::positive(), "length along the axis")};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    Vector3 offset = point - center_;
    const double along = offset[axis()];
    offset[axis()] = 0.0;
    return std::abs(along) < 0.5 * height_ && offset.squaredNorm() < radius_ * radius_;
  }
  [[nodiscard]] Bounds bounds() const override {
    Vector3 half = Vector3::Constant(radius_);
    half[axis()] = 0.5 * height_;
    return {center_ - half, center_ + half};
  }
  [[nodiscard]] double volume() const override { return pi * radius_ * radius_ * height_; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("cylinder", *this); }

 private:
  [[nodiscard]] Eigen::Index axis() const { return axis_[0] - 'x'; }
  Vector3 center_ = Vector3::Zero();
  std::string axis_ = "z";
  double radius_ = 1.0;
  double height_ = 1.0;
};

template <class Primitive>
ShapeEntry entry(const char* name, const char* summary) {
  return {name, summary, +[] { return describe_table(Primitive::parameters()); },
          +[](input::Table& table) -> std::unique_ptr<Shape> {
            auto shape = std::make_unique<Primitive>();
            if (!table.read(Primitive::parameters(), *shape)) return nullptr;
            return shape;
          }};
}

}  // namespace

std::span<const ShapeEntry> shape_catalogue() {
  static const std::array<ShapeEntry, 3> catalogue = {entry<Sphere>("sphere", "solid sphere"),
                                                      entry<Box>("box", "box along the axes"),
                                                      entry<Cylinder>("cylinder", "solid circular cylinder")};
  return catalogue;
}

std::unique_ptr<Shape> read_shape(input::Table& body) {
  auto table = body.required_table("shape");
  if (!table) return nullptr;
  std::unique_ptr<Shape> shape;
  std::string names;
  int found = 0;
  for (const ShapeEntry& entry : shape_catalogue()) {
    names += (names.empty() ? "" : ", ") + entry.name;
    if (auto primitive = table->optional_table(entry.name)) {
      shape = entry.read(*primitive);
      ++found;
    }
  }
  if (found != 1) {
    body.error_at("shape", fmt::format("'{}.shape' must hold exactly one of: {}", body.name(), names));
    return nullptr;
  }
  if (!shape) return nullptr;  // its errors are reported
  const Shape::Bounds bounds = shape->bounds();
  if (!(bounds.lower.array() < bounds.upper.array()).all()) {
    body.error_at("shape", fmt::format("'{}.shape' is empty: the lower corner is not below the upper one",
                                       body.name()));
    return nullptr;
  }
  return shape;
}

}  // namespace whipple::setup
