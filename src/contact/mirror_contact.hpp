// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "src/contact/first_touches.hpp"
#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/mirror_planes.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::contact {

/// Computes the contact of material with its own image beyond mirror planes and walls where it is not continuous with
/// it (grid::BlockGrid::bond_at_planes): the image is another body at the reflected nodes (docs/theory/mpm.md,
/// equations 3.7 to 3.13). Material that moves towards a plane does not interact with it before contact.
///
/// A node and its mirror node may belong to different ranks. Every rank that uses either has both active and computes
/// their contact redundantly from the values of their owners.
class MirrorContact {
 public:
  /// Computes the extent of the material at the nodes near the planes, from particles and from off-grid
  /// points, which have no thickness. Call after `bin` and `separate_fields`; does nothing where all material
  /// is continuous with its images. Collective.
  void find_surfaces(transfer::ShapeFunction shape, const Particles& particles,
                     std::span<const Vector3> guests, grid::BlockGrid& grid, double dt);

  /// Registers a recorder of contacts with images; it must outlive all later calls.
  void watch(FirstTouches& touches) { touches_ = &touches; }

  /// Numbers the nodes near the planes; does nothing if the layout of the grid has not changed since the last call.
  void lay_out(const grid::BlockGrid& grid);
  /// Returns whether a block of nodes contains nodes near the planes.
  [[nodiscard]] bool concerns_block(std::size_t block) const {
    return !first_of_block_.empty() && first_of_block_[block] != nowhere;
  }
  /// Stores the uncoupled motion of this rank's nodes with their mass (NodeMotion::mass_for_contact), and clears the
  /// latter where no bodies are in contact.
  void remember(grid::BlockGrid& grid);
  /// Sends the stored motion to the other ranks. Collective.
  void tell_others(grid::BlockGrid& grid);
  /// Changes velocities, increments and relaxations of the nodes that are in contact with their images, and adds the
  /// contact dissipation to NodeMotion::heat.
  void apply(grid::BlockGrid& grid, double dt, transfer::Nodes which);
  /// Applies contact to NodeMotion::velocity, with the mass in its last lane. The contact fractions are those that
  /// `apply` found in this step or, before it, those that follow from the approach velocities.
  void apply_to_velocities(grid::BlockGrid& grid, transfer::Nodes which);

  [[nodiscard]] bool made_heat() const { return made_heat_; }
  /// Returns the contact dissipation of a node by the last `apply`, J/kg; 0 where it does not act.
  [[nodiscard]] double heat_at(std::uint32_t node) const {
    return concerns_block(node / grid::nodes_per_block) ? heat_[place(node) / lanes_per_node] : 0.0;
  }

 private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t lanes_per_node = 2;
  /// Holds a node and its mirror node; both are the same node on the plane.
  struct Couple {
    std::uint32_t node, mirror;
    double cell_size;  ///< of their level, m
    /// Whether the node is on the opposite plane with whose image the material is continuous: it does not move across
    /// that plane.
    bool is_held = false;
  };
  struct Plane {
    grid::MirrorPlane of;  // without its lists of nodes
    grid::Boundary opposite = grid::Boundary::outflow;
    std::vector<Couple> couples;
    std::vector<double> share;  // of each couple: fraction of the step in contact
    /// Indices of the couples whose nodes other planes also affect: up to eight nodes are images of each other.
    std::vector<std::uint32_t> at_corners;
  };
  [[nodiscard]] std::size_t place(std::uint32_t node) const {
    return first_of_block_[node / grid::nodes_per_block] + lanes_per_node * (node % grid::nodes_per_block);
  }
  [[nodiscard]] double gap(const Plane& plane, const Couple& couple) const;
  void add_heat(grid::NodeMotion& motion, std::uint32_t node, double heat);
  [[nodiscard]] static bool sticks(const Plane& plane, const Couple& couple, double gap);
  [[nodiscard]] static Lanes part_of_node(const Plane& plane, const Couple& couple, double mass,
                                          double other_mass);
  void join_relaxation_at_corners(grid::BlockGrid& grid, transfer::Nodes which);
  double meet(const Plane& plane, const Couple& couple, std::span<grid::Node> nodes, double dt);
  template <class Shape>
  void extend(const Particles& particles, std::span<const Vector3> guests, grid::BlockGrid& grid);

  std::size_t layout_ = static_cast<std::size_t>(-1);  // of the grid
  double friction_ = 0.0;                              // of walls of kind `friction`
  std::vector<Plane> planes_;
  // Index of the values of the first node of each block of nodes
  std::vector<std::uint32_t> first_of_block_;
  std::vector<std::uint8_t> coupled_;  // of each block of nodes: 1 if it contains couples
  std::vector<std::uint8_t> near_;     // of each slot: 1 if its points may reach such blocks
  // Nodes beyond planes with continuity, and their images: in the order in which they are copied back
  std::vector<grid::MirrorPair> folded_;
  /// Extent (m) beyond the planes, along x, y, z, of the material that reaches each node (negative: in front of them):
  /// first for the lower faces, then for the upper ones.
  grid::SlotValues extent_;
  /// Uncoupled velocity and increment of each node, as in NodeMotion; lane 3 of the velocity holds its mass, kg.
  grid::SlotValues own_;
  std::vector<double> heat_;        // of each node, J/kg
  std::vector<double> joint_mass_;  // kg, scratch
  bool made_heat_ = false;
  FirstTouches* touches_ = nullptr;
  bool shares_known_ = false;  // by `apply` in this step
  double dt_ = 0.0;            // s, of this step
};

}  // namespace whipple::contact
