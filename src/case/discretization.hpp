// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "src/case/section.hpp"
#include "src/core/base/tensor.hpp"
#include "src/fem/mesh.hpp"
#include "src/fem/step.hpp"
#include "src/particles/arrangement.hpp"

namespace whipple::cases {

/// Selects the discretization of a body.
enum class Representation : std::uint8_t {
  particles,
  finite_elements,
  adaptive,  ///< elements that become particles
  bars,
};
constexpr std::array<Word<Representation>, 4> words(Representation) {
  return {{{Representation::particles, "particles"},
           {Representation::finite_elements, "finite_elements"},
           {Representation::adaptive, "adaptive"},
           {Representation::bars, "bars"}}};
}

/// How a body is represented: particles, finite elements, or elements that become particles.
struct Discretization {
  Representation method = Representation::particles;
  // of particles
  std::int64_t per_cell = 8;
  Arrangement lattice = Arrangement::regular;
  bool partial_volumes = false;
  bool partial_volumes_given = false;  ///< in the case file; else `choose_volumes` decides
  // of elements
  double element_size = std::numeric_limits<double>::infinity();  ///< m; infinite: that of the cells
  fem::Quadrature element = fem::Quadrature::one_point;
  fem::HourglassControl::Kind hourglass = fem::HourglassControl::Kind::stiffness;
  double hourglass_coefficient = 0.05;
  std::string mesh;        ///< Gmsh file instead of a shape; absolute path
  double mesh_unit = 1.0;  ///< m per unit of its coordinates
  std::string group;       ///< physical group in it; empty: the only one
  // of bars
  double bar_diameter = 0.0;                                            ///< m
  double bar_failure_strain = std::numeric_limits<double>::infinity();  ///< plastic

  static ParameterTable<Discretization> parameters();
  /// Notes which keys are given, and makes the path of a mesh absolute.
  void read_rest(input::Table& table);
  /// Adds what elements and bars need of the rest of the case.
  void check(const Case& setup, const Faults& faults) const;

  [[nodiscard]] bool has_particles() const { return method == Representation::particles; }
  /// Hexahedra.
  [[nodiscard]] bool has_elements() const { return method == Representation::finite_elements || converts(); }
  [[nodiscard]] bool is_bars() const { return method == Representation::bars; }
  [[nodiscard]] bool converts() const { return method == Representation::adaptive; }
  /// Edge of the elements, m.
  [[nodiscard]] double size(double cell_size) const;
};

/// `conversion` of an adaptive body: thresholds beyond which an element becomes particles.
struct Conversion {
  double plastic_strain = std::numeric_limits<double>::infinity();
  double time_step_ratio = 0.2;
  double jacobian = 0.2;
  bool failed = true;
  static ParameterTable<Conversion> parameters();
};

/// What becomes of an element that leaves its valid range.
enum class BeyondRange : std::uint8_t {
  particles,  ///< it becomes particles: nothing is lost
  remove,     ///< it is deleted with its mass, momentum and energy, which count as outflow
  stop,       ///< the run ends with its number
};
constexpr std::array<Word<BeyondRange>, 3> words(BeyondRange) {
  return {
      {{BeyondRange::particles, "particles"}, {BeyondRange::remove, "remove"}, {BeyondRange::stop, "stop"}}};
}

/// `element_range` of a body with elements: where an element is an approximation no longer.
struct ElementRange {
  BeyondRange beyond = BeyondRange::particles;
  double jacobian = 0.05;
  double time_step_ratio = 0.02;
  double hourglass_share = std::numeric_limits<double>::infinity();
  double speed = std::numeric_limits<double>::infinity();  ///< m/s
  static ParameterTable<ElementRange> parameters();
};

/// One `node_condition` of a body: nodes whose velocity is prescribed along some axes.
struct NodeCondition {
  Vector3 lower = Vector3::Zero();  ///< m, corners of the box that the nodes lie in at the start
  Vector3 upper = Vector3::Zero();
  std::vector<std::string> directions;
  Vector3 velocity = Vector3::Zero();  ///< m/s
  static ParameterTable<NodeCondition> parameters();
};

/// One `bar` of a body of bars: a row of parallel ones.
struct BarRow {
  Vector3 from = Vector3::Zero();  ///< m
  Vector3 to = Vector3::Zero();    ///< m
  std::int64_t count = 1;
  Vector3 step = Vector3::Zero();  ///< m, from one to the next
  static ParameterTable<BarRow> parameters();
};

}  // namespace whipple::cases
