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
  fixed,   ///< fixed in space
  moving,  ///< moving with the particle that is initially nearest
};
constexpr std::array<Word<GaugeKind>, 2> words(GaugeKind) {
  return {{{GaugeKind::fixed, "fixed"}, {GaugeKind::moving, "moving"}}};
}

/// Describes a location whose state is written over time.
struct Gauge {
  std::string name;
  GaugeKind kind = GaugeKind::fixed;
  Vector3 position = Vector3::Zero();  ///< m, at the start

  static ParameterTable<Gauge> parameters();
  void check(const Case& setup, const Faults& faults) const;

  [[nodiscard]] bool moving() const { return kind == GaugeKind::moving; }
};

/// Describes moving gauges at equal distances on a line.
struct Tracers {
  std::string name;  ///< prefix of the gauge names, followed by _1, _2, ...
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< m
  std::int64_t count = 2;

  static ParameterTable<Tracers> parameters();
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the gauges on the line.
  [[nodiscard]] std::vector<Gauge> gauges() const;
};

/// Adds a fault for a name that cannot be that of columns.
void check_name_of_gauge(const std::string& name, const Faults& faults);

/// Projects gauges and tracers of a case written in three dimensions onto its section: to z = 0, in axisymmetry to
/// their distance from the axis.
void lay_into_section(std::vector<Gauge>& gauges, std::vector<Tracers>& tracers, grid::Dimension dimension);

/// Adds a fault for each gauge outside of the domain, and for each moving gauge outside of all material. Requires
/// geometry and shapes.
void check_places_of_gauges(const Case& setup, const Faults& faults);

}  // namespace whipple::cases
