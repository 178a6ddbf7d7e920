// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/conduction.hpp"

#include <vector>

#include "src/parallel/threads.hpp"
#include "src/transfer/kernels.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;
using grid::Node;
using Shape = QuadraticBSpline;

constexpr double no_capacity = 1e-300;  // J/K; below it the temperature of a node has no meaning

/// Calls f(node, N, grad N) for the nodes of a particle.
template <class Access, class Function>
void for_each_node(const Particles& particles, std::size_t p, const BlockGrid& grid, Access& access,
                   Function&& f) {
  const grid::PlaceInStencil& place = grid.places(BlockGrid::Points::particles)[p];
  const Weights<Shape::count> w = weights_at<Shape>(particles, p, place, grid.geometry().cell_size);
  const auto nodes = access.stencil(w.first_node);
  for (std::size_t i = 0; i < Shape::count; ++i) {
    for (std::size_t j = 0; j < Shape::count; ++j) {
      for (std::size_t k = 0; k < Shape::count; ++k) {
        const double wx = w.weight[i][0], wy = w.weight[j][1], wz = w.weight[k][2];
        const Vector3 gradient(w.derivative[i][0] * wy * wz, wx * w.derivative[j][1] * wz,
                               wx * wy * w.derivative[k][2]);
        f(nodes(i, j, k), wx * wy * wz, gradient);
      }
    }
  }
}

/// Adds what every particle brings to its nodes: bring(node, p, N, grad N). Node::second stays as it is.
template <class Bring>
void scatter(const Particles& particles, BlockGrid& grid, Bring&& bring) {
  grid.for_each_apart([&](std::size_t slot) {
    narrow::add_to_nodes<Shape, Node>(
        grid, BlockGrid::Points::particles, slot, [&](std::span<const std::uint32_t> members, auto& access) {
          for (const std::uint32_t p : members) {
            for_each_node(particles, p, grid, access, [&](Node& node, double n, const Vector3& gradient) {
              bring(node, p, n, gradient);
            });
          }
        });
  });
}

/// Calls f(p, access to its nodes) for every particle, block by block.
template <class Function>
void gather(const Particles& particles, BlockGrid& grid, Function&& f) {
  parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
    if (grid.particles_in(slot).empty()) return;
    narrow::read_nodes<Shape, Node>(
        grid, BlockGrid::Points::particles, slot, [&](std::span<const std::uint32_t> members, auto& access) {
          for (const std::uint32_t p : members) {
            f(p, [&](auto&& of_node) { for_each_node(particles, p, grid, access, of_node); });
          }
        });
  });
}

/// Scalars of the nodes beyond the mirror planes are those of their images, so what particles brought there
/// belongs to the images. Bodies that share nodes share their heat, whatever velocity fields they have.
void fold_and_sum(BlockGrid& grid) {
  const std::span<Node> nodes = grid.all_nodes();
  for (const BlockGrid::MirrorPlane& plane : grid.mirror_planes()) {
    for (const auto* pairs : {&plane.pairs, &plane.pairs_apart}) {
      parallel::for_each(pairs->size(), [&](std::size_t i) {
        nodes[(*pairs)[i].image].first += nodes[(*pairs)[i].outside].first;
      });
    }
  }
  grid.sum_to_owners(BlockGrid::Part::first);
  for (const std::uint32_t slot : grid.contact_slots().first(grid.owned_contact_slots())) {
    for (int i = 0; i < grid::nodes_per_block; ++i) {
      Lanes sum = broadcast(0.0);
      grid::for_each_bit(grid.fields(slot), [&](unsigned field) { sum += grid.nodes(slot, field)[i].first; });
      grid::for_each_bit(grid.fields(slot), [&](unsigned field) { grid.nodes(slot, field)[i].first = sum; });
    }
  }
}

void share(BlockGrid& grid) {
  grid.borrow_from_owners(BlockGrid::Part::first);
  const std::span<Node> nodes = grid.all_nodes();
  const auto planes = grid.mirror_planes();
  for (std::size_t n = planes.size(); n-- > 0;) {
    for (const auto* pairs : {&planes[n].pairs, &planes[n].pairs_apart}) {
      parallel::for_each(pairs->size(), [&](std::size_t i) {
        nodes[(*pairs)[i].outside].first = nodes[(*pairs)[i].image].first;
      });
    }
  }
}

}  // namespace

void conduct_heat(Particles& particles, BlockGrid& grid, double dt,
                  std::span<const ThermalConstants> of_body) {
  const auto constants = [&](std::size_t p) -> const ThermalConstants& { return of_body[particles.body[p]]; };
  const std::span<Node> nodes = grid.all_nodes();
  const auto for_each_owned_node = [&](auto&& f) {
    parallel::for_each(grid.owned_blocks(), [&](std::size_t b) {
      const std::size_t first = grid.owned_block(b) * grid::nodes_per_block;
      for (std::size_t i = first; i < first + grid::nodes_per_block; ++i) f(i);
    });
  };

  grid.clear();  // (eq. 1) heat capacity and temperature of the nodes
  scatter(particles, grid, [&](Node& node, std::size_t p, double n, const Vector3&) {
    const double capacity = n * particles.mass[p] * constants(p).heat_capacity;
    node.first += Lanes{capacity, capacity * particles.temperature[p], 0.0, 0.0};
  });
  fold_and_sum(grid);
  for_each_owned_node([&](std::size_t i) {
    Lanes& first = nodes[i].first;
    first[1] = first[0] > no_capacity ? first[1] / first[0] : 0.0;
  });
  share(grid);

  std::vector<Vector3> flux(particles.size());  // (eq. 2) -V k grad T of the particles
  gather(particles, grid, [&](std::size_t p, auto&& for_nodes) {
    Vector3 gradient = Vector3::Zero();
    for_nodes([&](const Node& node, double, const Vector3& g) { gradient += node.first[1] * g; });
    flux[p] = -(particles.volume[p] + particles.void_volume[p]) * constants(p).conductivity * gradient;
  });

  parallel::for_each(nodes.size(), [&](std::size_t i) {  // (eq. 3) heat of the nodes
    nodes[i].second = nodes[i].first;
    nodes[i].first = broadcast(0.0);
  });
  scatter(particles, grid, [&](Node& node, std::size_t p, double, const Vector3& gradient) {
    node.first += Lanes{gradient.dot(flux[p]), 0.0, 0.0, 0.0};
  });
  fold_and_sum(grid);
  for_each_owned_node([&](std::size_t i) {
    const double capacity = nodes[i].second[0];
    nodes[i].first =
        capacity > no_capacity && !grid.is_image(i) ? nodes[i].first * (dt / capacity) : broadcast(0.0);
  });
  share(grid);

  gather(particles, grid, [&](std::size_t p, auto&& for_nodes) {  // (eq. 4)
    double rise = 0.0;
    for_nodes([&](const Node& node, double n, const Vector3&) { rise += n * node.first[0]; });
    particles.specific_internal_energy[p] += constants(p).heat_capacity * rise;
  });
}

}  // namespace whipple::transfer
