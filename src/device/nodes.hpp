// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/device/contact/nodes.hpp"
#include "src/device/lattice.hpp"
#include "src/device/reduction.hpp"

/// Kernels of the nodes: mirror planes and the momentum equation (docs/theory/mpm.md, 3).
namespace whipple::device {

constexpr double no_mass = 1e-300;  ///< kg; below it momentum / mass may overflow

/// Mirror plane of the domain.
struct Plane {
  int face;
  bool reverses_all;

  /// Returns the signs of the components of the image of a vector.
  [[nodiscard]] WHIPPLE_POINT Triple<double> reflection() const {
    const auto of = [this](int a) { return reverses_all || a == face / 2 ? -1.0 : 1.0; };
    return {of(0), of(1), of(2)};
  }
  /// Returns the node of the same field at the mirror place of one that lies `inside` cells inside of the plane, or
  /// nowhere; also where the field is not one with its image.
  template <class Lattice>
  [[nodiscard]] WHIPPLE_POINT std::int32_t mirror_of(const Lattice& lattice, std::uint32_t node,
                                                     int inside) const {
    const Place at = lattice.place_of(node);
    if (lattice.inside_of(face, at) != inside) return nowhere;
    const std::uint32_t field = lattice.field_of(node);
    if (!lattice.mirrors[static_cast<std::size_t>(face)].bonds(field)) return nowhere;
    return lattice.node_at(field, lattice.mirrored(face, at));
  }
};
template <class Lattice>
WHIPPLE_POINT inline Plane plane_of(const Lattice& lattice, int face) {
  return {face, lattice.mirrors[static_cast<std::size_t>(face)].reverses_all};
}

WHIPPLE_POINT inline Triple<double> by_component(const Triple<double>& a, const Triple<double>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Adds the sums of the nodes beyond a plane, with the reflected vectors, to their images.
template <class Lattice>
struct FoldMirror {
  Lattice lattice;
  Plane plane;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const std::int32_t other = plane.mirror_of(lattice, node, 1);
    if (other == nowhere) return;
    const Node& outside = lattice.nodes[other];
    const Triple<double> r = plane.reflection();
    Node& image = lattice.nodes[node];
    image.n[0] += outside.n[0];
    image.n[1] += r.x * outside.n[1];
    image.n[2] += r.y * outside.n[2];
    image.n[3] += r.z * outside.n[3];
    image.n[4] += outside.n[4];
    image.n[5] += r.x * outside.n[5];
    image.n[6] += r.y * outside.n[6];
    image.n[7] += r.z * outside.n[7];
  }
};

/// Sets the components that the image reverses to zero on a plane.
template <class Lattice>
struct RestrictToMirror {
  Lattice lattice;
  Plane plane;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    if (plane.mirror_of(lattice, static_cast<std::uint32_t>(i), 0) == nowhere) return;
    Node& node = lattice.nodes[i];
    const Triple<double> r = plane.reflection();
    if (r.x < 0.0) node.n[1] = node.n[5] = 0.0;
    if (r.y < 0.0) node.n[2] = node.n[6] = 0.0;
    if (r.z < 0.0) node.n[3] = node.n[7] = 0.0;
  }
};

/// Solves m dv/dt = f (3.4): sums before, motion after. Nodes beyond mirror planes are set to zero.
template <class Lattice>
struct SolveMomentum {
  Lattice lattice;
  double dt;
  double rate;              ///< kappa dt / dx, s/m
  const ContactRole* role;  ///< of each node; null: one velocity field
  bool keeps_all_masses;    ///< whether contact with images follows

  WHIPPLE_POINT void operator()(std::size_t i) const {
    Node& node = lattice.nodes[i];
    const double m = node.mass();
    if (m < no_mass || lattice.is_image(lattice.place_of(static_cast<std::uint32_t>(i)),
                                        lattice.field_of(static_cast<std::uint32_t>(i)))) {
      node = {};
      return;
    }
    const double sound = (node.sound() > 0.0 ? node.sound() : 0.0) / m, beta = -std::expm1(-rate * sound);
    const double per_mass = dt / m;
    const Triple<double> p = node.momentum(), f = node.force();
    node.set_velocity({p.x / m, p.y / m, p.z / m});
    node.set_relaxation(beta);
    node.set_increment(per_mass * f);
    // Contact takes the mass from there.
    node.set_heat(keeps_all_masses || (role != nullptr && role[i] != ContactRole::none) ? m : 0.0);
  }
};

/// Clears the heat of all nodes, in whose place the momentum equation has stored their mass.
struct ClearHeat {
  Node* nodes;
  WHIPPLE_POINT void operator()(std::size_t i) const { nodes[i].set_heat(0.0); }
};

/// Sets the motion beyond a plane to the reflected one.
template <class Lattice>
struct CopyMirror {
  Lattice lattice;
  Plane plane;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const std::int32_t image = plane.mirror_of(lattice, node, -1);
    if (image == nowhere) return;
    const Node& from = lattice.nodes[image];
    Node& to = lattice.nodes[node];
    to.set_velocity(by_component(plane.reflection(), from.velocity()));
    to.set_relaxation(from.relaxation());
    to.set_increment(by_component(plane.reflection(), from.increment()));
    to.n[7] = from.n[7];
  }
};

/// Sums the momentum (N s) that planes and contact gave to the particles at the nodes near mirror planes (3.6).
template <class Lattice>
struct ImpulseAtMirrors {
  using Result = Reduction<3, 0>;
  Lattice lattice;
  const Node* brought;       ///< sums of the particles before folding
  double dt;                 ///< s
  std::uint32_t reflecting;  ///< faces with mirror planes or walls, one bit each

  WHIPPLE_POINT void operator()(std::size_t i, Result& result) const {
    const Place at = lattice.place_of(static_cast<std::uint32_t>(i));
    constexpr int reach = 2;  // of contact with images, cells
    bool near = false;
    for (int face = 0; face < 6; ++face) {
      const int inside = lattice.inside_of(face, at);
      near = near || ((reflecting >> face & 1U) != 0 && inside >= -reach && inside <= reach);
    }
    const Node& sums = brought[i];
    if (!near || !(sums.mass() > 0.0)) return;
    const Node& node = lattice.nodes[i];
    const double m = sums.mass();
    const Triple<double> d = node.increment(), v = node.velocity(), p = sums.momentum(), f = sums.force();
    const double beta = node.relaxation(), per_mass = dt / m;
    // Round-off only, where neither planes nor contact act
    if (v.x == p.x / m && v.y == p.y / m && v.z == p.z / m && d.x == per_mass * f.x &&
        d.y == per_mass * f.y && d.z == per_mass * f.z)
      return;
    result.sum[0] += m * d.x - dt * f.x - beta * (p.x - m * v.x);
    result.sum[1] += m * d.y - dt * f.y - beta * (p.y - m * v.y);
    result.sum[2] += m * d.z - dt * f.z - beta * (p.z - m * v.z);
  }
};

}  // namespace whipple::device
