// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "src/core/base/parameter_table.hpp"
#include "src/core/input/document.hpp"
#include "src/grid/geometry.hpp"

namespace whipple::cases {

/// A place whose state is written over time.
struct Gauge {
  std::string name;
  std::string kind = "fixed";  ///< "fixed" in space, or "moving" with the particle nearest to it at the start
  Vector3 position = Vector3::Zero();  ///< m, at the start
  static ParameterTable<Gauge> parameters();

  [[nodiscard]] bool moving() const { return kind == "moving"; }
};

/// Moving gauges at equal distances on a line.
struct Tracers {
  std::string name;                                      ///< of the gauges, with _1, _2, ...
  Vector3 from = Vector3::Zero(), to = Vector3::Zero();  ///< m
  std::int64_t count = 2;
  static ParameterTable<Tracers> parameters();
};

/// What a case asks to be recorded.
struct Gauges {
  std::vector<Gauge> points;     ///< [[gauge]]
  std::vector<Tracers> tracers;  ///< [[tracers]]

  /// All gauges, those of the tracers last.
  [[nodiscard]] std::vector<Gauge> all() const;
  /// As it stands in a case file.
  [[nodiscard]] std::string toml() const;
};

/// Reads [[gauge]] and [[tracers]]; errors of names and numbers are those of the document.
Gauges read_gauges(input::Table& root);

/// Reports at its table each gauge that cannot be: outside of the domain, or moving and where no matter is.
/// @param in_matter  whether some body of particles or elements fills a point
void check_gauges(const Gauges& gauges, input::Table& root, const grid::Geometry& geometry,
                  const std::function<bool(const Vector3&)>& in_matter);

}  // namespace whipple::cases
