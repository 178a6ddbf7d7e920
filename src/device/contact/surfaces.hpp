// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "src/device/contact/constants.hpp"
#include "src/device/contact/reach.hpp"
#include "src/device/contact/thickness.hpp"

/// Surfaces of two bodies at the nodes that both reach (docs/theory/contact.md, section 3). Values of the two bodies of
/// pair k, of n pairs, are at k and n + k.
namespace whipple::device {

constexpr std::size_t most_normals = 3;
/// Candidates for the normal from the first to the second body: unit vectors, or 0.
using CandidateNormals = std::array<Triple<double>, most_normals>;
/// Extent of a body from the node along each of them, m: of the second body in the opposite direction.
using Extents = std::array<double, most_normals>;

/// Holds the sums of (3.1) for a body; V is the area in the plane in two dimensions.
struct VolumeGradient {
  Triple<double> gradient;  ///< sum of V grad N, m^2 or m
  double volume;            ///< sum of V N, m^3 or m^2
};

/// Describes the geometry of two bodies at a node.
struct Gap {
  Triple<double> normal{};  ///< unit vector from the first to the second; 0 where it is not defined
  double width = 0.0;       ///< between their surfaces along the normal, m; negative where they overlap

  [[nodiscard]] WHIPPLE_POINT bool any() const {
    return normal.x != 0.0 || normal.y != 0.0 || normal.z != 0.0;
  }
};

/// Gives access to the pairs of a step and their surfaces.
struct ContactSurfaces {
  const ContactPair* pairs;
  std::size_t count;
  VolumeGradient* gradients;  ///< 2 count
  CandidateNormals* normals;  ///< count
  Extents* extents;           ///< 2 count

  [[nodiscard]] WHIPPLE_POINT std::uint32_t node(std::size_t i) const {
    return i < count ? pairs[i].first : pairs[i - count].second;
  }
  /// Returns the normal with the largest gap (3.5), and that gap (3.3).
  [[nodiscard]] WHIPPLE_POINT Gap gap(std::size_t pair) const {
    Gap widest{.width = -std::numeric_limits<double>::infinity()};
    for (std::size_t n = 0; n < most_normals; ++n) {
      const Gap tried{normals[pair][n], -extents[pair][n] - extents[count + pair][n]};
      if (tried.width > widest.width && tried.any()) widest = tried;
    }
    return widest;
  }
};

/// Sums the volume gradient (3.1) of body i, of 2 count.
template <class Lattice>
struct SumVolumeGradients {
  Lattice lattice;
  Points points;
  ContactSurfaces surfaces;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    VolumeGradient sum{};
    const std::uint32_t node = surfaces.node(i);
    if (surfaces.pairs[i % surfaces.count].second != crowded) {
      const std::uint32_t field = lattice.field_of(node);
      const Place at = lattice.place_of(node);
      for_each_point_at(lattice, points, field, at, [&](std::uint32_t p, const ReachedFrom& from) {
        const double size = size_in_section<Lattice::planar>(points, p);
        sum.gradient += size * from.gradient;
        sum.volume += size * from.weight;
      });
      const Triple<double> off = off_planes(lattice, field, at);
      sum.gradient = {sum.gradient.x * off.x, sum.gradient.y * off.y, sum.gradient.z * off.z};
    }
    surfaces.gradients[i] = sum;
  }
};

/// Determines the candidates for the normal of pair i (3.2), (3.5), while the nodes hold the sums.
template <class Lattice>
struct ChooseNormals {
  Lattice lattice;
  ContactConstants constants;
  ContactSurfaces surfaces;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    CandidateNormals& normals = surfaces.normals[i];
    normals = {};
    const VolumeGradient &a = surfaces.gradients[i], &b = surfaces.gradients[surfaces.count + i];
    if (!(a.volume > 0.0) || !(b.volume > 0.0)) return;
    const Triple<double> of_a = outward(a), of_b = -outward(b);
    // On smooth faces all three are equal.
    const bool one = constants.normal == ContactNormal::collinear || dot(of_a, of_b) > one_direction;
    CandidateNormals tried{unit_or_zero(of_a + of_b)};
    if (!one) tried = {tried[0], of_a, of_b};
    if (!near_planes(surfaces.pairs[i].first) && part(surfaces.pairs[i], tried)) return;
    normals = tried;
  }

 private:
  /// Minimum relative change of a body's nodal volume per cell; below it the node is in the interior (3.1).
  static constexpr double least_slope = 0.02;
  /// Cosine of the angle between two normals above which they count as equal.
  static constexpr double one_direction = 1.0 - 1e-6;

  [[nodiscard]] static WHIPPLE_POINT Triple<double> unit_or_zero(const Triple<double>& v) {
    const double norm = std::sqrt(dot(v, v));
    if (!(norm > 0.0)) return {0.0, 0.0, 0.0};
    return {v.x / norm, v.y / norm, v.z / norm};
  }
  [[nodiscard]] WHIPPLE_POINT Triple<double> outward(const VolumeGradient& body) const {
    const bool inside =
        std::sqrt(dot(body.gradient, body.gradient)) * lattice.cell_size < least_slope * body.volume;
    return inside ? Triple<double>{0.0, 0.0, 0.0} : unit_or_zero(body.gradient);
  }
  /// Returns whether particles may reach nodes of the block from both sides of a reflecting face, so that sums may not be
  /// those of the motion.
  [[nodiscard]] WHIPPLE_POINT bool near_planes(std::uint32_t node) const {
    constexpr int reach = 2;  // cells
    const Place first = lattice.place_of(node / block_nodes * block_nodes);
    for (int axis = 0; axis < 3; ++axis) {
      const int begin = Lattice::along(first, axis);
      if ((constants.reflecting_faces >> (2 * axis) & 1U) != 0 && begin <= reach) return true;
      if ((constants.reflecting_faces >> (2 * axis + 1) & 1U) != 0 &&
          begin + Lattice::edge_along(axis) - 1 >= lattice.cells[static_cast<std::size_t>(axis)] - reach)
        return true;
    }
    return false;
  }
  /// Returns whether the bodies separate along all candidates and are not compressed by the forces: then there is no
  /// impulse, whatever the gap (section 4).
  [[nodiscard]] WHIPPLE_POINT bool part(const ContactPair& pair, const CandidateNormals& tried) const {
    const Node &a = lattice.nodes[pair.first], &b = lattice.nodes[pair.second];
    const double per_a = 1.0 / a.mass(), per_b = 1.0 / b.mass();
    const Triple<double> apart = per_b * b.momentum() - per_a * a.momentum(),
                         pulled = (constants.dt * per_b) * b.force() - (constants.dt * per_a) * a.force();
    for (const Triple<double>& normal : tried) {
      if (!(dot(normal, pulled) >= 0.0) || !(dot(normal, apart + pulled) >= 0.0)) return false;
    }
    return true;
  }
};

/// Determines how far body i, of 2 count, extends along the candidates of its pair (3.3).
template <class Lattice>
struct FindExtents {
  Lattice lattice;
  Points points;
  ContactSurfaces surfaces;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const bool second = i >= surfaces.count;
    const CandidateNormals& of_pair = surfaces.normals[second ? i - surfaces.count : i];
    const double to = second ? -1.0 : 1.0;
    const Triple<double> n0 = to * of_pair[0], n1 = to * of_pair[1], n2 = to * of_pair[2];
    const auto is_set = [](const Triple<double>& n) { return n.x != 0.0 || n.y != 0.0 || n.z != 0.0; };
    const bool further = is_set(n1) || is_set(n2);
    double e0 = -std::numeric_limits<double>::infinity(), e1 = e0, e2 = e0;
    if (is_set(n0) || further) {
      const std::uint32_t node = surfaces.node(i);
      const std::uint32_t field = lattice.field_of(node);
      for_each_point_at(lattice, points, field, lattice.place_of(node),
                        [&](std::uint32_t p, const ReachedFrom& from) {
                          const HalfThickness half(lattice, points, p);
                          const auto raise = [&](const Triple<double>& n, double& largest) {
                            const double along = dot(n, from.distance);
                            // Most particles are behind the outermost one by more than their thickness.
                            if (!(along + half.largest() > largest)) return;
                            const double reached =
                                along + half.along({from.sign.x * n.x, from.sign.y * n.y, from.sign.z * n.z});
                            if (reached > largest) largest = reached;
                          };
                          raise(n0, e0);
                          if (!further) return;
                          raise(n1, e1);
                          raise(n2, e2);
                        });
    }
    surfaces.extents[i] = {e0, e1, e2};
  }
};

}  // namespace whipple::device
