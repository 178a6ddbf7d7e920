// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/case/shapes/combination.hpp"

namespace whipple::cases {

/// Describes the intersection of several shapes.
class Intersection final : public Shape {
 public:
  static constexpr const char* name = "intersection";
  static constexpr const char* summary =
      "intersection of several shapes: intersection = [{ sphere = ... }, ...]";
  static std::string describe() { return {}; }
  static void schema(input::Schema& value) { schema_of_list(value); }
  static std::unique_ptr<Shape> read(input::Table& holder, const std::string& key) {
    return read_list<Intersection>(holder, key);
  }

  explicit Intersection(Parts parts) : parts_(std::move(parts)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return std::ranges::all_of(parts_, [&](const auto& part) { return part->contains(point); });
  }
  [[nodiscard]] bool may_hold(const Vector3& point, double radius) const override {
    return std::ranges::all_of(parts_, [&](const auto& part) { return part->may_hold(point, radius); });
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
  void visit(const std::function<void(const Shape&)>& f) const override {
    f(*this);
    visit_all(parts_, f);
  }
  [[nodiscard]] std::string toml() const override {
    return "{ intersection = " + list_as_toml(parts_) + " }";
  }

 private:
  Parts parts_;
};

}  // namespace whipple::cases
