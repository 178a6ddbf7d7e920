// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/case/artificial_viscosity.hpp"
#include "src/case/body_state.hpp"
#include "src/case/detonation.hpp"
#include "src/case/discretization.hpp"
#include "src/case/failure_grains.hpp"
#include "src/case/path.hpp"
#include "src/case/section.hpp"
#include "src/case/shapes/shape.hpp"
#include "src/core/base/tensor.hpp"
#include "src/grid/geometry.hpp"

namespace whipple::cases {

/// Selects how an equation of state is evaluated.
enum class Evaluation : std::uint8_t {
  model,  ///< directly by the model
  table,  ///< by a table of the model
};
constexpr std::array<Word<Evaluation>, 2> words(Evaluation) {
  return {{{Evaluation::model, "model"}, {Evaluation::table, "table"}}};
}

/// Selects where pressure and volume rate of a body act (docs/theory/mpm.md, 4.12 to 4.14).
enum class Volumetric : std::uint8_t {
  point,  ///< at every particle
  cell,   ///< as their means over the particles of a cell
};
constexpr std::array<Word<Volumetric>, 2> words(Volumetric) {
  return {{{Volumetric::point, "point"}, {Volumetric::cell, "cell"}}};
}

struct Body {
  std::string name;
  std::string material;  ///< file as written in the case
  Evaluation equation_of_state = Evaluation::model;
  double table_error = 1e-4;
  Vector3 velocity = Vector3::Zero();          ///< m/s
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s
  Vector3 expansion_rate = Vector3::Zero();    ///< 1/s, along the axes
  bool driven = false;
  Volumetric volumetric = Volumetric::point;
  std::string contact_group;
  Ignition ignition = Ignition::detonators;
  double detonation_velocity = std::numeric_limits<double>::infinity();  ///< m/s; infinite: not given
  Discretization discretization;
  Conversion conversion;
  ElementRange element_range;
  std::vector<NodeCondition> node_conditions;
  std::optional<Path> path;  ///< of a tool: over time, of its prescribed velocities
  std::vector<BarRow> bars;
  InitialState initial;
  Failure failure;
  FailureScatter failure_scatter;
  FailureGrains failure_grains;
  StrengthScatter strength_scatter;
  std::optional<ArtificialViscosity> viscosity;  ///< overrides that of the case
  std::shared_ptr<const Shape> shape;            ///< for bars and meshes: set by `complete`

  static ParameterTable<Body> parameters();
  static std::span<const Section<Body>> sections();
  static void add_rest(input::Schema& table);
  /// Reads the shape.
  void read_rest(input::Table& table);
  [[nodiscard]] std::string rest_to_toml() const;
  void check(const Case& setup, const Faults& faults) const;

  /// Returns the initial velocity of its centre: of a driven body that of its path.
  [[nodiscard]] Vector3 velocity_at_start() const {
    return driven && path ? path->table.at(0.0) * velocity : velocity;
  }
  /// Returns the initial velocity at a position.
  /// @param centre  of the bounding box
  [[nodiscard]] Vector3 velocity_at(const Vector3& x, const Vector3& centre) const {
    return velocity_at_start() + angular_velocity.cross(x - centre) + expansion_rate.cwiseProduct(x - centre);
  }

  /// Returns the directions in which the body is guided by mirror planes that it touches, or by the section of a plane
  /// or axisymmetric case: it is not driven in these directions.
  [[nodiscard]] std::array<bool, 3> guided_axes(const Case& setup) const;

  /// Returns whether pieces of the body that deletion has parted touch each other.
  [[nodiscard]] bool parts_touch() const { return element_range.pieces == PieceContact::fields; }
  /// Returns whether the failure thresholds of its particles differ.
  [[nodiscard]] bool varies_failure() const { return failure_scatter.given() || failure_grains.given(); }
  /// Returns the factor of the failure thresholds of a particle with this volume (m^3) at a position.
  [[nodiscard]] double failure_factor(std::uint64_t id, double volume, const Vector3& place,
                                      const grid::Geometry& geometry) const;

  /// Returns whether the shape is given by a key of the body, rather than by its bars or its mesh.
  [[nodiscard]] bool has_own_shape() const {
    return !discretization.is_bars() && discretization.mesh.empty();
  }
};

}  // namespace whipple::cases
