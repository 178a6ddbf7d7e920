// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "src/device/contact/constants.hpp"
#include "src/device/contact/surfaces.hpp"
#include "src/device/contact/touches.hpp"

/// Motion of two bodies in contact at a node (docs/theory/contact.md, sections 4 and 5).
namespace whipple::device {

/// Holds the motion of one body at a node.
struct ContactSide {
  Triple<double> velocity, increment;  ///< m/s
  double relaxation;                   ///< beta
  double mass;                         ///< kg
  double heat;                         ///< contact dissipation, J

  explicit WHIPPLE_POINT ContactSide(const Node& node)
      : velocity(node.velocity()),
        increment(node.increment()),
        relaxation(node.relaxation()),
        mass(node.mass_for_contact()),
        heat(0.0) {}
  [[nodiscard]] WHIPPLE_POINT Triple<double> after() const { return velocity + increment; }
  WHIPPLE_POINT void push(const Triple<double>& impulse) { increment += (1.0 / mass) * impulse; }
  WHIPPLE_POINT void store(Node& node) const {
    node.set_velocity(velocity);
    node.set_relaxation(relaxation);
    node.set_increment(increment);
    node.set_heat(heat != 0.0 ? heat / mass : 0.0);
  }
};

/// Describes the contact of two sides.
struct Meeting {
  Triple<double> normal;  ///< unit vector from the first to the second
  double open;            ///< m, between their surfaces; <= 0: they touch
  double share;           ///< theta (4.2), fraction of the step in contact
  double friction;        ///< Coulomb coefficient

  [[nodiscard]] WHIPPLE_POINT Triple<double> tangential(const Triple<double>& v) const {
    return v - dot(normal, v) * normal;
  }
  /// Returns theta (4.2) of two sides.
  [[nodiscard]] static WHIPPLE_POINT double share_of(const ContactSide& a, const ContactSide& b,
                                                     const Triple<double>& normal, double open, double dt) {
    if (open <= 0.0) return 1.0;
    const double closing = -dot(normal, b.after() - a.after()) * dt;
    return closing > open ? 1.0 - open / closing : 0.0;
  }
};

[[nodiscard]] WHIPPLE_POINT inline double least_of(double a, double b) { return a < b ? a : b; }
[[nodiscard]] WHIPPLE_POINT inline double greatest_of(double a, double b) { return a > b ? a : b; }

/// Stops the approach of two sides by impulses (5.1) to (5.5).
WHIPPLE_POINT inline void stop(ContactSide& a, ContactSide& b, const Meeting& meeting, double dt,
                               ContactBalance& balance) {
  const double reduced = a.mass * b.mass / (a.mass + b.mass);
  const Triple<double> old = b.velocity - a.velocity, free = b.after() - a.after();
  const double target = -greatest_of(meeting.open / dt, dot(meeting.normal, old));
  const Triple<double> slip = meeting.tangential(free);
  const double speed2 = dot(slip, slip);
  double grip = 0.0;  // largest tangential impulse that does not increase the energy, N s
  if (speed2 > 0.0) {
    const double part = 1.0 + dot(slip, old) / speed2;
    grip = least_of(greatest_of(part, 0.0), 1.0) * reduced * std::sqrt(speed2);
  }
  const double push = greatest_of(reduced * (target - dot(meeting.normal, free)), 0.0);
  Triple<double> drag = (-reduced) * slip;
  const double limit = least_of(meeting.friction * push, grip), norm = std::sqrt(dot(drag, drag));
  if (norm > limit) drag = (limit / norm) * drag;
  const Triple<double> impulse = push * meeting.normal + drag;
  b.push(impulse);
  a.push(-impulse);
  const Triple<double> mean = 0.5 * (old + b.after() - a.after());
  const double by_push = -push * dot(meeting.normal, mean), by_drag = -dot(drag, mean);
  balance += {by_push, by_drag, push, std::sqrt(dot(drag, drag))};
  a.heat += 0.5 * (by_push + by_drag);
  b.heat += 0.5 * (by_push + by_drag);
}

/// Moves two sides under compression together along the normal, (4.1) to (4.6), and applies friction, (4.10) and (4.11).
WHIPPLE_POINT inline void press(ContactSide& a, ContactSide& b, const Meeting& meeting,
                                ContactBalance& balance) {
  const double reduced = a.mass * b.mass / (a.mass + b.mass);
  const double beta =
      a.relaxation == b.relaxation
          ? a.relaxation
          : -std::expm1((a.mass * std::log1p(-a.relaxation) + b.mass * std::log1p(-b.relaxation)) /
                        (a.mass + b.mass));
  const double velocity = meeting.share * reduced * dot(meeting.normal, b.velocity - a.velocity),
               forces = meeting.share * reduced * dot(meeting.normal, b.increment - a.increment);
  const double given = -(forces + beta * velocity);  // (4.5)
  if (!(given > 0.0)) return;                        // surfaces transmit no tension
  // For the work of friction: (1 - beta) u - f/2 of b relative to a
  const Triple<double> former = (1.0 - beta) * (b.velocity - a.velocity) - 0.5 * (b.increment - a.increment);
  a.velocity += (velocity / a.mass) * meeting.normal;
  a.increment += (forces / a.mass) * meeting.normal;
  b.velocity -= (velocity / b.mass) * meeting.normal;
  b.increment -= (forces / b.mass) * meeting.normal;
  a.relaxation = b.relaxation = beta;
  const double heat = (1.0 - meeting.share) / (meeting.share * reduced) *
                      (0.5 * forces * forces + beta * velocity * (velocity + forces));
  a.heat += 0.5 * heat;
  b.heat += 0.5 * heat;
  balance.contact_heat += heat;
  balance.impulse += given;
  if (!(meeting.friction > 0.0)) return;
  const Triple<double> slip = meeting.tangential(b.after() - a.after());
  const double speed2 = dot(slip, slip);
  if (!(speed2 > 0.0)) return;
  const Triple<double> mean = beta * (b.velocity - a.velocity) + (b.increment - a.increment) + former;
  const double grip = 2.0 * reduced * greatest_of(dot(slip, mean) / speed2, 0.0);
  const double limit = meeting.friction * given / std::sqrt(speed2);
  const Triple<double> impulse = (-least_of(reduced, least_of(grip, limit))) * slip;
  b.push(impulse);
  a.push(-impulse);
  const double dragged2 = dot(impulse, impulse);
  const double by_drag = -dot(impulse, mean) - 0.5 * dragged2 / reduced;
  a.heat += 0.5 * by_drag;
  b.heat += 0.5 * by_drag;
  balance.friction_heat += by_drag;
  balance.friction_impulse += std::sqrt(dragged2);
}

/// Sets the components of the motion of a side to zero again that mirror planes hold: those that the image reverses,
/// where the field is one with it and the node is on the plane. Contact with a field that is not one with its image
/// there changed them; what the points lose becomes heat (4.12).
/// @returns the heat, J
template <class Lattice>
WHIPPLE_POINT inline double hold(ContactSide& side, const Lattice& lattice, std::uint32_t node) {
  const std::uint32_t field = lattice.field_of(node);
  const Place place = lattice.place_of(node);
  Triple<double> held = {0.0, 0.0, 0.0};
  for (int face = 0; face < 6; ++face) {
    const Mirror& mirror = lattice.mirrors[static_cast<std::size_t>(face)];
    if (!mirror.bonds(field) || lattice.inside_of(face, place) != 0) continue;
    if (mirror.reverses_all || face / 2 == 0) held.x = 1.0;
    if (mirror.reverses_all || face / 2 == 1) held.y = 1.0;
    if (mirror.reverses_all || face / 2 == 2) held.z = 1.0;
  }
  const Triple<double> v = {held.x * side.velocity.x, held.y * side.velocity.y, held.z * side.velocity.z},
                       d = {held.x * side.increment.x, held.y * side.increment.y, held.z * side.increment.z};
  const double beta = side.relaxation;
  const Triple<double> taken = d + beta * v;
  const double heat = 0.5 * side.mass * (dot(taken, taken) + beta * (2.0 - beta) * dot(v, v));
  side.velocity -= v;
  side.increment -= d;
  side.heat += heat;
  return heat;
}

/// Applies contact at the nodes of pair i, after the momentum equation: changes velocities, increments and relaxations
/// and replaces the mass of both nodes by their heat.
template <class Lattice>
struct ApplyContact {
  Lattice lattice;
  ContactConstants constants;
  ContactSurfaces surfaces;
  ContactBalance* balance;  ///< of each pair
  Approach* approach;       ///< of each pair

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const ContactPair pair = surfaces.pairs[i];
    ContactBalance of_pair{};
    Approach seen{};
    if (pair.second == crowded) {
      lattice.nodes[pair.first].set_heat(0.0);
      of_pair.crowded = 1.0;
    } else {
      meet(pair, surfaces.gap(i), of_pair, seen);
    }
    balance[i] = of_pair;
    approach[i] = seen;
  }

 private:
  WHIPPLE_POINT void meet(const ContactPair& pair, const Gap& gap, ContactBalance& of_pair,
                          Approach& seen) const {
    Node &node = lattice.nodes[pair.first], &other = lattice.nodes[pair.second];
    ContactSide a(node), b(other);
    const double dt = constants.dt;
    if (a.mass >= no_mass_for_contact && b.mass >= no_mass_for_contact && gap.any()) {
      const std::uint32_t first = lattice.field_of(pair.first), second = lattice.field_of(pair.second);
      const double open =
          constants.gap_test ? greatest_of(gap.width - constants.gap * lattice.cell_size, 0.0) : 0.0;
      seen = {.open = open,
              .closing = dot(gap.normal, a.after() - b.after()),
              .pair = pair_of_fields(first, second)};
      const Meeting meeting{gap.normal, open, Meeting::share_of(a, b, gap.normal, open, dt),
                            least_of(constants.friction[first], constants.friction[second])};
      if (is_loose(a, first) || is_loose(b, second)) {
        stop(a, b, meeting, dt, of_pair);
      } else if (meeting.share > 0.0) {
        press(a, b, meeting, of_pair);
      }
      of_pair.contact_heat += hold(a, lattice, pair.first) + hold(b, lattice, pair.second);
    }
    a.store(node);
    b.store(other);
  }
  /// Returns whether impulses stop a side: its material is too fragmented to move with a common velocity, or all do.
  [[nodiscard]] WHIPPLE_POINT bool is_loose(const ContactSide& side, std::uint32_t field) const {
    return constants.response == ContactResponse::impulses ||
           side.relaxation <= -std::expm1(-constants.least_relaxation_rate[field] * constants.dt);
  }
};

}  // namespace whipple::device
