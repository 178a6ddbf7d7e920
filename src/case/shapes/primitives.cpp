// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/case/shapes/shape.hpp"
#include "src/fem/structured.hpp"

namespace whipple::cases {
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

/// Which half of a body about `center` lies within the clip, along an axis: -1, +1, or 0 for all of it.
int half_within(const Shape::Bounds& clip, Eigen::Index axis, double center, double radius) {
  const auto at_center = [&](double face) { return std::abs(face - center) < 1e-9 * radius; };
  return at_center(clip.lower[axis]) ? 1 : at_center(clip.upper[axis]) ? -1 : 0;
}

/// A mesh that `make` makes about the z axis, from z = 0 on, or halves of it, brought to its place: z becomes
/// the direction `axis`.
template <class Make>
fem::Hexahedra mesh_about_axis(const Vector3& base, Eigen::Index axis, double radius,
                               const Shape::Bounds& clip, Make&& make) {
  const Eigen::Index first = (axis + 1) % 3, second = (axis + 2) % 3;
  const int x = half_within(clip, first, base[first], radius);
  const int y = half_within(clip, second, base[second], radius);
  Matrix3 turn = Matrix3::Zero();
  turn(first, 0) = x < 0 ? -1.0 : 1.0;
  turn(second, 1) = y < 0 ? -1.0 : 1.0;
  turn(axis, 2) = 1.0;
  fem::Hexahedra mesh = make(fem::Halved{x != 0, y != 0, false});
  fem::transform(mesh, turn, base);
  return mesh;
}

/// The part of a body of revolution along its axis, [from, to], that lies within the clip, as a mesh;
/// `make(length, halved)` makes it.
template <class Make>
fem::Hexahedra mesh_of_revolution(Vector3 base, Eigen::Index axis, double height, double radius,
                                  const Shape::Bounds& clip, Make&& make) {
  const double from = std::max(base[axis], clip.lower[axis]);
  const double to = std::min(base[axis] + height, clip.upper[axis]);
  base[axis] = from;
  return mesh_about_axis(base, axis, radius, clip,
                         [&](const fem::Halved& halved) { return make(to - from, halved); });
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
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    fem::Halved halved{};
    Matrix3 turn = Matrix3::Identity();
    for (int a = 0; a < 3; ++a) {
      const int half = half_within(clip, a, center_[a], radius_);
      halved[static_cast<std::size_t>(a)] = half != 0;
      if (half < 0) turn(a, a) = -1.0;
    }
    fem::Hexahedra mesh = fem::make_sphere(radius_, size, halved);
    fem::transform(mesh, turn, center_);
    return mesh;
  }

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
  [[nodiscard]] bool fills_lattice() const override { return true; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("box", *this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    return fem::make_box(lower_.cwiseMax(clip.lower), upper_.cwiseMin(clip.upper), size);
  }

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
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    Vector3 base = center_;
    base[axis()] -= 0.5 * height_;
    return mesh_of_revolution(base, axis(), height_, radius_, clip,
                              [&](double length, const fem::Halved& halved) {
                                return fem::make_cylinder(radius_, length, size, halved);
                              });
  }

 private:
  [[nodiscard]] Eigen::Index axis() const { return axis_[0] - 'x'; }
  Vector3 center_ = Vector3::Zero();
  std::string axis_ = "z";
  double radius_ = 1.0;
  double height_ = 1.0;
};

/// Primitives of revolution: what they have in common.
struct Revolution {
  Vector3 base = Vector3::Zero();
  std::string axis = "z";

  /// Length along the axis from the base, and distance from the axis.
  struct Place {
    double along, radius;
  };
  [[nodiscard]] Place place(const Vector3& point) const {
    Vector3 offset = point - base;
    const double along = offset[index()];
    offset[index()] = 0.0;
    return {along, offset.norm()};
  }
  [[nodiscard]] Shape::Bounds bounds(double from, double to, double radius) const {
    Vector3 lower = base - Vector3::Constant(radius), upper = base + Vector3::Constant(radius);
    lower[index()] = base[index()] + from;
    upper[index()] = base[index()] + to;
    return {lower, upper};
  }
  [[nodiscard]] Eigen::Index index() const { return axis[0] - 'x'; }

  template <class Owner>
  static ParameterTable<Owner> parameters(const char* meaning_of_base) {
    return {vector<Owner>("base", &Owner::base, "m", range::any(), meaning_of_base),
            choice<Owner>("axis", &Owner::axis, {"x", "y", "z"}, "direction of the axis").optional()};
  }
};

class Tube final : public Shape, public Revolution {
 public:
  static ParameterTable<Tube> parameters() {
    ParameterTable<Tube> table = Revolution::parameters<Tube>("centre of the lower end");
    table.push_back(real("inner_radius", &Tube::inner_, "m", range::positive(), "radius of the hole"));
    table.push_back(real("outer_radius", &Tube::outer_, "m", range::positive(), "outer radius"));
    table.push_back(real("height", &Tube::height_, "m", range::positive(), "length along the axis"));
    return table;
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Place p = place(point);
    return p.along > 0.0 && p.along < height_ && p.radius > inner_ && p.radius < outer_;
  }
  [[nodiscard]] Bounds bounds() const override { return Revolution::bounds(0.0, height_, outer_); }
  [[nodiscard]] double volume() const override { return pi * (outer_ * outer_ - inner_ * inner_) * height_; }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("tube", *this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    return mesh_of_revolution(base, index(), height_, outer_, clip,
                              [&](double length, const fem::Halved& halved) {
                                return fem::make_tube(inner_, outer_, length, size, halved);
                              });
  }

 private:
  double inner_ = 0.5, outer_ = 1.0, height_ = 1.0;
};

class Cone final : public Shape, public Revolution {
 public:
  static ParameterTable<Cone> parameters() {
    ParameterTable<Cone> table = Revolution::parameters<Cone>("centre of the base");
    table.push_back(real("base_radius", &Cone::base_radius_, "m", range::positive(), "radius at the base"));
    table.push_back(real("top_radius", &Cone::top_radius_, "m", range::non_negative(),
                         "radius at the other end (0: a tip)")
                        .optional());
    table.push_back(real("height", &Cone::height_, "m", range::positive(), "length along the axis"));
    return table;
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Place p = place(point);
    return p.along > 0.0 && p.along < height_ &&
           p.radius < base_radius_ + (top_radius_ - base_radius_) * p.along / height_;
  }
  [[nodiscard]] Bounds bounds() const override {
    return Revolution::bounds(0.0, height_, std::max(base_radius_, top_radius_));
  }
  [[nodiscard]] double volume() const override {
    return pi / 3.0 * height_ *
           (base_radius_ * base_radius_ + base_radius_ * top_radius_ + top_radius_ * top_radius_);
  }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("cone", *this); }

 private:
  double base_radius_ = 1.0, top_radius_ = 0.0, height_ = 1.0;
};

/// Tangent ogive: the arc of radius rho = (R^2 + L^2)/(2 R) meets the shank without a kink; the calibre of
/// the nose is rho/(2 R).
class Ogive final : public Shape, public Revolution {
 public:
  static ParameterTable<Ogive> parameters() {
    ParameterTable<Ogive> table = Revolution::parameters<Ogive>("centre of the plane where the nose begins");
    table.push_back(real("radius", &Ogive::radius_, "m", range::positive(), "R, radius of the shank"));
    table.push_back(
        real("nose_length", &Ogive::nose_, "m", range::positive(), "L, along the axis; at least R"));
    table.push_back(real("shank_length", &Ogive::shank_, "m", range::non_negative(),
                         "length of the cylinder behind the base")
                        .optional());
    return table;
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    const Place p = place(point);
    if (p.along <= -shank_ || p.along >= nose_) return false;
    return p.radius < (p.along < 0.0 ? radius_ : std::sqrt(arc() * arc() - p.along * p.along) - depth());
  }
  [[nodiscard]] Bounds bounds() const override { return Revolution::bounds(-shank_, nose_, radius_); }
  [[nodiscard]] double volume() const override {
    const double r = arc(), d = depth(), l = nose_;
    const double nose = r * r * l - l * l * l / 3.0 + d * d * l -
                        d * (l * std::sqrt(r * r - l * l) + r * r * std::asin(l / r));
    return pi * (nose + radius_ * radius_ * shank_);
  }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("ogive", *this); }
  [[nodiscard]] std::optional<fem::Hexahedra> hexahedra(double size, const Bounds& clip) const override {
    Vector3 rear = base;
    rear[index()] -= shank_;
    return mesh_about_axis(rear, index(), radius_, clip, [&](const fem::Halved& halved) {
      return fem::make_ogive(radius_, nose_, shank_, size, halved);
    });
  }

 private:
  [[nodiscard]] double arc() const { return (radius_ * radius_ + nose_ * nose_) / (2.0 * radius_); }
  [[nodiscard]] double depth() const { return arc() - radius_; }
  double radius_ = 1.0, nose_ = 2.0, shank_ = 0.0;
};

class HalfSpace final : public Shape {
 public:
  static ParameterTable<HalfSpace> parameters() {
    return {
        vector("point", &HalfSpace::point_, "m", range::any(), "a point of the face"),
        vector("normal", &HalfSpace::normal_, "", range::any(), "direction out of the matter, any length")};
  }
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return normal_.dot(point - point_) < 0.0;
  }
  [[nodiscard]] Bounds bounds() const override {
    const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
    return {-everywhere, everywhere};
  }
  [[nodiscard]] double volume() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] std::string toml() const override { return shape_as_toml("half_space", *this); }

 private:
  Vector3 point_ = Vector3::Zero();
  Vector3 normal_ = Vector3::UnitZ();
};

template <class Primitive>
ShapeEntry entry(const char* name, const char* summary) {
  return {name, summary, +[] { return describe_table(Primitive::parameters()); },
          +[](input::Table& holder, const std::string& key) -> std::unique_ptr<Shape> {
            auto table = holder.required_table(key);
            auto shape = std::make_unique<Primitive>();
            if (!table || !table->read(Primitive::parameters(), *shape)) return nullptr;
            return shape;
          }};
}

}  // namespace

std::span<const ShapeEntry> primitives() {
  static const std::array entries = {
      entry<Sphere>("sphere", "solid sphere"),
      entry<Box>("box", "box along the axes"),
      entry<Cylinder>("cylinder", "solid circular cylinder"),
      entry<Tube>("tube", "hollow circular cylinder"),
      entry<Cone>("cone", "circular cone or truncated cone"),
      entry<Ogive>("ogive", "tangent ogive with a shank: the nose of a projectile"),
      entry<HalfSpace>("half_space", "everything on one side of a plane; for intersections and differences"),
  };
  return entries;
}

}  // namespace whipple::cases
