// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/grid/geometry.hpp"

/// What nodes hold, and lists and values that go with their blocks.
namespace whipple::grid {

/// Sums over the points that reach a node (SI): between particles_to_grid and the grid update.
struct NodeSums {
  Lanes mass_and_momentum;  ///< kg, kg m/s
  Lanes sound_and_force;    ///< mass times sound speed (kg m/s), N
  [[nodiscard]] double mass() const { return mass_and_momentum[0]; }
  [[nodiscard]] double sound() const { return sound_and_force[0]; }
  [[nodiscard]] Vector3 momentum() const {
    return {mass_and_momentum[1], mass_and_momentum[2], mass_and_momentum[3]};
  }
  [[nodiscard]] Vector3 force() const { return {sound_and_force[1], sound_and_force[2], sound_and_force[3]}; }
};

/// Motion of a node in a step (SI): from the grid update on.
struct NodeMotion {
  Lanes velocity_and_relaxation;  ///< m/s at the start of the step; beta (docs/theory/mpm.md, 4)
  Lanes increment_and_heat;       ///< m/s, of the velocity; J/kg that contact gives to the points around
  [[nodiscard]] Vector3 velocity() const {
    return {velocity_and_relaxation[0], velocity_and_relaxation[1], velocity_and_relaxation[2]};
  }
  [[nodiscard]] double relaxation() const { return velocity_and_relaxation[3]; }
  [[nodiscard]] Vector3 increment() const {
    return {increment_and_heat[0], increment_and_heat[1], increment_and_heat[2]};
  }
  [[nodiscard]] double heat() const { return increment_and_heat[3]; }
  /// Mass (kg) that the grid update leaves in the place of the heat, for contact to take.
  [[nodiscard]] double mass_for_contact() const { return increment_and_heat[3]; }
  void set_relaxation(double beta) { velocity_and_relaxation[3] = beta; }
  void set_heat(double heat) { increment_and_heat[3] = heat; }
  void accelerate(const Vector3& change) {
    increment_and_heat += Lanes{change[0], change[1], change[2], 0.0};
  }
};

/// Scalars of a node, such as capacity and temperature in conduction: sums over points, and values kept meanwhile.
struct NodeScalars {
  Lanes sums;
  Lanes kept;
};

/// The registers of a node, whatever they hold: for what treats all alike.
struct NodeRegisters {
  Lanes first;
  Lanes second;
};

/// A node holds one of these at a time; who reads it says which. (Compilers that define reading another member of a
/// union than was written, as GCC does, make one of the other without a copy.)
union alignas(64) Node {
  NodeRegisters registers;
  NodeSums sums;
  NodeMotion motion;
  NodeScalars scalars;
};
static_assert(sizeof(Node) == 64);

/// Values that go with the contact slots of a grid: those of slot number c stand from begin[c] to begin[c +
/// 1].
struct ContactValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// Values that go with all blocks of nodes of some slots, of which every rank that works with them knows as
/// many: those of slot s stand from begin[s] to begin[s + 1].
struct SlotValues {
  std::vector<Lanes> values;
  std::vector<std::uint32_t> begin;
};

/// A node beyond a mirror plane and its image inside, as indices into all_nodes().
struct MirrorPair {
  std::uint32_t outside;
  std::uint32_t image;
};
constexpr std::uint32_t no_node = static_cast<std::uint32_t>(-1);
struct MirrorPlane {
  int face = 0;  ///< in the order of Geometry::boundary
  int axis = 0;
  Boundary kind = Boundary::symmetry;
  /// Pairs of fields that are continuous with their mirror images (`bond_at_planes`).
  std::vector<MirrorPair> pairs;
  std::vector<std::uint32_t> on_plane;
  /// Pairs of fields that are in contact with their mirror images.
  std::vector<MirrorPair> pairs_apart;
  std::vector<std::uint32_t> on_plane_apart;
  /// Inner nodes that particles may reach from beyond the plane: the images of some rank's `outside` nodes.
  std::vector<std::uint32_t> near;
  [[nodiscard]] double outward() const { return face % 2 == 0 ? -1.0 : 1.0; }
};

}  // namespace whipple::grid
