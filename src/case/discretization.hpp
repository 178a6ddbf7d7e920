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
  adaptive,  ///< elements that are converted to particles
  bars,
};
constexpr std::array<Word<Representation>, 4> words(Representation) {
  return {{{Representation::particles, "particles"},
           {Representation::finite_elements, "finite_elements"},
           {Representation::adaptive, "adaptive"},
           {Representation::bars, "bars"}}};
}

/// Describes the discretization of a body: particles, finite elements, or elements that are converted to particles.
struct Discretization {
  Representation method = Representation::particles;
  // For particles.
  std::int64_t per_cell = 8;
  Arrangement lattice = Arrangement::regular;
  bool partial_volumes = false;
  bool partial_volumes_given = false;  ///< given in the case file; otherwise set by `choose_volumes`
  // For elements.
  double element_size = std::numeric_limits<double>::infinity();  ///< m; infinite: the cell size
  fem::Quadrature element = fem::Quadrature::one_point;
  fem::HourglassControl::Kind hourglass = fem::HourglassControl::Kind::stiffness;
  double hourglass_coefficient = 0.05;
  std::string mesh;        ///< mesh file instead of a shape; absolute path
  double mesh_unit = 1.0;  ///< m per unit of its coordinates
  std::string group;       ///< group in the mesh file; empty: the only one
  // For bars.
  double bar_diameter = 0.0;                                            ///< m
  double bar_failure_strain = std::numeric_limits<double>::infinity();  ///< plastic

  static ParameterTable<Discretization> parameters();
  /// Records which keys are given, and makes the path of a mesh absolute.
  void read_rest(input::Table& table);
  /// Adds faults if the rest of the case is incompatible with elements or bars.
  void check(const Case& setup, const Faults& faults) const;

  [[nodiscard]] bool has_particles() const { return method == Representation::particles; }
  /// Returns whether the body has hexahedra.
  [[nodiscard]] bool has_elements() const { return method == Representation::finite_elements || converts(); }
  [[nodiscard]] bool is_bars() const { return method == Representation::bars; }
  [[nodiscard]] bool converts() const { return method == Representation::adaptive; }
  /// Returns the edge of the elements, m.
  [[nodiscard]] double size(double cell_size) const;
};

/// Describes `conversion` of an adaptive body: thresholds beyond which an element is converted to particles.
struct Conversion {
  double plastic_strain = std::numeric_limits<double>::infinity();
  double time_step_ratio = 0.2;
  double jacobian = 0.2;
  bool failed = true;
  static ParameterTable<Conversion> parameters();
};

/// Selects the treatment of an element that leaves its valid range.
enum class BeyondRange : std::uint8_t {
  particles,  ///< it is converted to particles: nothing is lost
  remove,     ///< it is deleted; its mass, momentum and energy count as outflow
  stop,       ///< the run stops with the id of the element
};
constexpr std::array<Word<BeyondRange>, 3> words(BeyondRange) {
  return {
      {{BeyondRange::particles, "particles"}, {BeyondRange::remove, "remove"}, {BeyondRange::stop, "stop"}}};
}

/// Selects whether pieces that deletion has parted from each other touch each other.
enum class PieceContact : std::uint8_t {
  none,    ///< all of them have the velocity field of the body
  fields,  ///< all but the largest have fields of their own
};
constexpr std::array<Word<PieceContact>, 2> words(PieceContact) {
  return {{{PieceContact::none, "none"}, {PieceContact::fields, "fields"}}};
}

/// Describes `element_range` of a body with elements: the range in which an element is a valid approximation.
struct ElementRange {
  BeyondRange beyond = BeyondRange::particles;
  double jacobian = 0.05;
  double time_step_ratio = 0.02;
  double hourglass_share = std::numeric_limits<double>::infinity();
  double speed = std::numeric_limits<double>::infinity();  ///< m/s
  double plastic_strain = std::numeric_limits<double>::infinity();
  bool failed = false;
  PieceContact pieces = PieceContact::none;
  static ParameterTable<ElementRange> parameters();
};

/// Describes one `node_condition` of a body: a velocity boundary condition of nodes along some axes.
struct NodeCondition {
  Vector3 lower = Vector3::Zero();  ///< m, corners of the box that contains the nodes initially
  Vector3 upper = Vector3::Zero();
  std::vector<std::string> directions;
  Vector3 velocity = Vector3::Zero();  ///< m/s
  static ParameterTable<NodeCondition> parameters();
};

/// Describes one `bar` of a body of bars: a row of parallel bars. Ends at one place of an axisymmetric section are a hoop.
struct BarRow {
  Vector3 from = Vector3::Zero();  ///< m
  Vector3 to = Vector3::Zero();    ///< m
  std::int64_t count = 1;
  Vector3 step = Vector3::Zero();  ///< m, offset from one bar to the next
  double number = 1.0;             ///< in two dimensions: of such bars in the depth of the section
  static ParameterTable<BarRow> parameters();
};

}  // namespace whipple::cases
