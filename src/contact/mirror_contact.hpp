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

/// Contact of material with its own image beyond mirror planes and walls, where it is not one with it
/// (grid::BlockGrid::bond_at_planes): the image is another body with the reflected nodes (docs/theory/mpm.md,
/// equations 3.7 to 3.12). Material that flies towards a plane does not act on it before it touches.
///
/// A node and its mirror node may belong to different ranks. Every rank that works with either has both
/// active, and computes the contact of the two as the others do, from what their owners tell it.
class MirrorContact {
 public:
  /// Computes the extent of the material at the nodes near the planes, from particles and from off-grid
  /// points, which have no thickness. Call after `bin` and `separate_fields`; does nothing where all material
  /// is continuous with its images. Collective.
  void find_surfaces(transfer::ShapeFunction shape, const Particles& particles,
                     std::span<const Vector3> guests, grid::BlockGrid& grid, double dt);

  /// Tells what touches its image from now on; must outlive the calls.
  void watch(FirstTouches& touches) { touches_ = &touches; }

  /// Numbers the nodes near the planes; only what changed since the last call is done.
  void lay_out(const grid::BlockGrid& grid);
  /// Returns whether a block of nodes contains nodes near the planes.
  [[nodiscard]] bool concerns_block(std::size_t block) const {
    return !first_of_block_.empty() && first_of_block_[block] != nowhere;
  }
  /// Keeps the step that the nodes of this rank take by themselves, with their mass
  /// (NodeMotion::mass_for_contact), which it clears where there is no contact of bodies.
  void remember(grid::BlockGrid& grid);
  /// Tells the other ranks what was remembered. Collective.
  void tell_others(grid::BlockGrid& grid);
  /// Changes velocities, increments and relaxation of the nodes that touch their images, and adds the heat of
  /// that to NodeMotion::heat.
  void apply(grid::BlockGrid& grid, double dt, transfer::Nodes which);
  /// Applies contact to NodeMotion::velocity, with the mass in its last lane: material and image are in
  /// contact for the fractions that `apply` found in this step, or, before it, for those that follow from
  /// their approach.
  void apply_to_velocities(grid::BlockGrid& grid, transfer::Nodes which);

  [[nodiscard]] bool made_heat() const { return made_heat_; }
  /// J/kg, by the last `apply`; 0 where it does nothing.
  [[nodiscard]] double heat_at(std::uint32_t node) const {
    return concerns_block(node / grid::nodes_per_block) ? heat_[place(node) / lanes_per_node] : 0.0;
  }

 private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t lanes_per_node = 2;
  /// A node and its mirror node; the same one twice on the plane.
  struct Couple {
    std::uint32_t node, mirror;
    /// Does the node lie on the opposite plane, where material is one with its image? It does not move across it.
    bool is_held = false;
  };
  struct Plane {
    grid::MirrorPlane of;  // without its lists
    grid::Boundary opposite = grid::Boundary::outflow;
    std::vector<Couple> couples;
    std::vector<double> share;  // of the step, that the two touch in: of each couple
    /// Those of nodes that other planes concern too: up to eight nodes have images of one another.
    std::vector<std::uint32_t> at_corners;
  };
  [[nodiscard]] std::size_t place(std::uint32_t node) const {
    return first_of_block_[node / grid::nodes_per_block] + lanes_per_node * (node % grid::nodes_per_block);
  }
  [[nodiscard]] double gap(const Plane& plane, const Couple& couple) const;
  [[nodiscard]] bool sticks(const Plane& plane, double gap) const;
  [[nodiscard]] static Lanes part_of_node(const Plane& plane, const Couple& couple, double mass,
                                          double other_mass);
  void join_relaxation_at_corners(grid::BlockGrid& grid, transfer::Nodes which);
  double meet(const Plane& plane, const Couple& couple, std::span<grid::Node> nodes, double dt);
  template <class Shape>
  void extend(const Particles& particles, std::span<const Vector3> guests, grid::BlockGrid& grid);

  std::size_t layout_ = static_cast<std::size_t>(-1);  // of the grid
  double cell_size_ = 0.0;                             // m
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> first_of_block_;  // of each block of nodes: place of its first node's values
  std::vector<std::uint8_t> coupled_;          // of each block of nodes: are there couples in it?
  std::vector<std::uint8_t> near_;             // of each slot: may its points reach such blocks?
  std::vector<Couple> folded_;                 // nodes that other planes fold, and their images: in the order
                                               // in which they are copied back
  /// Extent (m) of the material that reaches each node beyond the planes along x, y, z (negative: in front of
  /// them), first of the lower faces, then of the upper ones.
  grid::SlotValues extent_;
  /// Step that each node takes without contact, as Node; lane 3 of `first` is its mass.
  grid::SlotValues own_;
  std::vector<double> heat_;        // J/kg, of each node
  std::vector<double> joint_mass_;  // kg, scratch
  bool made_heat_ = false;
  FirstTouches* touches_ = nullptr;
  bool shares_known_ = false;  // in this step
  double dt_ = 0.0;            // s, of this step
};

}  // namespace whipple::contact
