// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/case/shapes/shape.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::cases {

/// Describes a structure that fills a box up to a relative density: where a level is below a threshold. The threshold
/// is the quantile of the level at this density over quasi-random points of the box, so that the density is met
/// whatever the level is.
class Filling : public Shape {
 public:
  struct Box {
    Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
    double density = 0.1;  ///< relative to that of the solid

    template <class Owner>
    static ParameterTable<Owner> parameters() {
      return {vector<Owner>("lower", static_cast<Vector3 Owner::*>(&Owner::lower), "m", range::any(),
                            "corner of the box with the smallest coordinates")
                  .in_plane(-0.5),
              vector<Owner>("upper", static_cast<Vector3 Owner::*>(&Owner::upper), "m", range::any(),
                            "corner of the box with the largest coordinates")
                  .in_plane(0.5),
              real<Owner>("relative_density", static_cast<double Owner::*>(&Owner::density), "",
                          range::open_between(0.0, 1.0), "part of the box that is solid")};
    }
  };

  /// @throws InputError if the box is empty
  explicit Filling(const Box& box);
  [[nodiscard]] bool contains(const Vector3& point) const override {
    return (point.array() > box_.lower.array()).all() && (point.array() < box_.upper.array()).all() &&
           level(point) < threshold_;
  }
  [[nodiscard]] Bounds bounds() const override { return {box_.lower, box_.upper}; }
  [[nodiscard]] double volume() const override { return box_.density * (box_.upper - box_.lower).prod(); }
  [[nodiscard]] std::vector<std::string> account() const override;

 protected:
  /// Determines the threshold; called by the constructor of the structure.
  void calibrate();
  [[nodiscard]] double threshold() const { return threshold_; }

 private:
  [[nodiscard]] virtual double level(const Vector3& point) const = 0;

  Box box_;
  double threshold_ = 0.0;
};

}  // namespace whipple::cases
