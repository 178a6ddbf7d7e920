// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "src/case/shapes/filling.hpp"
#include "src/case/shapes/made.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/solids/cells.hpp"

namespace whipple::cases {

/// Selects the cells of a foam.
enum class FoamStructure : std::uint8_t { kelvin, voronoi };
constexpr std::array<Word<FoamStructure>, 2> words(FoamStructure) {
  return {{{FoamStructure::kelvin, "kelvin"}, {FoamStructure::voronoi, "voronoi"}}};
}
/// Selects what of the cells is solid.
enum class FoamForm : std::uint8_t { open, closed };
constexpr std::array<Word<FoamForm>, 2> words(FoamForm) {
  return {{{FoamForm::open, "open"}, {FoamForm::closed, "closed"}}};
}

struct FoamKeys : Filling::Box {
  static constexpr const char* name = "foam";
  FoamStructure structure = FoamStructure::kelvin;
  FoamForm form = FoamForm::open;
  double cell = 1.0;
  std::int64_t seed = 1;

  static ParameterTable<FoamKeys> parameters() {
    using K = FoamKeys;
    ParameterTable<K> table = Filling::Box::parameters<K>();
    table.push_back(
        choice("structure", &K::structure,
               "cells: truncated octahedra, in rows | cells of random seeds, none nearer to another than "
               "0.7 of 'cell'"));
    table.push_back(
        choice("form", &K::form, "struts along the edges of the cells | walls between the cells"));
    table.push_back(
        real("cell", &K::cell, "m", range::positive(), "size of a cell: the cube root of its volume"));
    table.push_back(
        integer("seed", &K::seed, range::between(0, 1e15), "selects one of many random foams").optional());
    return table;
  }
};

/// Describes a foam of open or closed cells. Struts are the points near two faces of their cell, which gives them the
/// concave triangles of real struts as sections; walls are the points near one.
class Foam final : public Filling, public Made<Foam, FoamKeys> {
 public:
  static constexpr const char* name = FoamKeys::name;
  static constexpr const char* summary = "foam with a relative density";

  Foam(const FoamKeys& keys, const std::filesystem::path& /*folder*/)
      : Filling(keys),
        keys_(keys),
        cells_(keys.structure == FoamStructure::kelvin
                   ? solids::kelvin_seeds(keys.lower, keys.upper, keys.cell)
                   : solids::random_seeds(keys.lower, keys.upper, keys.cell,
                                          static_cast<std::uint64_t>(keys.seed)),
               keys.cell) {
    calibrate();
  }
  /// Returns the thickness of a wall, and of a strut about twice the distance of its corners from the faces.
  [[nodiscard]] double smallest_extent(const Vector3&) const override { return 2.0 * threshold(); }
  [[nodiscard]] std::string toml() const override { return shape_as_toml(keys_); }
  [[nodiscard]] bool may_hold(const Vector3& point, double radius) const override {
    return cells_.near(point, radius, threshold()) > (keys_.form == FoamForm::closed ? 1 : 2);
  }

 private:
  [[nodiscard]] double level(const Vector3& point) const override {
    const solids::Cells::Distances to = cells_.distances(point);
    return keys_.form == FoamForm::closed ? to.face : to.second;
  }

  FoamKeys keys_;
  solids::Cells cells_;
};

}  // namespace whipple::cases
