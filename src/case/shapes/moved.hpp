// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "src/case/shapes/combination.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {

/// Describes a rotation about a point followed by a translation.
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

/// Describes a rotated and translated shape.
class Moved final : public Shape {
 public:
  static constexpr const char* name = "moved";
  static constexpr const char* summary =
      "a shape rotated and displaced: moved = { shape = { ... }, angle = \"30 degree\", ... }";
  static std::string describe() { return describe_table(Motion::parameters()); }
  static void schema(input::Schema& value) {
    input::add_keys(value, Motion::parameters());
    add_member(value, "shape", false);
  }
  static std::unique_ptr<Shape> read(input::Table& holder, const std::string& key) {
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

  Moved(const Motion& motion, std::unique_ptr<Shape> shape)
      : motion_(motion),
        rotation_(Eigen::AngleAxisd(motion.angle, motion.axis.normalized())),
        shape_(std::move(shape)) {
    for (const GivenParticle& each : shape_->particles()) {
      particles_.push_back({image(each.position), each.edge});
    }
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return shape_->contains(rotation_.transpose() * (point - motion_.translation - motion_.center) +
                            motion_.center);
  }
  [[nodiscard]] Bounds bounds() const override {
    const Bounds box = shape_->bounds();
    if (!(box.upper - box.lower).allFinite()) return box;
    const Vector3 half = 0.5 * (box.upper - box.lower);
    const Vector3 middle = image(0.5 * (box.upper + box.lower));
    const Vector3 reach = rotation_.cwiseAbs() * half;
    return {middle - reach, middle + reach};
  }
  [[nodiscard]] double volume() const override { return shape_->volume(); }
  [[nodiscard]] std::span<const GivenParticle> particles() const override { return particles_; }
  [[nodiscard]] std::string source_of(std::size_t particle) const override {
    return shape_->source_of(particle);
  }
  [[nodiscard]] std::unique_ptr<Shape> settled(const Settling& settling) const override {
    Settling before = settling;
    if (settling.depth) before.depth = [&](const Vector3& x) { return settling.depth(image(x)); };
    std::unique_ptr<Shape> shape = shape_->settled(before);
    return shape ? std::make_unique<Moved>(motion_, std::move(shape)) : nullptr;
  }
  void visit(const std::function<void(const Shape&)>& f) const override {
    f(*this);
    shape_->visit(f);
  }
  [[nodiscard]] double smallest_extent(const Vector3& direction) const override {
    return shape_->smallest_extent(rotation_.transpose() * direction);
  }
  [[nodiscard]] bool fills_lattice() const override {
    return !particles_.empty() || (rotation_.isIdentity(1e-12) && shape_->fills_lattice());
  }
  [[nodiscard]] std::string toml() const override { return holder_as_toml(name, motion_, *shape_); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    const Vector3 shift = motion_.translation + motion_.center - rotation_ * motion_.center;
    const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
    Bounds before{-everywhere, everywhere};  // the rotation does not move faces normal to its axis
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
  [[nodiscard]] Vector3 image(const Vector3& x) const {
    return rotation_ * (x - motion_.center) + motion_.center + motion_.translation;
  }

  Motion motion_;
  Matrix3 rotation_;
  std::unique_ptr<Shape> shape_;
  std::vector<GivenParticle> particles_;  // moved
};

}  // namespace whipple::cases
