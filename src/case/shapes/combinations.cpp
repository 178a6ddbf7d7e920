// SPDX-License-Identifier: BSD-3-Clause
// Constructive solid geometry: shapes made of shapes.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/case/shapes/shape.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {
namespace {

using Parts = std::vector<std::unique_ptr<Shape>>;

/// By counting the points of a lattice over the bounds.
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

class Union final : public Shape {
 public:
  explicit Union(Parts parts) : parts_(std::move(parts)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return std::ranges::any_of(parts_, [&](const auto& part) { return part->contains(point); });
  }
  [[nodiscard]] Bounds bounds() const override {
    Bounds all = parts_.front()->bounds();
    for (const auto& part : parts_) {
      const Bounds one = part->bounds();
      all = {all.lower.cwiseMin(one.lower), all.upper.cwiseMax(one.upper)};
    }
    return all;
  }
  [[nodiscard]] double volume() const override { return counted_volume(*this); }
  [[nodiscard]] std::string toml() const override { return "{ union = " + list_as_toml(parts_) + " }"; }

 private:
  Parts parts_;
};

class Intersection final : public Shape {
 public:
  explicit Intersection(Parts parts) : parts_(std::move(parts)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return std::ranges::all_of(parts_, [&](const auto& part) { return part->contains(point); });
  }
  [[nodiscard]] Bounds bounds() const override {
    Bounds all = parts_.front()->bounds();
    for (const auto& part : parts_) {
      const Bounds one = part->bounds();
      all = {all.lower.cwiseMax(one.lower), all.upper.cwiseMin(one.upper)};
    }
    return all;
  }
  [[nodiscard]] double volume() const override { return counted_volume(*this); }
  [[nodiscard]] std::string toml() const override {
    return "{ intersection = " + list_as_toml(parts_) + " }";
  }

 private:
  Parts parts_;
};

class Difference final : public Shape {
 public:
  Difference(std::unique_ptr<Shape> from, Parts minus) : from_(std::move(from)), minus_(std::move(minus)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return from_->contains(point) &&
           std::ranges::none_of(minus_, [&](const auto& part) { return part->contains(point); });
  }
  [[nodiscard]] Bounds bounds() const override { return from_->bounds(); }
  [[nodiscard]] double volume() const override { return counted_volume(*this); }
  [[nodiscard]] std::string toml() const override {
    return fmt::format("{{ difference = {{ from = {}, minus = {} }} }}", from_->toml(), list_as_toml(minus_));
  }

 private:
  std::unique_ptr<Shape> from_;
  Parts minus_;
};

/// A shape turned about a point, then moved.
struct Motion {
  Vector3 translation = Vector3::Zero();
  Vector3 axis = Vector3::UnitZ();
  double angle = 0.0;  ///< rad
  Vector3 center = Vector3::Zero();

  static ParameterTable<Motion> parameters() {
    return {vector("translation", &Motion::translation, "m", range::any(), "displacement, after the rotation")
                .optional(),
            vector("axis", &Motion::axis, "", range::any(), "direction of the axis of rotation, any length")
                .optional(),
            real("angle", &Motion::angle, "rad", range::any(), "angle of rotation by the right-hand rule")
                .optional(),
            vector("center", &Motion::center, "m", range::any(), "point on the axis of rotation").optional()};
  }
};

class Moved final : public Shape {
 public:
  Moved(const Motion& motion, std::unique_ptr<Shape> shape)
      : motion_(motion),
        rotation_(Eigen::AngleAxisd(motion.angle, motion.axis.normalized())),
        shape_(std::move(shape)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return shape_->contains(rotation_.transpose() * (point - motion_.translation - motion_.center) +
                            motion_.center);
  }
  [[nodiscard]] Bounds bounds() const override {
    const Bounds box = shape_->bounds();
    if (!(box.upper - box.lower).allFinite()) return box;
    const Vector3 half = 0.5 * (box.upper - box.lower);
    const Vector3 middle =
        rotation_ * (0.5 * (box.upper + box.lower) - motion_.center) + motion_.center + motion_.translation;
    const Vector3 reach = rotation_.cwiseAbs() * half;
    return {middle - reach, middle + reach};
  }
  [[nodiscard]] double volume() const override { return shape_->volume(); }
  [[nodiscard]] bool fills_lattice() const override {
    return rotation_.isIdentity(1e-12) && shape_->fills_lattice();
  }
  [[nodiscard]] std::string toml() const override {
    std::string keys;
    Motion copy = motion_;
    for (const BoundParameter& parameter : whipple::bind(Motion::parameters(), copy)) {
      keys += fmt::format("{} = {}, ", parameter.info.name, value_as_toml(parameter));
    }
    return fmt::format("{{ moved = {{ {}shape = {} }} }}", keys, shape_->toml());
  }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    const Vector3 shift = motion_.translation + motion_.center - rotation_ * motion_.center;
    const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
    Bounds before{-everywhere, everywhere};  // faces across the axis of the rotation stay where they are
    for (int a = 0; a < 3; ++a) {
      if (std::abs(rotation_(a, a) - 1.0) > 1e-12) continue;
      before.lower[a] = clip.lower[a] - shift[a];
      before.upper[a] = clip.upper[a] - shift[a];
    }
    std::optional<fem::Hexahedra> mesh = shape_->hexahedra(size, before);
    if (mesh) fem::transform(*mesh, rotation_, shift);
    return mesh;
  }

 private:
  Motion motion_;
  Matrix3 rotation_;
  std::unique_ptr<Shape> shape_;
};

/// The shapes of a list; empty if one of them is wrong, or there is none.
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

template <class Combination>
std::unique_ptr<Shape> read_list(input::Table& holder, const std::string& key) {
  Parts parts = read_parts(holder, key);
  if (parts.empty()) return nullptr;
  return std::make_unique<Combination>(std::move(parts));
}

std::unique_ptr<Shape> read_member(input::Table& table, const char* key) {
  auto holder = table.required_table(key);
  return holder ? read_only_shape(*holder) : nullptr;
}

std::unique_ptr<Shape> read_difference(input::Table& holder, const std::string& key) {
  auto table = holder.required_table(key);
  if (!table) return nullptr;
  std::unique_ptr<Shape> from = read_member(*table, "from");
  Parts minus = read_parts(*table, "minus");
  if (!from || minus.empty()) return nullptr;
  return std::make_unique<Difference>(std::move(from), std::move(minus));
}

std::unique_ptr<Shape> read_moved(input::Table& holder, const std::string& key) {
  auto table = holder.required_table(key);
  if (!table) return nullptr;
  Motion motion;
  const bool good = table->read(Motion::parameters(), motion);
  std::unique_ptr<Shape> shape = read_member(*table, "shape");
  if (good && !(motion.axis.norm() > 0.0)) {
    table->error_at("axis", "'axis' must not be zero");
    return nullptr;
  }
  if (!good || !shape) return nullptr;
  return std::make_unique<Moved>(motion, std::move(shape));
}

}  // namespace

std::span<const ShapeEntry> combinations() {
  static const std::array<ShapeEntry, 4> entries = {{
      {"union", "all of several shapes: union = [{ sphere = ... }, ...]", +[] { return std::string(); },
       read_list<Union>},
      {"intersection", "what several shapes have in common: intersection = [{ sphere = ... }, ...]",
       +[] { return std::string(); }, read_list<Intersection>},
      {"difference", "a shape without others: difference = { from = { ... }, minus = [{ ... }, ...] }",
       +[] { return std::string(); }, read_difference},
      {"moved", "a shape turned and displaced: moved = { shape = { ... }, angle = \"30 degree\", ... }",
       +[] { return describe_table(Motion::parameters()); }, read_moved},
  }};
  return entries;
}

}  // namespace whipple::cases
