// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "src/case/shapes/filling.hpp"
#include "src/case/shapes/made.hpp"
#include "src/case/shapes/primitive.hpp"

namespace whipple::cases {

/// Selects a periodic minimal surface by its nodal approximation.
enum class Minimal : std::uint8_t { gyroid, primitive, diamond };
constexpr std::array<Word<Minimal>, 3> words(Minimal) {
  return {{{Minimal::gyroid, "gyroid"}, {Minimal::primitive, "primitive"}, {Minimal::diamond, "diamond"}}};
}
/// Selects what is solid: a sheet along the surface, or one of the two spaces that it parts.
enum class Side : std::uint8_t { sheet, skeleton };
constexpr std::array<Word<Side>, 2> words(Side) {
  return {{{Side::sheet, "sheet"}, {Side::skeleton, "skeleton"}}};
}

struct MinimalSurfaceKeys : Filling::Box {
  static constexpr const char* name = "lattice";
  Minimal kind = Minimal::gyroid;
  Side form = Side::sheet;
  double cell = 1.0;

  static ParameterTable<MinimalSurfaceKeys> parameters() {
    using K = MinimalSurfaceKeys;
    ParameterTable<K> table = Filling::Box::parameters<K>();
    table.push_back(
        choice("kind", &K::kind,
               "sin x cos y + sin y cos z + sin z cos x | cos x + cos y + cos z | cos x cos y cos z - sin "
               "x sin y sin z, with x = 2 pi (distance from 'lower')/cell"));
    table.push_back(choice("form", &K::form, "solid along the surface | on one side of it").optional());
    table.push_back(real("cell", &K::cell, "m", range::positive(), "period along the axes"));
    return table;
  }
};

/// Describes a periodic lattice printed along a minimal surface.
class MinimalSurface final : public Filling, public Made<MinimalSurface, MinimalSurfaceKeys> {
 public:
  static constexpr const char* name = MinimalSurfaceKeys::name;
  static constexpr const char* summary = "periodic lattice along a minimal surface";

  MinimalSurface(const MinimalSurfaceKeys& keys, const std::filesystem::path& /*folder*/)
      : Filling(keys), keys_(keys) {
    calibrate();
  }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(keys_); }

 private:
  [[nodiscard]] double level(const Vector3& point) const override {
    const Vector3 x = 2.0 * std::numbers::pi / keys_.cell * (point - keys_.lower);
    const Vector3 s = x.array().sin(), c = x.array().cos();
    double value = 0.0;
    switch (keys_.kind) {
      case Minimal::gyroid:
        value = s[0] * c[1] + s[1] * c[2] + s[2] * c[0];
        break;
      case Minimal::primitive:
        value = c.sum();
        break;
      case Minimal::diamond:
        value = c.prod() - s.prod();
        break;
    }
    return keys_.form == Side::sheet ? std::abs(value) : -value;
  }

  MinimalSurfaceKeys keys_;
};

}  // namespace whipple::cases
