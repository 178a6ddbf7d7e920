// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "src/case/shapes/combination.hpp"

namespace whipple::cases {

/// Describes a shape minus others.
class Difference final : public Shape {
 public:
  static constexpr const char* name = "difference";
  static constexpr const char* summary =
      "a shape minus others: difference = { from = { ... }, minus = [{ ... }, ...] }";
  static std::string describe() { return {}; }
  static void schema(input::Schema& value) {
    add_member(value, "from", false);
    add_member(value, "minus", true);
  }
  static std::unique_ptr<Shape> read(input::Table& holder, const std::string& key) {
    auto table = holder.required_table(key);
    if (!table) return nullptr;
    std::unique_ptr<Shape> from = read_member(*table, "from");
    Parts minus = read_parts(*table, "minus");
    if (!from || minus.empty()) return nullptr;
    return std::make_unique<Difference>(std::move(from), std::move(minus));
  }

  Difference(std::unique_ptr<Shape> from, Parts minus) : from_(std::move(from)), minus_(std::move(minus)) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return from_->contains(point) &&
           std::ranges::none_of(minus_, [&](const auto& part) { return part->contains(point); });
  }
  [[nodiscard]] bool may_hold(const Vector3& point, double radius) const override {
    return from_->may_hold(point, radius);
  }
  [[nodiscard]] Bounds bounds() const override { return from_->bounds(); }
  [[nodiscard]] double volume() const override { return counted_volume(*this); }
  void visit(const std::function<void(const Shape&)>& f) const override {
    f(*this);
    from_->visit(f);
    visit_all(minus_, f);
  }
  [[nodiscard]] std::string toml() const override {
    return fmt::format("{{ difference = {{ from = {}, minus = {} }} }}", from_->toml(), list_as_toml(minus_));
  }

 private:
  std::unique_ptr<Shape> from_;
  Parts minus_;
};

}  // namespace whipple::cases
