// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/parallel/threads.hpp"

namespace whipple::contact {
namespace {

using grid::Node;

constexpr double no_mass = 1e-300;  // kg
constexpr int sweeps = 20;          // over the pairs, where more than two bodies meet

Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }

/// One field at a node.
struct Side {
  Node* node = nullptr;
  double mass = 0.0;
  double heat = 0.0;  // J
  [[nodiscard]] Vector3 before() const { return vector(node->first); }
  [[nodiscard]] Vector3 after() const { return vector(node->first) + vector(node->second); }
  void push(const Vector3& impulse) {
    const Vector3 change = impulse / mass;
    node->second += Lanes{change[0], change[1], change[2], 0.0};
  }
};

/// Two fields that meet at a node (docs/theory/contact.md, equations 4.1 to 4.6); velocities are those of b
/// relative to a.
struct Pair {
  Side* a;
  Side* b;
  Vector3 normal;
  double reduced_mass;
  double target;                      // normal velocity after the step
  double grip;                        // largest tangential impulse that makes no energy
  double pushed = 0.0;                // normal impulse, N s
  Vector3 dragged = Vector3::Zero();  // tangential impulse on b, N s

  Pair(Side& first, Side& second, const Vector3& n, double closing)
      : a(&first), b(&second), normal(n), reduced_mass(a->mass * b->mass / (a->mass + b->mass)) {
    const Vector3 old = b->before() - a->before(), free = b->after() - a->after();
    target = -std::max(closing, n.dot(old));
    const Vector3 slip = tangential(free);
    const double speed2 = slip.squaredNorm();
    grip = speed2 > 0.0
               ? std::clamp(1.0 + slip.dot(old) / speed2, 0.0, 1.0) * reduced_mass * std::sqrt(speed2)
               : 0.0;
  }

  [[nodiscard]] Vector3 tangential(const Vector3& v) const { return v - normal.dot(v) * normal; }

  void relax(double friction) {
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

  /// Books what the impulses took from the bodies, half of it to either.
  void heat(Balance& balance) const {
    const Vector3 mean = 0.5 * (b->before() - a->before() + b->after() - a->after());
    const double by_push = -pushed * normal.dot(mean), by_drag = -dragged.dot(mean);
    balance += {by_push, by_drag, pushed, dragged.norm()};
    a->heat += 0.5 * (by_push + by_drag);
    b->heat += 0.5 * (by_push + by_drag);
  }
};

}  // namespace

Balance Contact::apply(grid::BlockGrid& grid, double dt) const {
  const double near = settings_.gap * grid.geometry().cell_size;
  std::vector<Balance> of_slot(grid.owned_contact_slots());
  parallel::for_each(grid.owned_contact_slots(), [&](std::size_t c) {
    const std::uint32_t slot = grid.contact_slots()[c];
    const auto fields = static_cast<std::size_t>(std::popcount(grid.fields(slot)));
    std::vector<Side> sides(fields);
    std::vector<Pair> pairs;
    for (int i = 0; i < grid::nodes_per_block; ++i) {
      std::size_t next = 0;
      grid::for_each_bit(grid.fields(slot), [&](unsigned field) {
        Node* node = grid.nodes(slot, field) + i;
        sides[next++] = {node, node->second[3], 0.0};
        node->second[3] = 0.0;
      });
      pairs.clear();
      for (std::size_t a = 0; a < fields; ++a) {
        for (std::size_t b = a + 1; b < fields; ++b) {
          if (sides[a].mass < no_mass || sides[b].mass < no_mass) continue;
          const Surfaces::Gap gap =
              surfaces_.at(c, Surfaces::pair_index(a, b, fields), static_cast<std::size_t>(i));
          if (gap.normal.isZero(0.0)) continue;
          const double open = settings_.gap_test ? std::max(gap.width - near, 0.0) : 0.0;
          pairs.emplace_back(sides[a], sides[b], gap.normal, open / dt);
        }
      }
      const int repeat = pairs.size() > 1 ? sweeps : 1;
      for (int sweep = 0; sweep < repeat; ++sweep) {
        for (Pair& pair : pairs) pair.relax(settings_.friction);
      }
      for (const Pair& pair : pairs) pair.heat(of_slot[c]);
      for (Side& side : sides) {
        if (side.heat != 0.0) side.node->second[3] = side.heat / side.mass;
      }
    }
  });
  Balance total;
  for (const Balance& part : of_slot) total += part;
  return total;
}

}  // namespace whipple::contact
