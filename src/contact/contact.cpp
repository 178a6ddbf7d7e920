// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "src/contact/pressing.hpp"
#include "src/contact/sides.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::contact {
namespace {

/// Maximum distance, in cells, of surfaces that count as touching: allows for round-off and for gaps opened by
/// vibrations.
constexpr double resting_distance = 0.01;
constexpr int sweeps = 20;  // over the pairs, where more than two bodies meet

/// Computes the impulses that stop the approach of two fields at a node (docs/theory/contact.md, section 5). Velocities
/// are those of b relative to a.
struct Stop {
  Side* a;
  Side* b;
  Vector3 normal;
  double reduced_mass;
  double target;                      // normal velocity after the step
  double grip;                        // largest tangential impulse that does not increase the energy, N s
  double friction;                    // Coulomb coefficient
  double pushed = 0.0;                // normal impulse, N s
  Vector3 dragged = Vector3::Zero();  // tangential impulse on b, N s

  Stop(Side& first, Side& second, const Vector3& n, double closing, double coefficient)
      : a(&first),
        b(&second),
        normal(n),
        reduced_mass(a->mass * b->mass / (a->mass + b->mass)),
        friction(coefficient) {
    const Vector3 old = b->before() - a->before(), free = b->after() - a->after();
    target = -std::max(closing, n.dot(old));
    const Vector3 slip = tangential(free);
    const double speed2 = slip.squaredNorm();
    grip = speed2 > 0.0
               ? std::clamp(1.0 + slip.dot(old) / speed2, 0.0, 1.0) * reduced_mass * std::sqrt(speed2)
               : 0.0;
  }

  [[nodiscard]] Vector3 tangential(const Vector3& v) const { return v - normal.dot(v) * normal; }

  void relax() {
    const Vector3 relative = b->after() - a->after();
    const double push = std::max(pushed + reduced_mass * (target - normal.dot(relative)), 0.0);
    Vector3 drag = dragged - reduced_mass * tangential(relative);
    const double limit = std::min(friction * push, grip), norm = drag.norm();
    if (norm > limit) drag *= limit / norm;
    const Vector3 impulse = (push - pushed) * normal + (drag - dragged);
    b->push(impulse);
    a->push(-impulse);
    pushed = push;
    dragged = drag;
  }

  /// Adds the energy dissipated by the impulses (5.5) to the balance, and half of it to each field.
  void heat(Balance& balance) const {
    const Vector3 mean = 0.5 * (b->before() - a->before() + b->after() - a->after());
    const double by_push = -pushed * normal.dot(mean), by_drag = -dragged.dot(mean);
    balance += {by_push, by_drag, pushed, dragged.norm()};
    a->heat += 0.5 * (by_push + by_drag);
    b->heat += 0.5 * (by_push + by_drag);
  }
};

/// Accounts for the remaining dissipation of impulses on fields that are also under compression against others: the
/// velocities that result from both contribute (docs/theory/contact.md, section 4).
void book_rest(const Pressing& pressing, std::span<Side> sides, std::span<const Stop> stops,
               Balance& balance) {
  double rest = pressing.lost();
  for (const Side& side : sides) rest -= side.heat;
  balance.contact_heat += rest;
  const double share = 0.5 * rest / static_cast<double>(stops.size());
  for (const Stop& stop : stops) {
    stop.a->heat += share;
    stop.b->heat += share;
  }
}

/// Finds the components of the motion of nodes that mirror planes hold: those that the image reverses, where the material
/// is one with it and the node is on the plane.
class HeldComponents {
 public:
  HeldComponents(const grid::BlockGrid& grid, std::uint32_t slot) : grid_(grid) {
    const grid::Geometry& geometry = grid.geometry(slot);
    for (std::size_t face = 0; face < 6; ++face) {
      const std::size_t axis = face / 2;
      const int edge = grid.block_shape().along(axis), at = face % 2 == 0 ? 0 : geometry.cells[axis];
      layer_[face] = at - grid.coordinate(slot)[axis] * edge;
      if (!geometry.mirrors(face) || layer_[face] < 0 || layer_[face] >= edge) layer_[face] = -1;
      any_ = any_ || layer_[face] >= 0;
    }
  }
  [[nodiscard]] bool any() const { return any_; }
  /// Returns 1 for the held components of the motion of a body at a node of the slot, 0 for the others.
  [[nodiscard]] Lanes at(std::size_t node, unsigned field) const {
    const std::array<int, 3> place = grid_.block_shape().place(static_cast<int>(node));
    Lanes held{};
    for (std::size_t face = 0; face < 6; ++face) {
      if (layer_[face] != place[face / 2] || !grid_.is_bonded_at(face, field)) continue;
      if (grid_.geometry().boundary[face] == grid::Boundary::no_slip) return Lanes{1.0, 1.0, 1.0, 0.0};
      held[static_cast<int>(face / 2)] = 1.0;
    }
    return held;
  }

 private:
  const grid::BlockGrid& grid_;
  std::array<int, 6> layer_;  // of nodes of the slot on each plane; -1: none
  bool any_ = false;
};

/// Sets the held components of the motion of a side to zero again, which contact with a body that is not one with its
/// image there changed; what its points lose becomes heat (docs/theory/contact.md, 4.12).
/// @returns the heat, J
double hold(Side& side, Lanes held) {
  grid::NodeMotion& motion = side.node->motion;
  const Lanes v = held * motion.velocity_and_relaxation, d = held * motion.increment_and_heat;
  const double beta = motion.relaxation();
  const Lanes taken = d + beta * v;
  const double heat = 0.5 * side.mass * sum3(taken * taken + (beta * (2.0 - beta)) * v * v);
  if (heat == 0.0) return 0.0;
  motion.velocity_and_relaxation -= v;
  motion.increment_and_heat -= d;
  side.heat += heat;
  return heat;
}

/// Describes two sides, by their numbers, at a node where both have mass and a normal is defined.
struct Meeting {
  std::size_t a, b;
  Vector3 normal;
  double open;   // m, between their surfaces
  double share;  // fraction of the step in contact
  double friction;
};

/// Selects the fields that are stopped by impulses: those without relaxation, such as those of elements, those of
/// fragmented material, and all fields in contact with these. If they were mixed, they would retain their velocity
/// difference (docs/theory/contact.md, section 5).
/// @param least  least(side): relaxation at or below which the material of a side counts as fragmented
template <class Least>
void choose(Response response, const std::vector<Side>& sides, Least&& least,
            const std::vector<Meeting>& meetings, std::vector<std::uint8_t>& by_impulses) {
  by_impulses.assign(sides.size(), response == Response::impulses ? 1 : 0);
  if (response == Response::impulses) return;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    by_impulses[s] = sides[s].mass >= no_mass && sides[s].relaxation() <= least(s) ? 1 : 0;
  }
  for (bool grown = true; grown;) {
    grown = false;
    for (const Meeting& m : meetings) {
      if (m.share == 0.0 || by_impulses[m.a] == by_impulses[m.b]) continue;
      by_impulses[m.a] = by_impulses[m.b] = 1;
      grown = true;
    }
  }
}

}  // namespace

/// Returns the distance (m) of two surfaces with the given gap beyond the distance that counts as touching.
double Contact::distance(double cell_size, double gap) const {
  return settings_.gap_test ? std::max(gap - settings_.gap * cell_size, 0.0) : 0.0;
}

double Contact::friction_between(unsigned first, unsigned second) const {
  const std::vector<double>& friction = settings_.friction_of_field;
  return friction.empty() ? settings_.friction : std::min(friction[first], friction[second]);
}

bool Contact::touch(const grid::BlockGrid& grid, std::size_t contact_slot, std::size_t node,
                    std::size_t first, std::size_t second) const {
  const std::uint32_t slot = grid.contact_slots()[contact_slot];
  const grid::FieldSet bodies = grid.wholes(slot);
  const auto body_of = [&](std::size_t number) {  // counted among the bodies of the slot
    return bodies.count_below(grid.whole(grid.fields(slot).nth(number)));
  };
  const std::size_t a = body_of(first), b = body_of(second);
  if (a == b) return true;
  const std::size_t pair = pair_index(std::min(a, b), std::max(a, b), bodies.count());
  const Surfaces::Gap gap = surfaces_.at(contact_slot, pair, node);
  const double cell_size = grid.cell_size(slot);
  return !gap.normal.isZero(0.0) && distance(cell_size, gap.width) <= resting_distance * cell_size;
}

Balance Contact::apply(grid::BlockGrid& grid, double dt, FirstTouches& touches, const Cracks* cracks) const {
  std::vector<Balance> of_slot(grid.owned_contact_slots());
  parallel::for_each(grid.owned_contact_slots(), [&](std::size_t c) {
    Sides at_node(grid, grid.contact_slots()[c], cracks);
    std::vector<Side>& sides = at_node.all();
    const auto field = [&](std::size_t side) { return at_node.field(at_node.body(side)); };
    std::vector<double> least;  // minimum relaxation of each body
    for (std::size_t body = 0; body < at_node.bodies(); ++body) {
      const std::size_t of_body = at_node.field(body);
      const bool known = of_body < settings_.least_relaxation_rate.size();
      least.push_back(known ? -std::expm1(-settings_.least_relaxation_rate[of_body] * dt) : 0.0);
    }
    std::vector<Meeting> meetings;
    const HeldComponents held(grid, grid.contact_slots()[c]);
    const double cell_size = grid.cell_size(grid.contact_slots()[c]);
    std::vector<std::uint8_t> by_impulses;  // of each side
    std::vector<Stop> stops;
    Pressing pressing;
    for (std::size_t i = 0; i < grid::nodes_per_block; ++i) {
      at_node.go_to(i);
      meetings.clear();
      bool among_bodies = false;
      for (std::size_t a = 0; a < sides.size(); ++a) {
        for (std::size_t b = a + 1; b < sides.size(); ++b) {
          if (sides[a].mass < no_mass || sides[b].mass < no_mass) continue;
          const std::size_t of_a = at_node.body(a), of_b = at_node.body(b);
          if (of_a == of_b) {  // faces of a crack
            const Cracks::Crack& crack = at_node.crack(a);
            const double open = distance(cell_size, crack.gap);
            meetings.push_back({a, b, crack.axis, open,
                                Pressing::share(sides[a], sides[b], crack.axis, open, dt),
                                settings_.crack_friction});
            continue;
          }
          const Surfaces::Gap gap = surfaces_.at(c, pair_index(of_a, of_b, at_node.bodies()), i);
          if (gap.normal.isZero(0.0)) continue;
          among_bodies = true;
          const double open = distance(cell_size, gap.width);
          touches.see(field(a), field(b), open, gap.normal.dot(sides[a].after() - sides[b].after()));
          meetings.push_back({a, b, gap.normal, open,
                              Pressing::share(sides[a], sides[b], gap.normal, open, dt),
                              friction_between(field(a), field(b))});
        }
      }
      if (!meetings.empty()) {
        // Where only the faces of a crack meet, their velocity difference is negligible: they were one body.
        const auto least_of = [&](std::size_t side) {
          return among_bodies ? least[at_node.body(side)] : 0.0;
        };
        choose(settings_.response, sides, least_of, meetings, by_impulses);
        stops.clear();
        pressing.begin(sides);
        for (const Meeting& m : meetings) {
          if (by_impulses[m.a] != 0 || by_impulses[m.b] != 0) {
            stops.emplace_back(sides[m.a], sides[m.b], m.normal, m.open / dt, m.friction);
          } else if (m.share > 0.0) {
            pressing.add(m.a, m.b, m.normal, m.share, m.friction);
          }
        }
        pressing.apply(of_slot[c]);
        const int repeat = stops.size() > 1 ? sweeps : 1;
        for (int sweep = 0; sweep < repeat; ++sweep) {
          for (Stop& stop : stops) stop.relax();
        }
        for (const Stop& stop : stops) stop.heat(of_slot[c]);
        if (pressing.presses() && !stops.empty()) book_rest(pressing, sides, stops, of_slot[c]);
        for (std::size_t s = 0; held.any() && s < sides.size(); ++s) {
          if (sides[s].mass >= no_mass) of_slot[c].contact_heat += hold(sides[s], held.at(i, field(s)));
        }
      }
      at_node.spread();
    }
  });
  Balance total;
  for (const Balance& part : of_slot) total += part;
  return total;
}

}  // namespace whipple::contact
