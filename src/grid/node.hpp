// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/grid/geometry.hpp"

/// Contents of nodes; lists and values that belong to their blocks.
namespace whipple::grid {

/// Holds sums over the points that reach a node (SI units): between particles_to_grid and the grid update.
struct NodeSums {
  Lanes mass_and_momentum;  ///< kg; kg m/s
  Lanes sound_and_force;    ///< mass times sound speed, kg m/s; N
  [[nodiscard]] double mass() const { return mass_and_momentum[0]; }
  [[nodiscard]] double sound() const { return sound_and_force[0]; }
  [[nodiscard]] Vector3 momentum() const {
    return {mass_and_momentum[1], mass_and_momentum[2], mass_and_momentum[3]};
  }
  [[nodiscard]] Vector3 force() const { return {sound_and_force[1], sound_and_force[2], sound_and_force[3]}; }
};

/// Holds the motion of a node in a step (SI units): after the grid update.
struct NodeMotion {
  /// Velocity at the start of the step, m/s; beta (docs/theory/mpm.md, equation 3.5).
  Lanes velocity_and_relaxation;
  /// Increment of the velocity, m/s; contact dissipation for the surrounding points, J/kg.
  Lanes increment_and_heat;
  [[nodiscard]] Vector3 velocity() const {
    return {velocity_and_relaxation[0], velocity_and_relaxation[1], velocity_and_relaxation[2]};
  }
  [[nodiscard]] double relaxation() const { return velocity_and_relaxation[3]; }
  [[nodiscard]] Vector3 increment() const {
    return {increment_and_heat[0], increment_and_heat[1], increment_and_heat[2]};
  }
  [[nodiscard]] double heat() const { return increment_and_heat[3]; }
  /// Returns the mass (kg), which the grid update stores in the place of the heat for use by contact.
  [[nodiscard]] double mass_for_contact() const { return increment_and_heat[3]; }
  void set_relaxation(double beta) { velocity_and_relaxation[3] = beta; }
  void set_heat(double heat) { increment_and_heat[3] = heat; }
  void accelerate(const Vector3& change) {
    increment_and_heat += Lanes{change[0], change[1], change[2], 0.0};
  }
};

/// Holds scalars of a node, such as capacity and temperature in heat conduction: sums over points, and values kept
/// during the summation.
struct NodeScalars {
  Lanes sums;
  Lanes kept;
};

/// Gives untyped access to the registers of a node, for operations that treat all contents alike.
struct NodeRegisters {
  Lanes first;
  Lanes second;
};

/// Holds one of these contents at a time, as determined by the stage of the step. (With compilers that define reading a
/// union member other than the one written, such as GCC, one content replaces the other without a copy.)
union alignas(64) Node {
  NodeRegisters registers;
  NodeSums sums;
  NodeMotion motion;
  NodeScalars scalars;
};
static_assert(sizeof(Node) == 64);

/// Holds values of the contact slots of a grid; those of contact slot c are at begin[c] to begin[c + 1].
struct ContactValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// Holds values of all blocks of nodes of some slots, with the same number on every rank that uses the slot; those of
/// slot s are at begin[s] to begin[s + 1].
struct SlotValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// Connects a node beyond a mirror plane and its image inside, as indices into all_nodes().
struct MirrorPair {
  std::uint32_t outside;
  std::uint32_t image;
};
constexpr std::uint32_t no_node = static_cast<std::uint32_t>(-1);
struct MirrorPlane {
  int face = 0;  ///< in the order of Geometry::boundary
  int axis = 0;
  Boundary kind = Boundary::symmetry;
  /// Node pairs of fields that are continuous with their mirror images (`bond_at_planes`).
  std::vector<MirrorPair> pairs;
  std::vector<std::uint32_t> on_plane;
  /// Node pairs of fields that are in contact with their mirror images.
  std::vector<MirrorPair> pairs_apart;
  std::vector<std::uint32_t> on_plane_apart;
  /// Inner nodes within the reach of stencils across the plane: the images of `outside` nodes of any rank.
  std::vector<std::uint32_t> near;
  [[nodiscard]] double outward() const { return face % 2 == 0 ? -1.0 : 1.0; }
};

}  // namespace whipple::grid
