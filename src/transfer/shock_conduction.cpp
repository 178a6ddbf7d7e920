// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/shock_conduction.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/transfer/kernels.hpp"
#include "src/transfer/mixed.hpp"
#include "src/transfer/scalar_fields.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using grid::Node;

constexpr double no_capacity = 1e-300;  // J/K; below it the temperature of a node has no meaning
/// Largest fraction of the difference to the surrounding nodes that a particle may lose in a step, so that
/// temperatures remain in their range.
constexpr double largest_share = 0.9;

/// Exchange of a particle with its nodes.
class Exchange {
 public:
  Exchange(const Particles& particles, const grid::Geometry& geometry, double dt, double per_inertia,
           const ShockConduction& conduction)
      : particles_(particles),
        conduction_(conduction),
        geometry_(geometry),
        two_levels_(geometry.levels.are_two()),
        rate_(per_inertia * dt) {}

  [[nodiscard]] double heat_capacity(std::size_t p) const { return of_body(p).heat_capacity; }

  /// Fraction chi of its difference to the nodes that a particle loses in the step (eq. 8).
  [[nodiscard]] double share(std::size_t p) const {
    if (!(particles_.closing_rate[p] > 0.0)) return 0.0;
    const double edge = two_levels_ ? geometry_.cell_size_at(particles_.position[p]) : geometry_.cell_size;
    const double closing = particles_.closing_rate[p] * edge, sound_speed = particles_.sound_speed[p];
    const double above = closing - conduction_.onset * sound_speed;
    if (!(above > 0.0)) return 0.0;
    const double grown = std::min(1.0, above / (conduction_.rise * sound_speed));
    const ShockConductivity& body = of_body(p);
    const double speed = body.quadratic_viscosity * closing + body.linear_viscosity * sound_speed;
    return std::min(largest_share, conduction_.scale * (rate_ / edge) * grown * speed);
  }
  [[nodiscard]] bool conducts(std::size_t p) const { return share(p) > 0.0 && heat_capacity(p) > 0.0; }

 private:
  [[nodiscard]] const ShockConductivity& of_body(std::size_t p) const {
    return conduction_.of_body[particles_.body[p]];
  }
  const Particles& particles_;
  const ShockConduction& conduction_;
  const grid::Geometry& geometry_;
  bool two_levels_;
  double rate_;  // s
};

/// Contribution of a particle to its nodes: heat capacity C, C T, C chi.
struct Capacity {
  using Content = Lanes;
  static constexpr auto kind = BlockGrid::Points::particles;
  const Particles& points;
  const BlockGrid& grid;
  const Exchange& exchange;
  WHIPPLE_INLINE void prefetch_from(std::size_t p) const {
    prefetch(p, points.mass, points.temperature, points.closing_rate, points.sound_speed);
  }
  template <bool affine>
  [[nodiscard, gnu::always_inline]] Lanes load(std::size_t p) const {
    return is_mixed(grid, p) ? Lanes{} : payload(p);
  }
  [[nodiscard]] Lanes payload(std::size_t p) const {
    const double capacity = points.mass[p] * exchange.heat_capacity(p);
    return capacity * Lanes{1.0, points.temperature[p], exchange.share(p), 0.0};
  }
};

/// Marks the slots around marked ones, with these.
std::vector<std::uint64_t> around(const BlockGrid& grid, const std::vector<std::uint64_t>& marked) {
  std::vector<std::uint64_t> result(marked.size(), 0);
  for (std::size_t slot = 0; slot < marked.size(); ++slot) {
    if (marked[slot] == 0) continue;
    for (const std::int32_t near : grid.neighbours(slot)) {
      if (near != BlockGrid::no_slot) result[static_cast<std::size_t>(near)] = 1;
    }
  }
  return result;
}

/// Calls f(node) for all nodes of the marked slots below `end`, of all fields.
template <class Function>
void for_each_node(BlockGrid& grid, const std::vector<std::uint64_t>& marked, std::size_t end, Function&& f) {
  parallel::for_each(end, [&](std::size_t slot) {
    if (marked[slot] == 0) return;
    const auto of_field = [&](unsigned field) {
      Node* const nodes = grid.nodes(slot, field);
      for (std::size_t i = 0; i < grid::nodes_per_block; ++i) f(nodes[i]);
    };
    if (grid.contact_number(slot) == BlockGrid::no_slot) {
      of_field(0);
    } else {
      grid.fields(slot).for_each(of_field);
    }
  });
}

/// Nodes beyond a mirror plane may be folded onto others whose block is not next to theirs.
void clear_beyond_planes(BlockGrid& grid) {
  const std::span<Node> nodes = grid.all_nodes();
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    parallel::for_each(plane.pairs.size(),
                       [&](std::size_t i) { nodes[plane.pairs[i].outside].scalars.sums = broadcast(0.0); });
  }
}

/// The slots whose particles reach nodes that a conducting particle reaches; nothing if none does on any
/// rank.
std::optional<std::vector<std::uint64_t>> slots_at_shocks(BlockGrid& grid, const Exchange& exchange) {
  std::vector<std::uint64_t> marked(grid.slots(), 0);
  parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
    const auto conducts = [&](std::uint32_t p) { return exchange.conducts(p); };
    marked[slot] = std::ranges::any_of(grid.particles_in(slot), conducts) ? 1 : 0;
  });
  for (std::uint32_t k = 0; k < grid.mixed().size(); ++k) {  // to the nodes of the other level, too
    if (exchange.conducts(grid.mixed()[k].particle)) marked[grid.slot_of_part(2 * k + 1)] = 1;
  }
  const bool any = std::ranges::find(marked, 1U) != marked.end();
  if (!parallel::any(grid.communicator(), any)) return std::nullopt;
  marked = around(grid, marked);
  if (grid.is_shared()) {
    // A particle of one rank may reach, in a block of another, nodes that a conducting one of a third reaches.
    grid.join_bits_of_ranks(marked);
    marked = around(grid, marked);
  }
  for (std::uint32_t k = 0; k < grid.mixed().size(); ++k) {  // by what they reach on the other level
    if (marked[grid.slot_of_part(2 * k + 1)] != 0) marked[grid.slot_of_part(2 * k)] = 1;
  }
  return marked;
}

}  // namespace

double conduct_in_shocks(ShapeFunction shape, Particles& particles, BlockGrid& grid, double dt,
                         const ShockConduction& conduction) {
  return with_shape(shape, [&]<class Shape>(Shape) {
    constexpr double per_inertia = [] {
      if constexpr (CarriesAffineField<Shape>) return 1.0 / Shape::second_moment;
      return 4.0;  // of a hat over two cells, about as wide as those
    }();
    const Exchange exchange(particles, grid.geometry(), dt, per_inertia, conduction);
    const std::optional<std::vector<std::uint64_t>> found = slots_at_shocks(grid, exchange);
    if (!found) return 0.0;
    const std::vector<std::uint64_t>& taking_part = *found;
    std::vector<std::uint64_t> reached = taking_part;
    for (std::uint32_t k = 0; k < grid.mixed().size(); ++k) {
      if (taking_part[grid.slot_of_part(2 * k)] != 0) reached[grid.slot_of_part(2 * k + 1)] = 1;
    }
    reached = around(grid, reached);
    if (grid.is_shared()) std::ranges::fill(reached, 1U);  // contributions of other ranks are added to zero
    for_each_node(grid, reached, grid.slots(), [](Node& node) { node.scalars.sums = broadcast(0.0); });
    clear_beyond_planes(grid);

    const Capacity capacity{particles, grid, exchange};
    grid.for_each_apart([&](std::size_t slot) {
      if (taking_part[slot] == 0 || grid.particles_in(slot).empty()) return;
      with_kernels<Shape>(
          [&]<class Kernels>(Kernels) { Kernels::template scatter<Shape>(capacity, grid, slot, no_slopes); });
    });
    for (const BlockGrid::Region region : {BlockGrid::Region::border, BlockGrid::Region::interior}) {
      for_each_part_apart(grid, region, [&](std::uint32_t part) {
        if (taking_part[grid.slot_of_part(part)] == 0) return;
        const Lanes load = capacity.payload(grid.mixed_of_part(part).particle);
        for_each_node_of_part(
            plain::functions<Shape>(), particles, grid, part, no_slopes,
            [&](Node& node, const plain::AtNode& at) { plain::Kernels::add(load, at, node); });
      });
    }
    scalars::fold_and_sum(grid, false);
    for_each_node(grid, reached, grid.owned_slots(), [](Node& node) {  // chi T, chi
      const double capacity = node.scalars.sums[0];
      if (capacity < no_capacity) {
        node.scalars.sums = broadcast(0.0);
      } else {
        const double share = node.scalars.sums[2] / capacity;
        node.scalars.sums = Lanes{share * node.scalars.sums[1] / capacity, share, 0.0, 0.0};
      }
    });
    scalars::share(grid, false);

    std::vector<double> taken_up(grid.slots(), 0.0);
    parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {  // (eq. 9)
      if (taking_part[slot] == 0 || grid.particles_in(slot).empty()) return;
      double sum = 0.0;
      with_kernels<Shape>([&]<class Kernels>(Kernels) {
        const auto take = [&](std::size_t, std::size_t p, const ValueAndGradient<>& of_level) WHIPPLE_INLINE {
          const ValueAndGradient<> sums =
              is_mixed(grid, p) ? sums_of_mixed<Shape>(particles, grid, p, no_slopes, plain::First{})
                                : of_level;
          const double gain =
              exchange.heat_capacity(p) * (sums.value[0] - sums.value[1] * particles.temperature[p]);
          particles.specific_internal_energy[p] += gain;
          sum += particles.mass[p] * std::max(gain, 0.0);
        };
        Kernels::template gather<Shape>(particles, grid, Capacity::kind, slot, no_slopes,
                                        typename Kernels::First{}, take);
      });
      taken_up[slot] = sum;
    });
    double sum = 0.0;
    for (const double of_slot : taken_up) sum += of_slot;
    return sum;
  });
}

}  // namespace whipple::transfer
