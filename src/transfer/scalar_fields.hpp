// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "src/core/parallel/threads.hpp"
#include "src/transfer/kernels.hpp"

/// Scalar fields on the grid by quadratic B-splines, also where the transfer takes wider functions, or by
/// linear functions where the transfer takes those, which reach no further: conduction, fill of the cells.
namespace whipple::transfer::scalars {

using grid::BlockGrid;
using grid::Node;
/// Calls work(Shape{}) with the functions of the scalars.
template <class Work>
void with_scalar_shape(const BlockGrid& grid, Work&& work) {
  const bool linear = grid.stencil().before() == 0;
  if (grid.stencil().planar) {
    linear ? work(InPlane<Linear>{}) : work(InPlane<QuadraticBSpline>{});
  } else {
    linear ? work(Linear{}) : work(QuadraticBSpline{});
  }
}

/// Weights of a point whose place is that of the run's stencil, which may begin a node before that of
/// `Shape`.
template <class Shape>
Weights<Shape::count> weights_in(const grid::Stencil& of_run, const grid::PlaceInStencil& place,
                                 double cell_size) {
  Lanes from_first = place.from_first();
  std::int32_t first_node = place.first_node();
  if (of_run.shift != Shape::stencil.shift) {
    constexpr int edge = Shape::stencil.edge(), edge_z = Shape::stencil.edge_z();
    const Lanes skipped = floor(from_first - broadcast(Shape::stencil.shift));
    from_first -= skipped;
    const double along_z = Planar<Shape> ? 0.0 : skipped[2];
    first_node += static_cast<std::int32_t>((skipped[0] * edge + skipped[1]) * edge_z + along_z);
  }
  Weights<Shape::count> w{Shape::weights(from_first, cell_size), first_node};
  if constexpr (Planar<Shape>) set_flat(w);
  return w;
}

/// Calls f(node, N, grad N) for the nodes of a point.
template <class Shape, class Access, class Function>
void for_each_node(BlockGrid::Points kind, std::size_t p, const BlockGrid& grid, Access& access,
                   Function&& f) {
  const Weights<Shape::count> w =
      weights_in<Shape>(grid.stencil(), grid.places(kind)[p], grid.geometry().cell_size);
  const auto nodes = access.stencil(w.first_node);
  for (std::size_t i = 0; i < Shape::count; ++i) {
    for (std::size_t j = 0; j < Shape::count; ++j) {
      for (std::size_t k = 0; k < count_z<Shape>; ++k) {
        const double wx = w.weight[i][0], wy = w.weight[j][1], wz = w.weight[k][2];
        const Vector3 gradient(w.derivative[i][0] * wy * wz, wx * w.derivative[j][1] * wz,
                               wx * wy * w.derivative[k][2]);
        f(nodes(i, j, k), wx * wy * wz, gradient);
      }
    }
  }
}

/// Adds what every point brings to its nodes: bring(node, p, N, grad N). what the node keeps stays as it is.
template <class Bring>
void scatter(BlockGrid::Points kind, BlockGrid& grid, Bring&& bring) {
  with_scalar_shape(grid, [&]<class Shape>(Shape) {
    grid.for_each_apart([&](std::size_t slot) {
      add_to_nodes<Lanes, Shape, Node>(
          grid, kind, slot, [&](std::span<const std::uint32_t> members, auto& access) {
            for (const std::uint32_t p : members) {
              for_each_node<Shape>(kind, p, grid, access, [&](Node& node, double n, const Vector3& gradient) {
                bring(node, p, n, gradient);
              });
            }
          });
    });
  });
}

/// Calls f(p, access to its nodes) for every particle, block by block.
template <class Function>
void gather(BlockGrid& grid, Function&& f) {
  constexpr auto kind = BlockGrid::Points::particles;
  with_scalar_shape(grid, [&]<class Shape>(Shape) {
    parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
      if (grid.particles_in(slot).empty()) return;
      read_nodes<Lanes, Shape, Node>(
          grid, kind, slot, [&](std::span<const std::uint32_t> members, auto& access) {
            for (const std::uint32_t p : members) {
              f(p, [&](auto&& of_node) { for_each_node<Shape>(kind, p, grid, access, of_node); });
            }
          });
    });
  });
}

/// Adds what particles brought beyond the mirror planes to the images. Scalars of the nodes beyond the planes
/// are those of their images.
/// @param apart_too  also of material that meets its image as another body; else its nodes beyond are its own
inline void fold(BlockGrid& grid, bool apart_too = true) {
  const std::span<Node> nodes = grid.all_nodes();
  for (const grid::MirrorPlane& plane : grid.mirror_planes()) {
    for (const auto* pairs : {&plane.pairs, &plane.pairs_apart}) {
      if (pairs == &plane.pairs_apart && !apart_too) continue;
      parallel::for_each(pairs->size(), [&](std::size_t i) {
        nodes[(*pairs)[i].image].scalars.sums += nodes[(*pairs)[i].outside].scalars.sums;
      });
    }
  }
}
/// Folds the values at mirror planes and adds the contributions of all ranks.
inline void fold_and_sum(BlockGrid& grid, bool apart_too = true) {
  fold(grid, apart_too);
  grid.sum_to_owners(BlockGrid::Part::first);
}

/// Lets other ranks and the nodes beyond the planes have what was found.
inline void share(BlockGrid& grid, bool apart_too = true) {
  grid.borrow_from_owners(BlockGrid::Part::first);
  const std::span<Node> nodes = grid.all_nodes();
  const auto planes = grid.mirror_planes();
  for (std::size_t n = planes.size(); n-- > 0;) {
    for (const auto* pairs : {&planes[n].pairs, &planes[n].pairs_apart}) {
      if (pairs == &planes[n].pairs_apart && !apart_too) continue;
      parallel::for_each(pairs->size(), [&](std::size_t i) {
        nodes[(*pairs)[i].outside].scalars.sums = nodes[(*pairs)[i].image].scalars.sums;
      });
    }
  }
}

}  // namespace whipple::transfer::scalars
