// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/device/contact/constants.hpp"
#include "src/device/contact/walls.hpp"

/// Couples of nodes near a face of the domain: a node inside and its mirror node, which are the same on the plane.
namespace whipple::device {

[[nodiscard]] WHIPPLE_POINT inline Triple<double> by_components(const Triple<double>& a,
                                                                const Triple<double>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Describes a face and gives access to the nodes near walls.
template <class Lattice>
struct Wall {
  Lattice lattice;
  WallConstants walls;
  int face;
  const std::uint32_t* nodes;
  const std::int32_t* number;
  WallNode* at;

  [[nodiscard]] WHIPPLE_POINT WallKind kind() const { return walls.kind[static_cast<std::size_t>(face)]; }
  [[nodiscard]] WHIPPLE_POINT int axis() const { return face / 2; }
  [[nodiscard]] WHIPPLE_POINT double outward() const { return face % 2 == 0 ? -1.0 : 1.0; }
  [[nodiscard]] WHIPPLE_POINT double normal(const Triple<double>& v) const {
    return outward() * (axis() == 0 ? v.x : axis() == 1 ? v.y : v.z);
  }
  /// Returns the vector of a length along the outward normal.
  [[nodiscard]] WHIPPLE_POINT Triple<double> along_normal(double length) const {
    const double signed_length = outward() * length;
    return {axis() == 0 ? signed_length : 0.0, axis() == 1 ? signed_length : 0.0,
            axis() == 2 ? signed_length : 0.0};
  }
  /// Returns 1 for the components that the image at a wall of some kind reverses.
  [[nodiscard]] WHIPPLE_POINT Triple<double> reversed(WallKind of) const {
    const bool all = of == WallKind::no_slip;
    return {all || axis() == 0 ? 1.0 : 0.0, all || axis() == 1 ? 1.0 : 0.0, all || axis() == 2 ? 1.0 : 0.0};
  }

  /// Returns the number, among the nodes near walls, of the mirror node of number i: i itself on the plane, nowhere if
  /// there is none or if i does not decide about the couple.
  [[nodiscard]] WHIPPLE_POINT std::int32_t mirror_of(std::size_t i) const {
    const std::uint32_t node = nodes[i], field = lattice.field_of(node);
    if (!walls.is_apart(lattice, field, face)) return nowhere;
    const Place place = lattice.place_of(node);
    const int inside = lattice.inside_of(face, place);
    if (inside < 0 || inside > mirror_reach) return nowhere;
    if (inside == 0) return static_cast<std::int32_t>(i);
    const Place image = lattice.mirrored(face, place);
    if (!is_in_blocks(lattice, image)) return nowhere;
    const std::int32_t mirror = lattice.node_at(field, image);
    return mirror == nowhere ? nowhere : number[mirror];
  }
};

/// Returns beta of the common field of two nodes (3.8); 0 if either has none.
[[nodiscard]] WHIPPLE_POINT inline double common_relaxation(double mass, double beta, double other_mass,
                                                            double other_beta) {
  if (beta == other_beta) return beta;
  if (beta == 0.0 || other_beta == 0.0) return 0.0;
  return -std::expm1((mass * std::log1p(-beta) + other_mass * std::log1p(-other_beta)) / (mass + other_mass));
}

}  // namespace whipple::device
