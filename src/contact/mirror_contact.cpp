// SPDX-License-Identifier: BSD-3-Clause
#include "src/contact/mirror_contact.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/transfer/momentum.hpp"

namespace whipple::contact {
namespace {

using grid::BlockGrid;
using grid::Node;
using grid::nodes_per_block;
using transfer::is_among;
using transfer::no_mass;

/// Gap, in cells, below which material sticks to a no-slip wall.
constexpr double sticking_gap = 0.04;

/// Returns 1 for the components that reflection reverses, in lanes 0 to 2.
Lanes reversed(grid::Boundary kind, int axis) {
  Lanes lanes{};
  for (int c = 0; c < 3; ++c) {
    if (kind == grid::Boundary::no_slip || c == axis) lanes[c] = 1.0;
  }
  return lanes;
}
Lanes reversed(const grid::MirrorPlane& plane) { return reversed(plane.kind, plane.axis); }

/// Returns the fraction of the step in which two surfaces are in contact (3.9), from their closing speed (m/s) at its
/// end.
double share_in_touch(double gap, double closing_speed, double dt) {
  if (gap <= 0.0) return 1.0;
  if (!(closing_speed > 0.0)) return 0.0;
  return std::clamp(1.0 - gap / (dt * closing_speed), 0.0, 1.0);
}

/// Returns beta of the common field of two nodes (3.8); 0 if either has none, as at element nodes.
double common_relaxation(double mass, double beta, double other_mass, double other_beta) {
  if (beta == other_beta) return beta;
  if (beta == 0.0 || other_beta == 0.0) return 0.0;
  return -std::expm1((mass * std::log1p(-beta) + other_mass * std::log1p(-other_beta)) / (mass + other_mass));
}

/// Computes the loss of kinetic energy and work (J) of the points of a node because they use the motion `taken` instead
/// of the uncoupled motion of the node (3.12).
double loss(Lanes own_velocity, Lanes own_increment, const grid::NodeMotion& taken) {
  const double mass = own_velocity[3], beta = taken.relaxation();
  const Lanes v = taken.velocity_and_relaxation, d = taken.increment_and_heat;
  return mass *
         sum3((own_increment - d) * (v + 0.5 * d) - (own_velocity - v) * ((1.0 - beta) * d - beta * v));
}

/// Describes a node in contact with its image at a wall with friction, before and after the normal contact.
struct Rubbing {
  const Lanes* uncoupled;  // velocity and increment
  double mass;             // kg
  Lanes velocity, increment;
  grid::NodeMotion& motion;

  /// Returns the normal velocity (m/s) that the contact gave to the points of the node.
  [[nodiscard]] double given(int axis) const {
    const Lanes change = motion.increment_and_heat - increment +
                         motion.relaxation() * (motion.velocity_and_relaxation - velocity);
    return change[axis];
  }
  [[nodiscard]] Lanes after() const { return motion.velocity_and_relaxation + motion.increment_and_heat; }
  /// Returns the velocity z by which the work of an impulse on the points is computed (3.13).
  [[nodiscard]] Lanes mean() const {
    const double beta = motion.relaxation();
    return beta * motion.velocity_and_relaxation + (1.0 - beta) * uncoupled[0] + motion.increment_and_heat -
           0.5 * uncoupled[1];
  }
};

/// Applies the Coulomb friction of a wall (3.13): the image moves along the wall as the material does, in the opposite
/// direction, so that material and image at rest with each other are at rest with the wall.
/// @param outward  component of the normal of the wall along the axis, 1 or -1
void rub(const Rubbing& at_node, const Rubbing& at_mirror, bool on_plane, double friction, int axis,
         double outward) {
  Lanes along = broadcast(1.0);
  along[3] = along[axis] = 0.0;
  const Lanes slip = along * (at_node.after() + at_mirror.after());
  const double speed2 = sum3(slip * slip);
  if (!(speed2 > 0.0)) return;
  const double reduced = at_node.mass * at_mirror.mass / (at_node.mass + at_mirror.mass);
  const double power = sum3(slip * (at_node.mean() + at_mirror.mean()));
  const double grip = 2.0 * reduced * std::max(power / speed2, 0.0);
  const double pressed = -std::max(outward * at_node.mass * at_node.given(axis),
                                   outward * at_mirror.mass * at_mirror.given(axis));
  const double limit = friction * std::max(pressed, 0.0) / std::sqrt(speed2);
  const Lanes impulse = std::min({reduced, grip, limit}) * slip;
  at_node.motion.increment_and_heat -= impulse / at_node.mass;
  if (!on_plane) at_mirror.motion.increment_and_heat -= impulse / at_mirror.mass;
}

}  // namespace

void MirrorContact::lay_out(const BlockGrid& grid) {
  if (layout_ == grid.layout()) return;
  layout_ = grid.layout();
  friction_ = grid.geometry().friction;
  planes_.clear();
  first_of_block_.clear();
  folded_.clear();
  std::vector<std::uint8_t> concerned(grid.slots(), 0);
  for (const grid::MirrorPlane& mirror : grid.mirror_planes()) {
    if (!grid.is_apart_at(static_cast<std::size_t>(mirror.face))) continue;
    Plane& plane = planes_.emplace_back();
    plane.of.face = mirror.face;
    plane.of.axis = mirror.axis;
    plane.of.kind = mirror.kind;
    const auto axis = static_cast<std::size_t>(mirror.axis);
    for (std::size_t s = 0; s < grid.slots(); ++s) {
      const std::int32_t at = mirror.face % 2 == 0 ? 0 : grid.geometry(s).cells[axis];
      const int edge = grid.block_shape().along(axis);
      const std::int32_t first = grid.coordinate(s)[axis] * edge;
      if (first <= at + BlockGrid::mirror_reach && first + edge - 1 >= at - BlockGrid::mirror_reach) {
        concerned[s] = 1;
      }
    }
  }
  for (grid::SlotValues* values : {&extent_, &own_}) {
    values->begin.assign(1, 0);
    values->values.clear();
  }
  if (planes_.empty()) return;
  first_of_block_.assign(grid.all_nodes().size() / nodes_per_block, nowhere);
  coupled_.assign(first_of_block_.size(), 0);
  near_.assign(grid.slots(), 0);
  std::uint32_t next = 0;
  for (std::size_t s = 0; s < grid.slots(); ++s) {
    if (concerned[s] != 0) {
      for (std::size_t i = 0; i < grid.node_blocks(s); ++i) {
        first_of_block_[grid.node_block(s, i)] = next;
        next += static_cast<std::uint32_t>(lanes_per_node * nodes_per_block);
      }
    }
    extent_.begin.push_back(next);
  }
  own_.begin = extent_.begin;
  own_.values.assign(next, Lanes{});
  extent_.values.assign(next, broadcast(-std::numeric_limits<double>::infinity()));
  heat_.assign(next / lanes_per_node, 0.0);
  const auto both_concern = [&](const grid::MirrorPair& pair) {
    return concerns_block(pair.outside / nodes_per_block) && concerns_block(pair.image / nodes_per_block);
  };
  auto plane = planes_.begin();
  const auto mirrors = grid.mirror_planes();
  const auto cell_size = [&](std::uint32_t node) { return grid.geometry_of_node(node).cell_size; };
  for (const grid::MirrorPlane& mirror : mirrors) {
    if (!grid.is_apart_at(static_cast<std::size_t>(mirror.face))) continue;
    for (const grid::MirrorPair& pair : mirror.pairs_apart) {
      if (both_concern(pair)) plane->couples.push_back({pair.image, pair.outside, cell_size(pair.image)});
    }
    for (const std::uint32_t node : mirror.on_plane_apart) {
      plane->couples.push_back({node, node, cell_size(node)});
    }
    for (const grid::MirrorPlane& opposite : mirrors) {
      if (opposite.face != (mirror.face ^ 1)) continue;
      plane->opposite = opposite.kind;
      const std::unordered_set<std::uint32_t> held(opposite.on_plane.begin(), opposite.on_plane.end());
      for (Couple& couple : plane->couples) couple.is_held = held.contains(couple.node);
    }
    plane->share.assign(plane->couples.size(), 0.0);
    for (const Couple& couple : plane->couples) {
      coupled_[couple.node / nodes_per_block] = coupled_[couple.mirror / nodes_per_block] = 1;
    }
    ++plane;
  }
  for (std::size_t s = 0; s < grid.slots(); ++s) {
    if (concerned[s] == 0) continue;
    bool any = false;
    for (std::size_t i = 0; i < grid.node_blocks(s); ++i) any = any || coupled_[grid.node_block(s, i)] != 0;
    for (const std::int32_t neighbour : grid.neighbours(s)) {
      if (any && neighbour != BlockGrid::no_slot) near_[static_cast<std::size_t>(neighbour)] = 1;
    }
  }
  // Counted from the positions of the nodes, not from the blocks that happen to be active around them.
  std::vector<std::uint8_t> planes_of(heat_.size(), 0);
  const auto count = [&](std::uint32_t node) {
    if (concerns_block(node / nodes_per_block)) ++planes_of[place(node) / lanes_per_node];
  };
  for (const grid::MirrorPlane& mirror : mirrors) {
    if (!grid.is_apart_at(static_cast<std::size_t>(mirror.face))) continue;
    for (const std::uint32_t node : mirror.near) count(node);
    for (const std::uint32_t node : mirror.on_plane_apart) count(node);
    for (const grid::MirrorPair& pair : mirror.pairs_apart) count(pair.outside);
  }
  for (Plane& of : planes_) {
    for (std::uint32_t c = 0; c < of.couples.size(); ++c) {
      const Couple& couple = of.couples[c];
      if (std::min(planes_of[place(couple.node) / lanes_per_node],
                   planes_of[place(couple.mirror) / lanes_per_node]) > 1) {
        of.at_corners.push_back(c);
      }
    }
  }
  for (std::size_t n = mirrors.size(); n-- > 0;) {
    for (const grid::MirrorPair& pair : mirrors[n].pairs) {
      if (both_concern(pair)) folded_.push_back(pair);
    }
  }
}

void MirrorContact::remember(BlockGrid& grid) {
  made_heat_ = false;
  if (planes_.empty()) return;
  std::ranges::fill(heat_, 0.0);
  const std::span<Node> nodes = grid.all_nodes();
  parallel::for_each(grid.owned_blocks(), [&](std::size_t b) {
    const std::size_t block = grid.owned_block(b);
    if (!concerns_block(block)) return;
    for (std::size_t i = block * nodes_per_block; i < (block + 1) * nodes_per_block; ++i) {
      Lanes* own = &own_.values[place(static_cast<std::uint32_t>(i))];
      grid::NodeMotion& motion = nodes[i].motion;
      own[0] = motion.velocity_and_relaxation;
      own[1] = motion.increment_and_heat;
      own[0][3] = motion.mass_for_contact();
      if (!grid.is_contact_block(block)) motion.set_heat(0.0);
    }
  });
}

void MirrorContact::tell_others(BlockGrid& grid) {
  if (!planes_.empty() && grid.is_shared()) grid.borrow_from_owners(own_);
}

/// Returns the gap (m) between material and image at a couple of nodes (3.7), as between two bodies whose extents are
/// found at one node each.
double MirrorContact::gap(const Plane& plane, const Couple& couple) const {
  const auto upper = static_cast<std::size_t>(plane.of.face % 2);
  const auto extent = [&](std::uint32_t node) { return extent_.values[place(node) + upper][plane.of.axis]; };
  return -(extent(couple.node) + extent(couple.mirror));
}

/// Adds heat (J/kg) to a node.
void MirrorContact::add_heat(grid::NodeMotion& motion, std::uint32_t node, double heat) {
  motion.increment_and_heat[3] += heat;
  heat_[place(node) / lanes_per_node] += heat;
}

bool MirrorContact::sticks(const Plane& plane, const Couple& couple, double gap) {
  return plane.of.kind == grid::Boundary::no_slip && gap < sticking_gap * couple.cell_size;
}

/// Returns, by component, the weight of a node in the common velocity with the image at it: 1 for the components held
/// by the opposite plane, its mass fraction otherwise.
Lanes MirrorContact::part_of_node(const Plane& plane, const Couple& couple, double mass, double other_mass) {
  const Lanes held = couple.is_held ? reversed(plane.opposite, plane.of.axis) : Lanes{};
  return held + (1.0 - held) * (mass / (mass + other_mass));
}

/// Assigns one beta to all images of a node where planes intersect: otherwise the coupling at one plane would
/// change with the next one. (beta has no effect at nodes with an independent step.)
void MirrorContact::join_relaxation_at_corners(BlockGrid& grid, transfer::Nodes which) {
  const std::span<Node> nodes = grid.all_nodes();
  joint_mass_.resize(heat_.size());
  const auto mass_of = [&](std::uint32_t node) -> double& {
    return joint_mass_[place(node) / lanes_per_node];
  };
  for (const Plane& plane : planes_) {
    for (const std::uint32_t c : plane.at_corners) {
      for (const std::uint32_t node : {plane.couples[c].node, plane.couples[c].mirror}) {
        mass_of(node) = own_.values[place(node)][3];
      }
    }
  }
  for (const Plane& plane : planes_) {
    for (const std::uint32_t c : plane.at_corners) {
      const Couple& couple = plane.couples[c];
      if (couple.node == couple.mirror || !is_among(grid, couple.node, which)) continue;
      double &mass = mass_of(couple.node), &other_mass = mass_of(couple.mirror);
      if (mass < no_mass || other_mass < no_mass) continue;
      Lanes &first = nodes[couple.node].motion.velocity_and_relaxation,
            &other = nodes[couple.mirror].motion.velocity_and_relaxation;
      const double beta = common_relaxation(mass, first[3], other_mass, other[3]);
      for (const std::uint32_t node : {couple.node, couple.mirror}) {
        // Contact of bodies may have changed the velocity already: its energy depends on beta (3.12).
        Lanes* const own = &own_.values[place(node)];
        grid::NodeMotion& motion = nodes[node].motion;
        const double before = loss(own[0], own[1], motion);
        motion.set_relaxation(beta);
        const double heat = (loss(own[0], own[1], motion) - before) / own[0][3];
        if (heat == 0.0) continue;
        add_heat(motion, node, heat);
        made_heat_ = true;
      }
      mass = other_mass = mass + other_mass;
    }
  }
}

/// Applies contact between the material at a node and its image, and between the material at the mirror node and its
/// image, (3.8) to (3.12).
/// @returns the fraction of the step in which they are in contact
double MirrorContact::meet(const Plane& plane, const Couple& couple, std::span<Node> nodes, double dt) {
  Lanes* const own = &own_.values[place(couple.node)];
  Lanes* const own_of_mirror = &own_.values[place(couple.mirror)];
  const double mass = own[0][3], other_mass = own_of_mirror[0][3];
  if (mass < no_mass || other_mass < no_mass) return 0.0;
  const double open = gap(plane, couple);
  const Lanes mixed = reversed(plane.of), sign = 1.0 - 2.0 * mixed;
  grid::NodeMotion& node = nodes[couple.node].motion;
  grid::NodeMotion& mirror = nodes[couple.mirror].motion;
  // Image at the node
  const Lanes v = node.velocity_and_relaxation, d = node.increment_and_heat,
              v_image = sign * mirror.velocity_and_relaxation, d_image = sign * mirror.increment_and_heat;
  const double n = plane.of.outward();
  const double w = n * (v_image - v)[plane.of.axis], e = n * (d_image - d)[plane.of.axis];
  const double beta = common_relaxation(mass, v[3], other_mass, v_image[3]);
  if (touches_ != nullptr) touches_->see_face(static_cast<std::size_t>(plane.of.face), open, -(w + e));
  const bool held = sticks(plane, couple, open);
  const double share = held ? 1.0 : share_in_touch(open, -(w + e), dt);
  if (!(share > 0.0)) return 0.0;
  const double before = loss(own[0], own[1], node) + loss(own_of_mirror[0], own_of_mirror[1], mirror);
  const bool on_plane = couple.node == couple.mirror;
  const Lanes part = part_of_node(plane, couple, mass, other_mass);
  if (beta > 0.0 || held) {
    if (!held && !(e + beta * w < 0.0)) return 0.0;  // in tension
    const Lanes to_common = share * mixed;
    const Lanes v_common = part * v + (1.0 - part) * v_image;
    const Lanes d_common = part * d + (1.0 - part) * d_image;
    node.velocity_and_relaxation = v + to_common * (v_common - v);
    node.increment_and_heat = d + to_common * (d_common - d);
    node.set_relaxation(beta);
    if (!on_plane) {
      mirror.velocity_and_relaxation = sign * (v_image + to_common * (v_common - v_image));
      mirror.increment_and_heat = sign * (d_image + to_common * (d_common - d_image));
      mirror.set_relaxation(beta);
    }
  } else {  // (3.11): a common velocity of the nodes would not slow points that are not relaxed towards it
    const double stopped = -(w + e) - std::max(std::max(open, 0.0) / dt, w);
    if (!(stopped > 0.0)) return 0.0;
    const double own_part = part[plane.of.axis];
    node.increment_and_heat[plane.of.axis] -= (1.0 - own_part) * n * stopped;
    if (!on_plane) mirror.increment_and_heat[plane.of.axis] -= own_part * n * stopped;
  }
  if (plane.of.kind == grid::Boundary::friction) {
    rub({own, mass, v, d, node}, {own_of_mirror, other_mass, sign * v_image, sign * d_image, mirror},
        on_plane, friction_, plane.of.axis, n);
  }
  const double after = loss(own[0], own[1], node) + loss(own_of_mirror[0], own_of_mirror[1], mirror);
  const double half = 0.5 * (after - before);
  add_heat(node, couple.node, half / mass);
  if (!on_plane) add_heat(mirror, couple.mirror, half / other_mass);
  return share;
}

void MirrorContact::apply(BlockGrid& grid, double dt, transfer::Nodes which) {
  if (planes_.empty()) return;
  const std::span<Node> nodes = grid.all_nodes();
  join_relaxation_at_corners(grid, which);
  for (Plane& plane : planes_) {
    parallel::for_each(plane.couples.size(), [&](std::size_t i) {
      if (is_among(grid, plane.couples[i].node, which))
        plane.share[i] = meet(plane, plane.couples[i], nodes, dt);
    });
    made_heat_ = made_heat_ || std::ranges::any_of(plane.share, [](double share) { return share > 0.0; });
  }
  for (const grid::MirrorPair& pair : folded_) {
    if (is_among(grid, pair.outside, which))
      heat_[place(pair.outside) / lanes_per_node] = heat_[place(pair.image) / lanes_per_node];
  }
  shares_known_ = true;
}

void MirrorContact::apply_to_velocities(BlockGrid& grid, transfer::Nodes which) {
  const std::span<Node> nodes = grid.all_nodes();
  for (Plane& plane : planes_) {
    const Lanes mixed = reversed(plane.of), sign = 1.0 - 2.0 * mixed;
    parallel::for_each(plane.couples.size(), [&](std::size_t i) {
      const Couple& couple = plane.couples[i];
      if (!is_among(grid, couple.node, which)) return;
      Lanes& v = nodes[couple.node].motion.velocity_and_relaxation;
      Lanes& of_mirror = nodes[couple.mirror].motion.velocity_and_relaxation;
      const double mass = v[3], other_mass = of_mirror[3];
      if (mass < no_mass || other_mass < no_mass) return;
      const Lanes v_image = sign * of_mirror;
      double share = plane.share[i];
      if (!shares_known_) {
        const double open = gap(plane, couple);
        const double closing = plane.of.outward() * (v - v_image)[plane.of.axis];
        share = sticks(plane, couple, open) ? 1.0 : closing > 0.0 ? share_in_touch(open, closing, dt_) : 0.0;
      }
      const Lanes to_common = share * mixed;
      const Lanes part = part_of_node(plane, couple, mass, other_mass);
      const Lanes common = part * v + (1.0 - part) * v_image;
      const Lanes changed = v + to_common * (common - v);
      if (couple.node != couple.mirror) of_mirror = sign * (v_image + to_common * (common - v_image));
      v = changed;
    });
  }
}

}  // namespace whipple::contact
