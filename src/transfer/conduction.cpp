// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/conduction.hpp"

#include <algorithm>
#include <vector>

#include "src/core/parallel/threads.hpp"
#include "src/transfer/scalar_fields.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using grid::Node;
using scalars::fold_and_sum;
using scalars::gather;
using scalars::share;
constexpr auto particle_kind = BlockGrid::Points::particles;

constexpr double no_capacity = 1e-300;  // J/K; below it the temperature of a node has no meaning
/// Rate of the mixing within a cell over a/dx^2 (eq. 3): an exchange between particles and nodes at this rate
/// would conduct with the diffusivity a by itself. Temperatures stay in their range, unlike with twice as much.
constexpr double mixing_rate = 4.0;

/// Bodies that share nodes share their heat there, as far as they touch.
void join_fields(BlockGrid& grid, const TouchAtNode& touch) {
  const auto slots = grid.contact_slots().first(grid.owned_contact_slots());
  parallel::for_each(slots.size(), [&](std::size_t c) {
    const std::uint32_t slot = slots[c];
    std::vector<Lanes*> fields;
    std::vector<std::size_t> leader;  // of those that touch, the first
    for (std::size_t i = 0; i < grid::nodes_per_block; ++i) {
      fields.clear();
      leader.clear();
      grid.fields(slot).for_each([&](unsigned field) {
        leader.push_back(fields.size());
        fields.push_back(&grid.nodes(slot, field)[i].scalars.sums);
      });
      for (std::size_t b = 1; b < fields.size(); ++b) {
        for (std::size_t a = 0; a < b; ++a) {
          if (leader[a] == leader[b] || (touch && !touch(c, i, a, b))) continue;
          const std::size_t old = std::max(leader[a], leader[b]), first = std::min(leader[a], leader[b]);
          std::ranges::replace(leader, old, first);
        }
      }
      for (std::size_t b = 0; b < fields.size(); ++b) {
        if (leader[b] != b) *fields[leader[b]] += *fields[b];
      }
      for (std::size_t b = 0; b < fields.size(); ++b) *fields[b] = *fields[leader[b]];
    }
  });
}

}  // namespace

void conduct_heat(Particles& particles, BlockGrid& grid, double dt, std::span<const ThermalConstants> of_body,
                  const TouchAtNode& touch) {
  const auto constants = [&](std::size_t p) -> const ThermalConstants& { return of_body[particles.body[p]]; };
  const std::span<Node> nodes = grid.all_nodes();
  const auto for_each_owned_node = [&](auto&& f) {
    parallel::for_each(grid.owned_blocks(), [&](std::size_t b) {
      const std::size_t first = grid.owned_block(b) * grid::nodes_per_block;
      for (std::size_t i = first; i < first + grid::nodes_per_block; ++i) f(i);
    });
  };

  grid.clear();  // (eq. 1) heat capacity and temperature of the nodes
  scalars::scatter(particle_kind, grid, [&](Node& node, std::size_t p, double n, const Vector3&) {
    const double capacity = n * particles.mass[p] * constants(p).heat_capacity;
    node.scalars.sums += Lanes{capacity, capacity * particles.temperature[p], 0.0, 0.0};
  });
  fold_and_sum(grid);
  join_fields(grid, touch);
  for_each_owned_node([&](std::size_t i) {
    Lanes& first = nodes[i].scalars.sums;
    first[1] = first[0] > no_capacity ? first[1] / first[0] : 0.0;
  });
  share(grid);

  struct Flow {
    Vector3 flux;   // W m, -V k grad T
    double mixing;  // W, from the particle to its nodes
  };
  std::vector<Flow> flows(particles.size());  // (eq. 2, 3)
  const double dx = grid.geometry().cell_size;
  gather(grid, [&](std::size_t p, auto&& for_nodes) {
    Vector3 gradient = Vector3::Zero();
    double around = 0.0;
    for_nodes([&](const Node& node, double n, const Vector3& g) {
      gradient += node.scalars.sums[1] * g;
      around += node.scalars.sums[1] * n;
    });
    const double conductance = (particles.volume[p] + particles.void_volume[p]) * constants(p).conductivity;
    flows[p] = {-conductance * gradient,
                mixing_rate / (dx * dx) * conductance * (particles.temperature[p] - around)};
  });

  parallel::for_each(nodes.size(), [&](std::size_t i) {  // (eq. 4) heat of the nodes
    nodes[i].scalars.kept = nodes[i].scalars.sums;
    nodes[i].scalars.sums = broadcast(0.0);
  });
  scalars::scatter(particle_kind, grid, [&](Node& node, std::size_t p, double n, const Vector3& gradient) {
    node.scalars.sums += Lanes{gradient.dot(flows[p].flux) + n * flows[p].mixing, 0.0, 0.0, 0.0};
  });
  fold_and_sum(grid);
  join_fields(grid, touch);
  for_each_owned_node([&](std::size_t i) {
    const double capacity = nodes[i].scalars.kept[0];
    nodes[i].scalars.sums = capacity > no_capacity && !grid.is_image(i)
                                ? nodes[i].scalars.sums * (dt / capacity)
                                : broadcast(0.0);
  });
  share(grid);

  gather(grid, [&](std::size_t p, auto&& for_nodes) {  // (eq. 5)
    double rise = 0.0;
    for_nodes([&](const Node& node, double n, const Vector3&) { rise += n * node.scalars.sums[0]; });
    particles.specific_internal_energy[p] +=
        constants(p).heat_capacity * rise - dt * flows[p].mixing / particles.mass[p];
  });
}

}  // namespace whipple::transfer
