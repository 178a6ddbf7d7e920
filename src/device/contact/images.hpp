// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/device/contact/apply.hpp"
#include "src/device/contact/couples.hpp"
#include "src/device/contact/touches.hpp"

/// Contact of material with its image at a face of the domain (docs/theory/mpm.md, 3.7 to 3.13). Kernels of one face
/// after the other: first mirror planes and no-slip walls, then walls from which material may part.
namespace whipple::device {

/// Motion of a node as contact with an image changes it.
struct MotionAtWall {
  Triple<double> velocity, increment;
  double relaxation;

  explicit WHIPPLE_POINT MotionAtWall(const Node& node)
      : velocity(node.velocity()), increment(node.increment()), relaxation(node.relaxation()) {}
  [[nodiscard]] WHIPPLE_POINT Triple<double> after() const { return velocity + increment; }
  /// Returns the velocity z by which the work of an impulse on the points is computed (3.13).
  [[nodiscard]] WHIPPLE_POINT Triple<double> mean(const WallNode& own) const {
    return relaxation * velocity + (1.0 - relaxation) * own.velocity + increment - 0.5 * own.increment;
  }
  /// Returns the loss of energy (J) of the points because they use this motion instead of their own (3.12).
  [[nodiscard]] WHIPPLE_POINT double loss(const WallNode& own) const {
    return own.mass * (dot(own.increment - increment, velocity + 0.5 * increment) -
                       dot(own.velocity - velocity, (1.0 - relaxation) * increment - relaxation * velocity));
  }
  WHIPPLE_POINT void store(Node& node) const {
    node.set_velocity(velocity);
    node.set_increment(increment);
    node.set_relaxation(relaxation);
  }
};

/// Adds heat of contact with images (J/kg) to a node.
WHIPPLE_POINT inline void add_heat(Node& node, WallNode& own, double heat) {
  node.n[7] += heat;
  own.heat += heat;
}

/// Assigns one beta to node i of the list and its image where planes intersect: otherwise the coupling at one plane would
/// change with the next one. Call for all faces before the first contact.
template <class Lattice>
struct JoinRelaxation {
  Wall<Lattice> wall;

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const std::int32_t mirror = wall.mirror_of(i);
    if (mirror == nowhere || static_cast<std::size_t>(mirror) == i) return;
    if (planes_of(wall.nodes[i]) < 2 || planes_of(wall.nodes[mirror]) < 2) return;
    WallNode &at_node = wall.at[i], &at_mirror = wall.at[mirror];
    const double mass = at_node.joint_mass, other_mass = at_mirror.joint_mass;
    if (mass < no_mass_for_contact || other_mass < no_mass_for_contact) return;
    Node &first = wall.lattice.nodes[wall.nodes[i]], &other = wall.lattice.nodes[wall.nodes[mirror]];
    const double beta = common_relaxation(mass, first.relaxation(), other_mass, other.relaxation());
    set_relaxation(first, at_node, beta);
    set_relaxation(other, at_mirror, beta);
    at_node.joint_mass = at_mirror.joint_mass = mass + other_mass;
  }

 private:
  /// Contact of bodies may have changed the velocity already: its energy depends on beta (3.12).
  static WHIPPLE_POINT void set_relaxation(Node& node, WallNode& own, double beta) {
    MotionAtWall motion(node);
    const double before = motion.loss(own);
    motion.relaxation = beta;
    add_heat(node, own, (motion.loss(own) - before) / own.mass);
    node.set_relaxation(beta);
  }
  /// Returns the number of planes that affect a node, among those with contact of any field.
  [[nodiscard]] WHIPPLE_POINT int planes_of(std::uint32_t node) const {
    const std::uint32_t field = wall.lattice.field_of(node);
    const Place place = wall.lattice.place_of(node);
    int planes = 0;
    for (int face = 0; face < 6; ++face) {
      if ((wall.walls.apart >> face & 1U) == 0) continue;
      const int inside = wall.lattice.inside_of(face, place);
      const bool affects =
          inside > 0 ? inside <= mirror_reach : wall.walls.is_apart(wall.lattice, field, face);
      planes += affects ? 1 : 0;
    }
    return planes;
  }
};

/// Applies contact between the material at node i of the list and its image at a face, and between the material at the
/// mirror node and its image (3.8) to (3.13).
template <class Lattice>
struct MeetImage {
  Wall<Lattice> wall;
  Approach* approach;  ///< of each node of the list, to this face

  WHIPPLE_POINT void operator()(std::size_t i) const {
    approach[i] = {.pair = static_cast<std::uint32_t>(wall.face)};
    const std::int32_t mirror = wall.mirror_of(i);
    if (mirror == nowhere) return;
    WallNode &own = wall.at[i], &own_of_mirror = wall.at[mirror];
    if (own.mass < no_mass_for_contact || own_of_mirror.mass < no_mass_for_contact) return;
    Node& node = wall.lattice.nodes[wall.nodes[i]];
    const bool on_plane = static_cast<std::size_t>(mirror) == i;
    MotionAtWall motion(node), of_mirror(wall.lattice.nodes[wall.nodes[mirror]]);
    const double before = motion.loss(own) + of_mirror.loss(own_of_mirror);
    if (!meet(i, own, own_of_mirror, on_plane, motion, of_mirror)) return;
    if (on_plane) of_mirror = motion;
    const double half = 0.5 * (motion.loss(own) + of_mirror.loss(own_of_mirror) - before);
    motion.store(node);
    add_heat(node, own, half / own.mass);
    if (on_plane) return;
    Node& mirror_node = wall.lattice.nodes[wall.nodes[mirror]];
    of_mirror.store(mirror_node);
    add_heat(mirror_node, own_of_mirror, half / own_of_mirror.mass);
  }

 private:
  /// Gap, in cells, below which material sticks to a no-slip wall.
  static constexpr double sticking_gap = 0.04;

  /// Returns the fraction of the step in which two surfaces are in contact (3.9).
  [[nodiscard]] WHIPPLE_POINT double share_in_touch(double gap, double closing_speed) const {
    if (gap <= 0.0) return 1.0;
    if (!(closing_speed > 0.0)) return 0.0;
    const double share = 1.0 - gap / (wall.walls.dt * closing_speed);
    return share > 0.0 ? share : 0.0;
  }
  /// Returns, by component, the weight of a node in the common velocity with the image at it: 1 for the components held
  /// by the opposite plane, if the node is on it and one with its image there; its mass fraction otherwise.
  [[nodiscard]] WHIPPLE_POINT Triple<double> part_of_node(std::size_t i, double mass,
                                                          double other_mass) const {
    const double fraction = mass / (mass + other_mass);
    Triple<double> part = {fraction, fraction, fraction};
    const std::uint32_t node = wall.nodes[i];
    const int opposite = wall.face ^ 1;
    if (!wall.lattice.mirrors[static_cast<std::size_t>(opposite)].bonds(wall.lattice.field_of(node)) ||
        wall.lattice.inside_of(opposite, wall.lattice.place_of(node)) != 0)
      return part;
    const Triple<double> held = wall.reversed(wall.walls.kind[static_cast<std::size_t>(opposite)]);
    return held + by_components(Triple<double>{1.0, 1.0, 1.0} - held, part);
  }

  /// Changes the motions; returns whether there is contact.
  WHIPPLE_POINT bool meet(std::size_t i, const WallNode& own, const WallNode& own_of_mirror, bool on_plane,
                          MotionAtWall& motion, MotionAtWall& of_mirror) const {
    const auto face = static_cast<std::size_t>(wall.face);
    const double open = -(own.extent[face] + own_of_mirror.extent[face]);
    const Triple<double> mixed = wall.reversed(wall.kind()),
                         sign = Triple<double>{1.0, 1.0, 1.0} - 2.0 * mixed;
    const Triple<double> v = motion.velocity, d = motion.increment,
                         v_image = by_components(sign, of_mirror.velocity),
                         d_image = by_components(sign, of_mirror.increment);
    const double w = wall.normal(v_image - v), e = wall.normal(d_image - d);
    const double beta =
        common_relaxation(own.mass, motion.relaxation, own_of_mirror.mass, of_mirror.relaxation);
    approach[i] = {open, -(w + e), static_cast<std::uint32_t>(wall.face)};
    const bool held = wall.kind() == WallKind::no_slip && open < sticking_gap * wall.lattice.cell_size;
    const double share = held ? 1.0 : share_in_touch(open, -(w + e));
    if (!(share > 0.0)) return false;
    const Triple<double> part = part_of_node(i, own.mass, own_of_mirror.mass),
                         rest = Triple<double>{1.0, 1.0, 1.0} - part;
    if (beta > 0.0 || held) {
      if (!held && !(e + beta * w < 0.0)) return false;  // in tension
      const Triple<double> to_common = share * mixed;
      const Triple<double> v_common = by_components(part, v) + by_components(rest, v_image);
      const Triple<double> d_common = by_components(part, d) + by_components(rest, d_image);
      motion.velocity = v + by_components(to_common, v_common - v);
      motion.increment = d + by_components(to_common, d_common - d);
      of_mirror.velocity = by_components(sign, v_image + by_components(to_common, v_common - v_image));
      of_mirror.increment = by_components(sign, d_image + by_components(to_common, d_common - d_image));
      motion.relaxation = of_mirror.relaxation = beta;
    } else {  // (3.11): a common velocity of the nodes would not slow points that are not relaxed towards it
      const double allowed = open > 0.0 ? open / wall.walls.dt : 0.0;
      const double stopped = -(w + e) - greatest_of(allowed, w);
      if (!(stopped > 0.0)) return false;
      const double own_part = wall.axis() == 0 ? part.x : wall.axis() == 1 ? part.y : part.z;
      motion.increment -= wall.along_normal((1.0 - own_part) * stopped);
      of_mirror.increment -= wall.along_normal(own_part * stopped);
    }
    if (on_plane) of_mirror = motion;
    if (wall.kind() == WallKind::friction) {
      rub(own, own_of_mirror, v, d, by_components(sign, v_image), by_components(sign, d_image), motion,
          of_mirror);
    }
    return true;
  }

  /// Applies the Coulomb friction of a wall (3.13).
  /// @param v, d, v_mirror, d_mirror  motion of both nodes before the contact with this wall
  WHIPPLE_POINT void rub(const WallNode& own, const WallNode& own_of_mirror, const Triple<double>& v,
                         const Triple<double>& d, const Triple<double>& v_mirror,
                         const Triple<double>& d_mirror, MotionAtWall& motion,
                         MotionAtWall& of_mirror) const {
    const Triple<double> along = Triple<double>{1.0, 1.0, 1.0} - wall.reversed(WallKind::friction);
    const Triple<double> slip = by_components(along, motion.after() + of_mirror.after());
    const double speed2 = dot(slip, slip);
    if (!(speed2 > 0.0)) return;
    const double mass = own.mass, other_mass = own_of_mirror.mass,
                 reduced = mass * other_mass / (mass + other_mass);
    const double power = dot(slip, motion.mean(own) + of_mirror.mean(own_of_mirror));
    const double grip = 2.0 * reduced * greatest_of(power / speed2, 0.0);
    const auto given = [&](double m, const MotionAtWall& to, const Triple<double>& v_from,
                           const Triple<double>& d_from) {
      return m * wall.normal(to.increment - d_from + to.relaxation * (to.velocity - v_from));
    };
    const double pressed =
        -greatest_of(given(mass, motion, v, d), given(other_mass, of_mirror, v_mirror, d_mirror));
    const double limit = wall.walls.friction * greatest_of(pressed, 0.0) / std::sqrt(speed2);
    const Triple<double> impulse = least_of(reduced, least_of(grip, limit)) * slip;
    motion.increment -= (1.0 / mass) * impulse;
    of_mirror.increment -= (1.0 / other_mass) * impulse;
  }
};

}  // namespace whipple::device
