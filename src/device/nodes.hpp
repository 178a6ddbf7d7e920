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
  int axis;
  int at;    ///< node on the plane
  int sign;  ///< of the direction outward
  bool reverses_all;

  /// Returns the signs of the components of the image of a vector.
  [[nodiscard]] WHIPPLE_POINT Triple<double> reflection() const {
    const auto of = [this](int a) { return reverses_all || a == axis ? -1.0 : 1.0; };
    return {of(0), of(1), of(2)};
  }
  /// Returns how far a node is beyond the plane, in cells.
  [[nodiscard]] WHIPPLE_POINT int beyond(const Place& place) const {
    return sign * (Lattice::along(place, axis) - at);
  }
  /// Returns the mirror place.
  [[nodiscard]] WHIPPLE_POINT Place mirrored(const Place& place) const {
    const auto of = [this](int a, int x) { return a == axis ? 2 * at - x : x; };
    return {of(0, place.x), of(1, place.y), of(2, place.z)};
  }
};
WHIPPLE_POINT inline Plane plane_of(const Lattice& lattice, int face) {
  const int axis = face / 2;
  const bool upper = face % 2 != 0;
  return {axis, upper ? lattice.cells[static_cast<std::size_t>(axis)] : 0, upper ? 1 : -1,
          lattice.mirrors[static_cast<std::size_t>(face)].reverses_all};
}

WHIPPLE_POINT inline Triple<double> by_component(const Triple<double>& a, const Triple<double>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Adds the sums of the nodes beyond a plane, with the reflected vectors, to their images.
struct FoldMirror {
  Lattice lattice;
  Plane plane;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const Place at = lattice.place_of(node);
    if (plane.beyond(at) != -1) return;
    const std::int32_t other = lattice.node_at(lattice.field_of(node), plane.mirrored(at));
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
struct RestrictToMirror {
  Lattice lattice;
  Plane plane;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    if (plane.beyond(lattice.place_of(static_cast<std::uint32_t>(i))) != 0) return;
    Node& node = lattice.nodes[i];
    const Triple<double> r = plane.reflection();
    if (r.x < 0.0) node.n[1] = node.n[5] = 0.0;
    if (r.y < 0.0) node.n[2] = node.n[6] = 0.0;
    if (r.z < 0.0) node.n[3] = node.n[7] = 0.0;
  }
};

/// Solves m dv/dt = f (3.4): sums before, motion after. Nodes beyond mirror planes are set to zero.
struct SolveMomentum {
  Lattice lattice;
  double dt;
  double rate;              ///< kappa dt / dx, s/m
  const ContactRole* role;  ///< of each node; null: one velocity field

  WHIPPLE_POINT void operator()(std::size_t i) const {
    Node& node = lattice.nodes[i];
    const double m = node.mass();
    if (m < no_mass || lattice.is_image(lattice.place_of(static_cast<std::uint32_t>(i)))) {
      node = {};
      return;
    }
    const double sound = (node.sound() > 0.0 ? node.sound() : 0.0) / m, beta = -std::expm1(-rate * sound);
    const double per_mass = dt / m;
    const Triple<double> p = node.momentum(), f = node.force();
    node.set_velocity({p.x / m, p.y / m, p.z / m});
    node.set_relaxation(beta);
    node.set_increment(per_mass * f);
    node.set_heat(role == nullptr || role[i] == ContactRole::none ? 0.0
                                                                  : m);  // contact takes the mass from there
  }
};

/// Sets the motion beyond a plane to the reflected one.
struct CopyMirror {
  Lattice lattice;
  Plane plane;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const auto node = static_cast<std::uint32_t>(i);
    const Place at = lattice.place_of(node);
    if (plane.beyond(at) != 1) return;
    const std::int32_t image = lattice.node_at(lattice.field_of(node), plane.mirrored(at));
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
struct ImpulseAtMirrors {
  using Result = Reduction<3, 0>;
  Lattice lattice;
  const Node* brought;  ///< sums of the particles before folding
  double dt;

  WHIPPLE_POINT void operator()(std::size_t i, Result& result) const {
    const Place at = lattice.place_of(static_cast<std::uint32_t>(i));
    bool near = false;
    for (int face = 0; face < 6; ++face) {
      if (!lattice.mirrors[static_cast<std::size_t>(face)].active) continue;
      const int beyond = plane_of(lattice, face).beyond(at);
      near = near || (beyond >= -1 && beyond <= 1);
    }
    const Node& sums = brought[i];
    if (!near || !(sums.mass() > 0.0)) return;
    const Node& node = lattice.nodes[i];
    const double m = sums.mass();
    const Triple<double> d = node.increment(), v = node.velocity(), p = sums.momentum(), f = sums.force();
    const double beta = node.relaxation();
    result.sum[0] += m * d.x - dt * f.x - beta * (p.x - m * v.x);
    result.sum[1] += m * d.y - dt * f.y - beta * (p.y - m * v.y);
    result.sum[2] += m * d.z - dt * f.z - beta * (p.z - m * v.z);
  }
};

}  // namespace whipple::device
