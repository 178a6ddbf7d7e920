// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "src/core/base/prefetch.hpp"
#include "src/grid/block_grid.hpp"
#include "src/transfer/kernels/gather.hpp"
#include "src/transfer/kernels/scatter.hpp"

/// The loops over points and their nodes for registers. A register of AVX2 (Narrow) holds half a node; one of AVX-512
/// (Wide) holds a node in a scatter, and halves of two nodes in a gather, which handles two points at a
/// time. Lane by lane both compute the same in the same order, so their results are the same bits.
namespace whipple::transfer {

/// The entries for registers, Narrow or Wide. Everything they call is inlined into them.
template <class Registers>
struct RegisterKernels {
  using Vector = typename Registers::Register;
  static constexpr std::size_t at_a_time = points_of<Vector>;
  template <bool affine>
  using Transfer = TransferSums<Vector, affine>;
  using Update = UpdateSums<Vector>;
  using First = FirstSums<Vector>;

  /// Calls take(place, point, its result) for the points of a slot; `place` counts along its list. Where the result
  /// follows from sums in a second step, a further argument returns those of the point.
  /// @param slope_smoothing  as of ShapeFunctions
  /// @param sums             Transfer, Update or First
  template <class Shape, class Sums, class Points, class Take>
  static void gather(const Points& points, grid::BlockGrid& grid, grid::BlockGrid::Points kind,
                     std::size_t slot, double slope_smoothing, const Sums& sums, const Take& take) {
    Registers::run([&]() WHIPPLE_INLINE {
      const Cells cells(grid, slot, slope_smoothing);
      const std::span<const grid::PlaceInStencil> places = grid.places(kind);
      const std::uint32_t* const list = grid.members(kind, slot).data();
      read_nodes<Vector, Shape, typename Sums::Content>(
          grid, kind, slot, [&](const auto& members, auto& access) WHIPPLE_INLINE {
            if constexpr (std::is_same_v<Shape, Linear> && !requires { typename Sums::Sum; }) {
              const double per_cell = 1.0 / cells.size;
              std::int32_t first_node = places[members.front()].first_node();
              auto stencil = access.stencil(first_node);
              for (const std::uint32_t& p : members) {
                if (const std::int32_t first = places[p].first_node(); first != first_node) {
                  first_node = first;
                  stencil = access.stencil(first);
                }
                take(static_cast<std::size_t>(&p - list), p, Sums::between(places[p], per_cell, stencil));
              }
              return;
            }
            constexpr bool with_weights = !std::is_same_v<typename AlongAxis<Shape>::type, QuadraticBSpline>;
            const auto gather_some = [&](const auto& some, const auto& weights) WHIPPLE_INLINE {
              using Group = transfer::Group<Vector, Shape, std::remove_reference_t<decltype(access)>>;
              const std::size_t groups = (some.size() + at_a_time - 1) / at_a_time;
              const auto group_at = [&](std::size_t g) WHIPPLE_INLINE {
                Group group;
                for (std::size_t i = 0; i < at_a_time; ++i) {
                  const std::size_t at = std::min(g * at_a_time + i, some.size() - 1);
                  group.point[i] = some[at];
                  group.place[i] = &places[some[at]];
                  group.weights[i] = &weights[at];
                  group.stencil[i] = access.stencil(group.place[i]->first_node());
                }
                return group;
              };
              // Calls f(i, place, point) for the points of a group.
              const auto for_each_point = [&](std::size_t g, auto&& f) WHIPPLE_INLINE {
                for (std::size_t i = 0, m = g * at_a_time; i < at_a_time && m < some.size(); ++i, ++m) {
                  f(i, static_cast<std::size_t>(&some[m] - list), some[m]);
                }
              };
              if constexpr (requires { typename Sums::Sum; }) {
                // Stage by stage: the formulas that follow the sums are another long chain.
                std::array<PointsOfGroup<Vector>, ahead / at_a_time> point;
                std::array<typename Sums::Sum, ahead / at_a_time> sum;
                std::array<typename Sums::Result, ahead / at_a_time> result;
                for (std::size_t g = 0; g < groups; ++g) {
                  const Group group = group_at(g);
                  point[g] = group.point;
                  sum[g] = sums.of(points, group, cells);
                }
                for (std::size_t g = 0; g < groups; ++g) {
                  result[g] = sums.template advance<Shape>(points, point[g], sum[g], cells.size);
                }
                for (std::size_t g = 0; g < groups; ++g) {
                  for_each_point(g, [&](std::size_t i, std::size_t place, std::uint32_t p) WHIPPLE_INLINE {
                    take(place, p, of_point(result[g], i),
                         [&]() WHIPPLE_INLINE { return of_point(sum[g], i); });
                  });
                }
              } else {
                for (std::size_t g = 0; g < groups; ++g) {
                  const auto result = sums.of(points, group_at(g), cells);
                  for_each_point(g, [&](std::size_t i, std::size_t place, std::uint32_t p)
                                        WHIPPLE_INLINE { take(place, p, of_point(result, i)); });
                }
              }
            };
            for_some<Shape, with_weights>(points, places, cells, members, gather_some);
          });
    });
  }

  /// Adds the contributions of the points of a slot to the nodes.
  template <class Shape, class What>
  static void scatter(const What& what, grid::BlockGrid& grid, std::size_t slot, double slope_smoothing) {
    Registers::run([&]() WHIPPLE_INLINE {
      const Cells cells(grid, slot, slope_smoothing);
      const std::span<const grid::PlaceInStencil> places = grid.places(What::kind);
      const auto load = [&](std::size_t p) WHIPPLE_INLINE {
        if (prefetches(p)) {
          what.prefetch_from(p + prefetch_distance);
          prefetch(p + prefetch_distance, places);
        }
        return what.template load<CarriesAffineField<Shape>>(p);
      };
      add_to_nodes<Vector, Shape, typename What::Content>(
          grid, What::kind, slot, [&](const auto& members, auto& access) WHIPPLE_INLINE {
            if constexpr (std::is_same_v<Shape, Linear>) {
              const double per_cell = 1.0 / cells.size;
              NodesOfCell<Vector, typename What::Content> cell;
              std::int32_t first_node = places[members.front()].first_node();
              for (const std::uint32_t p : members) {
                if (const std::int32_t first = places[p].first_node(); first != first_node) {
                  cell.add_to(access.stencil(first_node));
                  first_node = first;
                }
                cell.add(load(p), places[p], per_cell);
              }
              cell.add_to(access.stencil(first_node));
            } else {
              for_some<Shape>(what.points, places, cells, members,
                              [&](const auto& some, const auto& weights) WHIPPLE_INLINE {
                                for (std::size_t m = 0; m < some.size(); ++m) {
                                  add_payload<Vector, Shape>(load(some[m]), weights[m],
                                                             access.stencil(weights[m].first_node));
                                }
                              });
            }
          });
    });
  }
};

}  // namespace whipple::transfer
