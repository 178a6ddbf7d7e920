// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/base/vector_math.hpp"
#include "src/grid/block_grid.hpp"

namespace whipple::transfer {

/// Nodes that an exchange between ranks divides: those that await results of other ranks
/// (grid::BlockGrid::is_awaited), and the others.
enum class Nodes : std::uint8_t { awaited, others };

/// Returns whether a node is among them; the same for a node and its mirror node.
inline bool is_among(const grid::BlockGrid& grid, std::uint32_t node, Nodes nodes) {
  return grid.is_awaited(node) == (nodes == Nodes::awaited);
}

/// Mirror planes and walls at which material is continuous with its image (docs/theory/mpm.md, 3): contributions of particles
/// beyond a plane are folded to the inside, and velocities are copied back. Elsewhere material is in contact with its
/// image (contact::MirrorContact).
class MirrorPlanes {
 public:
  /// Sets whether the nodes of contact slots are remembered as well, whose impulses `for_each_impulse` then visits.
  void remember_contact(bool also) { also_contact_ = also; }
  /// Stores the contributions of the particles of this rank to the nodes near the planes before they are folded.
  void remember(const grid::BlockGrid& grid, Nodes which);
  /// Folds every plane and restricts the nodes on it.
  static void fold(grid::BlockGrid& grid, Nodes which, grid::BlockGrid::Part part);
  /// Sets the velocities beyond the planes to the reflected ones.
  static void copy_back(grid::BlockGrid& grid, Nodes which);
  /// Sets the values of the images beyond the planes (lanes 0 to 2) to the reflected ones.
  static void copy_to_images(const grid::BlockGrid& grid, std::span<Lanes> of_node);
  /// Sets the increments of the velocity (m/s, lanes 0 to 2) of all nodes by local damping, whose impulses are not those
  /// of planes or contact; empty: none. They must stay until the impulses have been asked for.
  void set_damping(std::span<const Lanes> increment) { damping_ = increment; }
  /// Returns the impulse (N s) of local damping on the particles of this rank at the nodes near planes, in a step.
  [[nodiscard]] Vector3 damping_impulse(const grid::BlockGrid& grid, Nodes which) const;
  /// Returns the impulse (N s) that the planes gave to the particles of this rank in a step (3.6), after it.
  [[nodiscard]] Vector3 impulse(const grid::BlockGrid& grid, Nodes which, double dt) const;
  /// Calls f(node, impulse) for every remembered node that planes or contact may have changed, one after the other:
  /// impulse (N s, lanes 0 to 2) of both on the particles of this rank, in a step, after it.
  template <class Function>
  void for_each_impulse(const grid::BlockGrid& grid, Nodes which, double dt, const Function& f) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (is_among(grid, nodes_[i], which)) f(nodes_[i], impulse_at(grid, i, dt));
    }
  }
  /// Adds to a sum, node by node, the mass contributed by particles times value(node).
  template <class Value>
  void add_by_mass(const grid::BlockGrid& grid, Nodes which, const Value& value, double& sum) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (kind_[i].at_plane && is_among(grid, nodes_[i], which))
        sum += before_[i].sums.mass() * value(nodes_[i]);
    }
  }

 private:
  /// Describes what may change a node.
  struct Kind {
    bool at_plane;          ///< a plane; otherwise contact of bodies alone
    bool may_be_unchanged;  ///< it is only an image or in a contact slot, and may have received nothing
  };

  void find_nodes(const grid::BlockGrid& grid);
  [[nodiscard]] Lanes damping_at(std::size_t i) const;
  [[nodiscard]] Lanes impulse_at(const grid::BlockGrid& grid, std::size_t i, double dt) const;

  bool also_contact_ = false;
  std::span<const Lanes> damping_;
  std::vector<std::uint32_t> nodes_;                   // that the planes may change, ascending
  std::vector<Kind> kind_;                             // of each
  std::size_t layout_ = static_cast<std::size_t>(-1);  // of the grid that they belong to
  std::vector<grid::Node> before_;                     // their content before the fold
};

}  // namespace whipple::transfer
