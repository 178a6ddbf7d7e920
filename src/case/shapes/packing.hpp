// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "src/case/shapes/made.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/solids/bins.hpp"
#include "src/solids/packing.hpp"

namespace whipple::cases {

struct PackingKeys {
  static constexpr const char* name = "packing";
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
  double radius = 1.0, spread = 0.0, fraction = 0.3;
  std::int64_t seed = 1;

  static ParameterTable<PackingKeys> parameters() {
    using K = PackingKeys;
    return {
        vector("lower", &K::lower, "m", range::any(), "corner of the box with the smallest coordinates"),
        vector("upper", &K::upper, "m", range::any(), "corner of the box with the largest coordinates"),
        real("radius", &K::radius, "m", range::positive(), "median radius of the spheres"),
        real("spread", &K::spread, "", range::between(0.0, 1.0),
             "standard deviation of the logarithm of the radii, which are cut off at 2.5 of them")
            .optional(),
        real("fraction", &K::fraction, "", range::open_between(0.0, 0.6),
             "part of the box that is filled; equal spheres reach about 0.55"),
        integer("seed", &K::seed, range::between(0, 1e15), "selects one of many random packings").optional()};
  }
};

/// Describes spheres packed at random; with `difference` also the matrix around them.
class Packing final : public Shape, public Made<Packing, PackingKeys> {
 public:
  static constexpr const char* name = PackingKeys::name;
  static constexpr const char* summary = "random packing of spheres that do not overlap, in a box";

  /// @throws InputError if the spheres do not fit
  Packing(const PackingKeys& keys, const std::filesystem::path& folder);

  [[nodiscard]] bool contains(const Vector3& point) const override {
    return !bins_.none_near(point, [&](std::uint32_t i) {
      return (balls_[i].centre - point).squaredNorm() < balls_[i].radius * balls_[i].radius;
    });
  }
  [[nodiscard]] Bounds bounds() const override { return {keys_.lower, keys_.upper}; }
  [[nodiscard]] double volume() const override { return keys_.fraction * (keys_.upper - keys_.lower).prod(); }
  [[nodiscard]] double smallest_extent(const Vector3&) const override {
    return 2.0 * std::ranges::min(balls_, {}, &solids::Ball::radius).radius;
  }
  [[nodiscard]] std::vector<std::string> account() const override;
  [[nodiscard]] std::string toml() const override { return shape_as_toml(keys_); }

 private:
  PackingKeys keys_;
  std::vector<solids::Ball> balls_;
  solids::Bins bins_;
};

}  // namespace whipple::cases
