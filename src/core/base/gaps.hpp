// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Removal from arrays whose items belong to consecutive groups (particles to bodies): the last items of a group fill
/// the gaps, so that the cost is proportional to the number of removed items.
namespace whipple {

/// Describes the move of one item to another position.
struct Move {
  std::uint32_t to, from;
};

/// Returns the moves that close the gaps. The groups remain contiguous and in order; the order within a group changes.
/// If executed in sequence, no move overwrites the source of a later one.
/// @param group    group of every item, ascending
/// @param leaving  removed items, ascending
inline std::vector<Move> moves_into_gaps(std::span<const std::uint32_t> group,
                                         std::span<const std::uint32_t> leaving) {
  std::vector<Move> moves;
  std::size_t gone = 0;  // removed from the preceding groups
  for (std::size_t begin = 0; begin < group.size();) {
    const auto rest = group.subspan(begin);
    const std::size_t end =
        begin + static_cast<std::size_t>(std::ranges::upper_bound(rest, rest.front()) - rest.begin());
    const auto first = std::ranges::lower_bound(leaving, begin),
               last = std::ranges::lower_bound(leaving, end);
    const auto goes = [&](std::size_t item) { return std::binary_search(first, last, item); };
    const std::size_t new_begin = begin - gone;
    gone += static_cast<std::size_t>(last - first);
    const std::size_t new_end = end - gone;
    std::size_t from = std::max(begin, new_end);
    const auto fill = [&](std::size_t place) {
      while (goes(from)) ++from;
      moves.push_back({static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(from++)});
    };
    for (std::size_t place = new_begin; place < std::min(begin, new_end); ++place) fill(place);
    for (auto gap = first; gap != last && *gap < new_end; ++gap) fill(*gap);
    begin = end;
  }
  return moves;
}

/// Executes the moves. @param size  number of remaining items
template <class Value>
void close_gaps(std::vector<Value>& values, std::span<const Move> moves, std::size_t size) {
  for (const Move& move : moves) values[move.to] = values[move.from];
  values.resize(size);
}

}  // namespace whipple
