// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "src/grid/block_grid.hpp"
#include "src/quasi_static/supports.hpp"

namespace whipple::quasi_static {

/// Describes the displacement of an active node along one direction: sign times that of an unknown, or given.
struct Component {
  std::int32_t unknown = -1;  ///< -1: given
  double sign = 1.0;
  double given = 0.0;  ///< m
};

/// Describes the displacement that the particles of a driven body give to a node.
struct Given {
  Vector3 u;  ///< m
  std::uint32_t body;
};

/// Numbers the unknown displacements of the nodes: images beyond mirror planes move as their nodes do (R u), nodes on a
/// plane do not leave it, and nodes that driven material reaches move as it does (eq. 6).
class Unknowns {
 public:
  /// @param given  of each active node, where a driven body reaches it
  /// @throws InputError if two bodies give a node different displacements
  Unknowns(const Supports& supports, const grid::BlockGrid& grid,
           std::span<const std::optional<Given>> given);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Component& of(std::size_t node, int direction) const {
    return components_[node][static_cast<std::size_t>(direction)];
  }
  /// Returns the displacements (m) of the active nodes.
  /// @param unknown       of the unknowns, m
  /// @param given_factor  of the given ones
  [[nodiscard]] std::vector<Vector3> displacements(std::span<const double> unknown,
                                                   double given_factor) const;
  /// Returns whether any given displacement differs from 0.
  [[nodiscard]] bool are_any_given() const;

 private:
  std::vector<std::array<Component, 3>> components_;
  std::size_t size_ = 0;
};

/// Returns the displacement (m) of each active node that the particles of some bodies reach.
/// @param of_body  displacement of a driven body, none for others
std::vector<std::optional<Given>> given_displacements(const Supports& supports, const Particles& particles,
                                                      std::span<const std::optional<Vector3>> of_body);

}  // namespace whipple::quasi_static
