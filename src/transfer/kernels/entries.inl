// SPDX-License-Identifier: BSD-3-Clause
// The entries (part of src/transfer/register_kernels.hpp)

/// The entries. Everything they call is inlined into them.
struct Kernels {
  template <bool affine>
  using Transfer = TransferSums<affine>;
  using Update = UpdateSums;
  using First = FirstSums;

  /// Calls take(place, point, what it gets) for the points of a slot; `place` counts along its list.
  /// @param slope_smoothing  as of ShapeFunctions
  /// @param sums             Transfer, Update or First
  template <class Shape, class Sums, class Points, class Take>
  WHIPPLE_WHOLE_KERNEL static void gather(const Points& points, grid::BlockGrid& grid,
                                          grid::BlockGrid::Points kind, std::size_t slot,
                                          double slope_smoothing, const Sums& sums, const Take& take) {
    const Cells cells(grid, slot, slope_smoothing);
    const std::span<const grid::PlaceInStencil> places = grid.places(kind);
    const std::uint32_t* const list = grid.members(kind, slot).data();
    read_nodes<Shape, typename Sums::Content>(grid, kind, slot, [&](const auto& members, auto& access) {
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
        using Group = Group<Shape, std::remove_reference_t<decltype(access)>>;
        const std::size_t groups = (some.size() + together - 1) / together;
        const auto group_at = [&](std::size_t g) WHIPPLE_INLINE {
          Group group;
          for (std::size_t i = 0; i < together; ++i) {
            const std::size_t at = std::min(g * together + i, some.size() - 1);
            group.point[i] = some[at];
            group.place[i] = &places[some[at]];
            group.weights[i] = &weights[at];
            group.stencil[i] = access.stencil(group.place[i]->first_node());
          }
          return group;
        };
        const auto give = [&](std::size_t g, const auto& result) WHIPPLE_INLINE {
          for (std::size_t i = 0, m = g * together; i < together && m < some.size(); ++i, ++m) {
            take(static_cast<std::size_t>(&some[m] - list), some[m], part(result, i));
          }
        };
        if constexpr (requires { typename Sums::Sum; }) {
          // Stage by stage: what becomes of the sums is another long chain.
          std::array<PointsOfGroup, ahead / together> point;
          std::array<typename Sums::Sum, ahead / together> sum;
          std::array<typename Sums::Result, ahead / together> result;
          for (std::size_t g = 0; g < groups; ++g) {
            const Group group = group_at(g);
            point[g] = group.point;
            sum[g] = sums.of(points, group, cells);
          }
          for (std::size_t g = 0; g < groups; ++g) {
            result[g] = sums.template advance<Shape>(points, point[g], sum[g], cells.size);
          }
          for (std::size_t g = 0; g < groups; ++g) give(g, result[g]);
        } else {
          for (std::size_t g = 0; g < groups; ++g) give(g, sums.of(points, group_at(g), cells));
        }
      };
      for_some<Shape, with_weights>(points, places, cells, members, gather_some);
    });
  }

  /// Adds what the points of a slot bring to the nodes.
  template <class Shape, class What>
  WHIPPLE_WHOLE_KERNEL static void scatter(const What& what, grid::BlockGrid& grid, std::size_t slot,
                                           double slope_smoothing) {
    const Cells cells(grid, slot, slope_smoothing);
    const std::span<const grid::PlaceInStencil> places = grid.places(What::kind);
    const auto load = [&](std::size_t p) WHIPPLE_INLINE {
      if (prefetches(p)) {
        what.prefetch_from(p + prefetch_distance);
        prefetch(p + prefetch_distance, places);
      }
      return what.template load<CarriesAffineField<Shape>>(p);
    };
    add_to_nodes<Shape, typename What::Content>(
        grid, What::kind, slot, [&](const auto& members, auto& access) {
          if constexpr (std::is_same_v<Shape, Linear>) {
            const double per_cell = 1.0 / cells.size;
            NodesOfCell<typename What::Content> cell;
            std::int32_t first_node = places[members.front()].first_node();
            for (const std::uint32_t p : members) {
              if (const std::int32_t first = places[p].first_node(); first != first_node) {
                cell.hand_over(access.stencil(first_node));
                first_node = first;
              }
              cell.add(load(p), places[p], per_cell);
            }
            cell.hand_over(access.stencil(first_node));
          } else {
            for_some<Shape>(what.points, places, cells, members, [&](const auto& some, const auto& weights) {
              for (std::size_t m = 0; m < some.size(); ++m) {
                add_payload<Shape>(load(some[m]), weights[m], access.stencil(weights[m].first_node));
              }
            });
          }
        });
  }
};
