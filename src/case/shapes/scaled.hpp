// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/shapes/combination.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

/// Describes a stretching along the axes about a point.
struct Scaling {
  Vector3 factors = Vector3::Ones();
  Vector3 center = Vector3::Zero();

  static ParameterTable<Scaling> parameters() {
    return {vector("factors", &Scaling::factors, "", range::positive(), "along the axes").in_plane(1.0),
            vector("center", &Scaling::center, "m", range::any(), "point that stays").optional()};
  }
};

/// Describes a shape stretched along the axes.
class Scaled final : public Shape {
 public:
  static constexpr const char* name = "scaled";
  static constexpr const char* summary =
      "a shape stretched along the axes: scaled = { shape = { ... }, factors = [2, 1, 1] }";
  static std::string describe() { return describe_table(Scaling::parameters()); }
  static void schema(input::Schema& value) {
    input::add_keys(value, Scaling::parameters());
    add_member(value, "shape", false);
  }
  static std::unique_ptr<Shape> read(input::Table& holder, const std::string& key) {
    auto table = holder.required_table(key);
    if (!table) return nullptr;
    Scaling scaling;
    const bool good = table->read(Scaling::parameters(), scaling);
    std::unique_ptr<Shape> shape = read_member(*table, "shape");
    if (!good || !shape) return nullptr;
    bool has_points = false;
    shape->visit([&](const Shape& part) { has_points = has_points || !part.particles().empty(); });
    if (has_points) {
      table->error_at("shape", "'points' are particles and no solid: they are not stretched");
      return nullptr;
    }
    return std::make_unique<Scaled>(scaling, std::move(shape));
  }

  Scaled(const Scaling& scaling, std::shared_ptr<const Shape> shape)
      : scaling_(scaling), shape_(std::move(shape)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return shape_->contains((point - scaling_.center).cwiseQuotient(scaling_.factors) + scaling_.center);
  }
  [[nodiscard]] Bounds bounds() const override {
    const Bounds box = shape_->bounds();
    return {image(box.lower), image(box.upper)};
  }
  [[nodiscard]] double volume() const override { return scaling_.factors.prod() * shape_->volume(); }
  /// Returns that of the shape times the smallest factor: the true one or, where its direction is stretched more, less.
  [[nodiscard]] double smallest_extent(const Vector3& direction) const override {
    return scaling_.factors.minCoeff() *
           shape_->smallest_extent(direction.cwiseQuotient(scaling_.factors).eval());
  }
  /// Calls f for the stretched shape and for all that it is made of, each stretched.
  void visit(const std::function<void(const Shape&)>& f) const override {
    shape_->visit([&](const Shape& part) {
      f(Scaled(scaling_, std::shared_ptr<const Shape>(std::shared_ptr<const Shape>(), &part)));
    });
  }
  [[nodiscard]] std::optional<SourceFile> source() const override { return shape_->source(); }
  [[nodiscard]] std::vector<std::string> account() const override { return shape_->account(); }
  [[nodiscard]] bool fills_lattice() const override { return shape_->fills_lattice(); }
  [[nodiscard]] std::string toml() const override { return holder_as_toml(name, scaling_, *shape_); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    std::optional<fem::Hexahedra> mesh =
        shape_->hexahedra(size / scaling_.factors.maxCoeff(), {original(clip.lower), original(clip.upper)});
    if (!mesh) return mesh;
    for (Vector3& node : mesh->nodes) node = image(node);
    return mesh;
  }

 private:
  [[nodiscard]] Vector3 image(const Vector3& x) const {
    return (x - scaling_.center).cwiseProduct(scaling_.factors) + scaling_.center;
  }
  [[nodiscard]] Vector3 original(const Vector3& x) const {
    return (x - scaling_.center).cwiseQuotient(scaling_.factors) + scaling_.center;
  }

  Scaling scaling_;
  std::shared_ptr<const Shape> shape_;
};

}  // namespace whipple::cases
