// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "src/case/shapes/combination.hpp"

namespace whipple::cases {

/// Describes the union of several shapes.
class Union final : public Shape {
 public:
  static constexpr const char* name = "union";
  static constexpr const char* summary = "union of several shapes: union = [{ sphere = ... }, ...]";
  static std::string describe() { return {}; }
  static void schema(input::Schema& value) { schema_of_list(value); }
  static std::unique_ptr<Shape> read(input::Table& holder, const std::string& key) {
    return read_list<Union>(holder, key);
  }

  explicit Union(Parts parts) : parts_(std::move(parts)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return std::ranges::any_of(parts_, [&](const auto& part) { return part->contains(point); });
  }
  [[nodiscard]] bool may_hold(const Vector3& point, double radius) const override {
    return std::ranges::any_of(parts_, [&](const auto& part) { return part->may_hold(point, radius); });
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
  void visit(const std::function<void(const Shape&)>& f) const override {
    f(*this);
    visit_all(parts_, f);
  }
  [[nodiscard]] std::string toml() const override { return "{ union = " + list_as_toml(parts_) + " }"; }

 private:
  Parts parts_;
};

}  // namespace whipple::cases
