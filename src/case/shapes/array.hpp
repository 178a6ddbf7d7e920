// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "src/case/shapes/combination.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

/// Describes copies in a row.
struct Row {
  std::int64_t count = 1;
  Vector3 step = Vector3::Zero();

  static ParameterTable<Row> parameters() {
    return {
        integer("count", &Row::count, range::between(1, 1000000), "of the copies, the first one included"),
        vector("step", &Row::step, "m", range::any(), "from one copy to the next")};
  }
};

/// Describes copies of a shape in a row; arrays of arrays fill a plane, or space.
class Array final : public Shape {
 public:
  static constexpr const char* name = "array";
  static constexpr const char* summary =
      "copies of a shape in a row: array = { shape = { ... }, count = 3, step = [\"0 m\", \"0 m\", \"5 mm\"] "
      "}";
  static std::string describe() { return describe_table(Row::parameters()); }
  static void schema(input::Schema& value) {
    input::add_keys(value, Row::parameters());
    add_member(value, "shape", false);
  }
  static std::unique_ptr<Shape> read(input::Table& holder, const std::string& key) {
    auto table = holder.required_table(key);
    if (!table) return nullptr;
    Row row;
    const bool good = table->read(Row::parameters(), row);
    std::unique_ptr<Shape> shape = read_member(*table, "shape");
    if (!good || !shape) return nullptr;
    if (!(row.step.norm() > 0.0)) {
      table->error_at("step", "'step' must not be zero");
      return nullptr;
    }
    if (!(shape->bounds().upper - shape->bounds().lower).allFinite()) {
      table->error_at("shape", "'shape' of an array has no end: intersect it with a bounded shape");
      return nullptr;
    }
    constexpr double most = 1000.0;
    const Shape::Bounds box = shape->bounds();
    Eigen::Index axis = 0;
    const double step = row.step.cwiseAbs().maxCoeff(&axis);
    const double copies =
        std::min((box.upper - box.lower)[axis] / step, static_cast<double>(row.count)) + 1.0;
    if (copies > most) {
      table->error_at("step",
                      fmt::format("'step' is so short that {:.2g} copies reach each place; at most {:.0f}",
                                  copies, most));
      return nullptr;
    }
    return std::make_unique<Array>(row, std::move(shape));
  }

  Array(const Row& row, std::unique_ptr<Shape> shape)
      : row_(row), shape_(std::move(shape)), box_(shape_->bounds()) {}
  [[nodiscard]] bool contains(const Vector3& point) const override {
    // Only copies whose box holds the point along the longest component of the step are asked.
    Eigen::Index axis = 0;
    const double step = std::abs(row_.step[axis_of(axis)]);
    const bool ascends = row_.step[axis] > 0.0;
    const double low = (ascends ? point[axis] - box_.upper[axis] : box_.lower[axis] - point[axis]) / step;
    const double high = (ascends ? point[axis] - box_.lower[axis] : box_.upper[axis] - point[axis]) / step;
    const auto last = static_cast<double>(row_.count - 1);
    for (double i = std::max(0.0, std::ceil(low)); i <= std::min(last, std::floor(high)); i += 1.0) {
      if (shape_->contains(point - i * row_.step)) return true;
    }
    return false;
  }
  [[nodiscard]] Bounds bounds() const override {
    const Vector3 whole = static_cast<double>(row_.count - 1) * row_.step;
    return {box_.lower + whole.cwiseMin(0.0), box_.upper + whole.cwiseMax(0.0)};
  }
  /// Returns that of the copies if their boxes do not meet.
  [[nodiscard]] double volume() const override {
    const bool apart = (row_.step.cwiseAbs().array() >= (box_.upper - box_.lower).array()).any();
    return apart ? static_cast<double>(row_.count) * shape_->volume() : counted_volume(*this);
  }
  [[nodiscard]] double smallest_extent(const Vector3& direction) const override {
    return shape_->smallest_extent(direction);
  }
  void visit(const std::function<void(const Shape&)>& f) const override {
    f(*this);
    shape_->visit(f);
  }
  [[nodiscard]] std::string toml() const override { return holder_as_toml(name, row_, *shape_); }

 private:
  Eigen::Index axis_of(Eigen::Index& axis) const {
    row_.step.cwiseAbs().maxCoeff(&axis);
    return axis;
  }

  Row row_;
  std::unique_ptr<Shape> shape_;
  Bounds box_;
};

}  // namespace whipple::cases
