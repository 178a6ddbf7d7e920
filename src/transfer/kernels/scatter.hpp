// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "src/transfer/kernels/access.hpp"
#include "src/transfer/point_values.hpp"
#include "src/transfer/shape_weights.hpp"

/// Contributions of points to their nodes.
namespace whipple::transfer {

/// Points whose weights are computed together.
constexpr std::size_t ahead = 8;

/// Calls f(points of a block, their weights) for a few points at a time: weights are a long chain of
/// dependent instructions, and too far from those of the next point for the processor to see.
/// @tparam with_weights  else they are left open
template <class Shape, bool with_weights = true, class Points, class Function>
WHIPPLE_INLINE inline void for_some(const Points& points, std::span<const grid::PlaceInStencil> places,
                                    const Cells& cells, std::span<const std::uint32_t> members,
                                    Function&& f) {
  std::array<Weights<Shape::count>, ahead> weights;
  for (std::size_t first = 0; first < members.size(); first += ahead) {
    const std::span<const std::uint32_t> some =
        members.subspan(first, std::min(ahead, members.size() - first));
    for (std::size_t m = 0; with_weights && m < some.size(); ++m) {
      weights[m] = weights_at<Shape>(points, some[m], places[some[m]], cells);
    }
    f(some, weights);
  }
}

/// Distributes contributions weighted with N, and contributions weighted with slopes, whose sum over the
/// nodes vanishes, to the nodes of one direction: of three nodes the middle one, with the largest N, receives
/// the remainder.
template <class Both, std::size_t n>
WHIPPLE_INLINE inline std::array<Both, n> shares(const std::array<Both, n>& weight,
                                                 const std::array<Both, n>& slope, const Both& whole,
                                                 const Both& of_slope) {
  std::array<Both, n> share;
  for (std::size_t k = 0; k < n; ++k) {
    if (n == 3 && k == 1) continue;
    share[k] = multiply_add(slope[k], of_slope, weight[k] * whole);
  }
  if constexpr (n == 3) share[1] = whole - (share[0] + share[2]);
  return share;
}
template <class Both, std::size_t n>
WHIPPLE_INLINE inline std::array<Both, n> shares(const std::array<Both, n>& weight, const Both& whole) {
  std::array<Both, n> share;
  for (std::size_t k = 0; k < n; ++k) {
    if (n == 3 && k == 1) continue;
    share[k] = weight[k] * whole;
  }
  if constexpr (n == 3) share[1] = whole - multiply_add(weight[2], whole, share[0]);
  return share;
}

/// Adds the contributions of a point to its nodes (equation 4.1 and the forces): node += N P_0 + sum over directions
/// of S_a P_a, with S_a = N r_a in the first register and the slope of N in the second.
template <class Vector, class Shape, class Stencil>
WHIPPLE_INLINE inline void add_payload(const Payload& load, const Weights<Shape::count>& w,
                                       const Stencil& nodes) {
  using Both = BothRegisters<Vector>;
  constexpr std::size_t n = Shape::count;
  constexpr bool affine = CarriesAffineField<Shape>;  // else the first register takes no slopes
  struct Factors {
    std::array<Both, n> weight, slope;
  };
  const auto direction = [&](std::size_t a) WHIPPLE_INLINE {
    Factors along;
    for (std::size_t k = 0; k < n; ++k) {
      const double weight = w.weight[k][a];
      along.weight[k] = broadcast_both<Vector>(weight);
      along.slope[k] = broadcast_both<Vector>(affine ? weight * w.distance[k][a] : 0.0, w.derivative[k][a]);
    }
    return along;
  };
  const Factors x = direction(0), y = direction(1), z = direction(2);
  const auto planes = shares(x.weight, x.slope, join_registers<Vector>(load.a0, load.b0),
                             join_registers<Vector>(load.ax, load.bx)),
             planes_y = shares(x.weight, join_registers<Vector>(load.ay, load.by)),
             planes_z = shares(x.weight, join_registers<Vector>(load.az, load.bz));
  for (std::size_t i = 0; i < n; ++i) {
    const auto rows = shares(y.weight, y.slope, planes[i], planes_y[i]),
               rows_z = shares(y.weight, planes_z[i]);
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      if constexpr (Planar<Shape>) {
        grid::Node& node = nodes(i, j, 0);
        store_node(node, load_node<Vector>(node) + rows[j]);
      } else {
        const auto share = shares(z.weight, z.slope, rows[j], rows_z[j]);
#pragma GCC unroll 4
        for (std::size_t k = 0; k < n; ++k) {
          grid::Node& node = nodes(i, j, k);
          store_node(node, load_node<Vector>(node) + share[k]);
        }
      }
    }
  }
}
/// Adds mass and momentum only.
template <class Vector, class Shape, class Stencil>
WHIPPLE_INLINE inline void add_payload(Lanes load, const Weights<Shape::count>& w, const Stencil& nodes) {
  constexpr std::size_t n = Shape::count;
  const std::array<Lanes, n> weight = of_direction(w.weight, 2);
#pragma GCC unroll 4
  for (std::size_t i = 0; i < n; ++i) {
    const Lanes a_x = broadcast(w.weight[i][0]) * load;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < n; ++j) {
      const Lanes a = broadcast(w.weight[j][1]) * a_x;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < count_z<Shape>; ++k) first_register(nodes(i, j, k)) += weight[k] * a;
    }
  }
}

/// Scatters the points of one cell to its eight nodes with linear functions, as long as they are contiguous:
/// the nodes themselves are accessed once for all of them.
/// @tparam Content  of the nodes: grid::Node takes everything, Lanes mass and momentum
template <class Vector, class Content>
class NodesOfCell {
  using Both = BothRegisters<Vector>;

 public:
  WHIPPLE_INLINE void add(const Payload& load, const grid::PlaceInStencil& place, double per_cell) {
    const Weight x = weight(place, 0), y = weight(place, 1), z = weight(place, 2);
    const Lanes none{};
    const Both whole = join_registers<Vector>(load.a0, load.b0),
               of_x = join_registers<Vector>(none, per_cell * load.bx),
               of_y = join_registers<Vector>(none, per_cell * load.by);
    const Lanes of_z = per_cell * load.bz;
#pragma GCC unroll 2
    for (std::size_t i = 0; i < 2; ++i) {
      const Both across = broadcast_both<Vector>(x[i]), from_x = across * whole,
                 plane = i == 0 ? from_x - of_x : from_x + of_x, plane_y = across * of_y;
      const Lanes plane_z = x[i] * of_z;
#pragma GCC unroll 2
      for (std::size_t j = 0; j < 2; ++j) {
        const Both from_y = broadcast_both<Vector>(y[j]) * plane,
                   row = j == 0 ? from_y - plane_y : from_y + plane_y;
        slope_[i][j] += y[j] * plane_z;
#pragma GCC unroll 2
        for (std::size_t k = 0; k < 2; ++k)
          sum_[i][j][k] = multiply_add(broadcast_both<Vector>(z[k]), row, sum_[i][j][k]);
      }
    }
  }
  WHIPPLE_INLINE void add(const Lanes& load, const grid::PlaceInStencil& place, double) {
    const Weight x = weight(place, 0), y = weight(place, 1), z = weight(place, 2);
#pragma GCC unroll 2
    for (std::size_t i = 0; i < 2; ++i) {
      const Lanes plane = x[i] * load;
#pragma GCC unroll 2
      for (std::size_t j = 0; j < 2; ++j) {
        const Lanes row = y[j] * plane;
#pragma GCC unroll 2
        for (std::size_t k = 0; k < 2; ++k) sum_[i][j][k] += z[k] * row;
      }
    }
  }
  template <class Stencil>
  WHIPPLE_INLINE void add_to(const Stencil& nodes) {
#pragma GCC unroll 2
    for (std::size_t i = 0; i < 2; ++i) {
#pragma GCC unroll 2
      for (std::size_t j = 0; j < 2; ++j) {
        if constexpr (takes_all) {
          const Both slope = join_registers<Vector>(Lanes{}, slope_[i][j]);
          grid::Node &before = nodes(i, j, 0), &behind = nodes(i, j, 1);
          store_node(before, load_node<Vector>(before) + (sum_[i][j][0] - slope));
          store_node(behind, load_node<Vector>(behind) + (sum_[i][j][1] + slope));
        } else {
#pragma GCC unroll 2
          for (std::size_t k = 0; k < 2; ++k) first_register(nodes(i, j, k)) += sum_[i][j][k];
        }
      }
    }
    *this = {};
  }

 private:
  static constexpr bool takes_all = std::is_same_v<Content, grid::Node>;
  using Sum = std::conditional_t<takes_all, Both, Lanes>;
  template <class T>
  using Pair = std::array<T, 2>;
  using Weight = Pair<double>;
  WHIPPLE_INLINE static Weight weight(const grid::PlaceInStencil& place, std::size_t direction) {
    const double f = place.from_first(direction);
    return {1.0 - f, f};
  }

  Pair<Pair<Pair<Sum>>> sum_{};
  Pair<Pair<Lanes>> slope_{};  // of the functions along z: what the second register of the node behind gets
                               // of it, the one before loses
};

}  // namespace whipple::transfer
