// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "src/case/section.hpp"
#include "src/core/base/tensor.hpp"
#include "src/grid/geometry.hpp"

namespace whipple::cases {

enum class GaugeKind : std::uint8_t {
  fixed,   ///< in space
  moving,  ///< with the particle nearest to it at the start
};
constexpr std::array<Word<GaugeKind>, 2> words(GaugeKind) {
  return {{{GaugeKind::fixed, "fixed"}, {GaugeKind::moving, "moving"}}};
}

/// A place whose state is written over time.
struct Gauge {
  std::string name;
  GaugeKind kind = GaugeKind::fixed;
  Vector3 position = Vector3::Zero();  ///< m, at the start

  static ParameterTable<Gauge> parameters();
  void check(const Case& setup, const Faults& faults) const;

  [[nodiscard]] bool moving() const { return kind == GaugeKind::moving; }
};

/// Moving gauges at equal distances on a line.
struct Tracers {
  std::string name;                                      ///< of the gauges, with _1, _2, ...
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< m
  std::int64_t count = 2;

  static ParameterTable<Tracers> parameters();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the gauges on the line.
  [[nodiscard]] std::vector<Gauge> gauges() const;
};

/// Lays gauges and tracers of a case that was written in three dimensions into its section: at z = 0, in axisymmetry
/// at their distance from the axis.
void lay_into_section(std::vector<Gauge>& gauges, std::vector<Tracers>& tracers, grid::Dimension dimension);

/// Adds each gauge that cannot be: outside of the domain, or moving and where no material is. For a case with
/// geometry and shapes.
void check_places_of_gauges(const Case& setup, const Faults& faults);

}  // namespace whipple::cases
