// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "src/device/contact/reach.hpp"
#include "src/device/contact/thickness.hpp"
#include "src/device/lattice.hpp"
#include "src/device/points.hpp"

/// Nodes near faces of the domain at which a field is not one with its image (docs/theory/mpm.md, 3: contact with the
/// image), and the extent of the material there.
namespace whipple::device {

/// Selects the boundary condition at a face of the domain.
enum class WallKind : std::uint8_t {
  none,        ///< material leaves
  symmetry,    ///< mirror plane
  no_slip,     ///< no-slip wall
  separating,  ///< frictionless wall: transmits compression, no tension
  friction,    ///< separating wall with Coulomb friction
};

/// Holds what contact with images needs of the case and of the step.
struct WallConstants {
  std::array<WallKind, 6> kind{};
  double friction = 0.0;  ///< Coulomb coefficient of the walls of kind `friction`
  double dt = 0.0;        ///< s
  /// Faces at which some field is not one with its image, one bit each.
  std::uint32_t apart = 0;

  /// Returns whether a field is in contact with its image at a face.
  template <class Lattice>
  [[nodiscard]] WHIPPLE_POINT bool is_apart(const Lattice& lattice, std::uint32_t field, int face) const {
    return kind[static_cast<std::size_t>(face)] != WallKind::none &&
           !lattice.mirrors[static_cast<std::size_t>(face)].bonds(field);
  }
};

/// Distance (cells) from a plane of the nodes that contact with images concerns.
constexpr int mirror_reach = 2;

/// Flags the nodes near faces at which their field is not one with its image, before or after the momentum equation.
template <class Lattice>
struct FindWallNodes {
  Lattice lattice;
  WallConstants walls;
  std::uint32_t* flag;  ///< of each node: 0 or 1

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    flag[i] = 0;
    if (!(lattice.nodes[node].mass() > 0.0)) return;
    const std::uint32_t field = lattice.field_of(node);
    const Place at = lattice.place_of(node);
    if (lattice.is_image(at, field)) return;
    for (int face = 0; face < 6; ++face) {
      const int inside = lattice.inside_of(face, at);
      if (inside <= mirror_reach && inside >= -mirror_reach && walls.is_apart(lattice, field, face))
        flag[i] = 1;
    }
  }
};

/// Lists these nodes.
struct ListWallNodes {
  const std::uint32_t *flag, *before;  ///< of each node: number of flagged nodes before it
  std::uint32_t* nodes;                ///< in the order of their numbers
  std::int32_t* number;                ///< of each node, or nowhere

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const bool has = flag[i] != 0;
    number[i] = has ? static_cast<std::int32_t>(before[i]) : nowhere;
    if (has) nodes[before[i]] = static_cast<std::uint32_t>(i);
  }
};

/// Holds what contact with images knows of a node near walls.
struct WallNode {
  /// Extent (m) of the material that reaches the node beyond each face (negative: in front of it).
  std::array<double, 6> extent;
  Triple<double> velocity, increment;  ///< before all contact, m/s
  double mass;                         ///< kg
  double joint_mass;                   ///< of all images of the node whose relaxation is common so far, kg
  double heat;                         ///< dissipation by contact with images, J/kg
};

/// Determines the extent at node i of the list (3.7).
template <class Lattice>
struct FindWallExtents {
  Lattice lattice;
  Points points;
  const std::uint32_t* nodes;
  WallNode* at;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const std::uint32_t node = nodes[i];
    constexpr double none = -std::numeric_limits<double>::infinity();
    Triple<double> below = {none, none, none}, above = below;
    const Triple<double> lower = lattice.lower, upper = {lower.x + lattice.cells[0] * lattice.cell_size,
                                                         lower.y + lattice.cells[1] * lattice.cell_size,
                                                         lower.z + lattice.cells[2] * lattice.cell_size};
    for_each_point_from(lattice, points, lattice.field_of(node), lattice.place_of(node), {1.0, 1.0, 1.0},
                        [&](std::uint32_t p, const ReachedFrom&) {
                          const Triple<double> x = points.vector(position, p);
                          const HalfThickness thickness(lattice, points, p);
                          const Triple<double> half = {thickness.along_axis(0), thickness.along_axis(1),
                                                       thickness.along_axis(2)};
                          raise(below, lower - x + half);
                          raise(above, x - upper + half);
                        });
    at[i].extent = {below.x, above.x, below.y, above.y, below.z, above.z};
  }

 private:
  static WHIPPLE_POINT void raise(Triple<double>& largest, const Triple<double>& to) {
    if (to.x > largest.x) largest.x = to.x;
    if (to.y > largest.y) largest.y = to.y;
    if (to.z > largest.z) largest.z = to.z;
  }
};

/// Stores the motion of node i of the list after the momentum equation, which has stored its mass in the place of the
/// heat. Contact of bodies follows.
struct RememberUncoupled {
  const Node* of_lattice;
  const std::uint32_t* nodes;
  WallNode* at;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const Node& node = of_lattice[nodes[i]];
    at[i].velocity = node.velocity();
    at[i].increment = node.increment();
    at[i].mass = at[i].joint_mass = node.mass_for_contact();
    at[i].heat = 0.0;
  }
};

}  // namespace whipple::device
