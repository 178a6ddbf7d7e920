// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Removal from arrays whose items belong to consecutive groups (particles to bodies): the last items of a
/// group take the places of those that go, so that the cost is that of what goes, not of what stays.
namespace whipple {

/// One item moves to another place.
struct Move {
  std::uint32_t to, from;
};

/// Moves that close the gaps. Groups stay together and in their order; within a group it changes. Done one
/// after the other, no move overwrites an item that a later one takes.
/// @param group    group of every item, ascending
/// @param leaving  items that go, ascending
inline std::vector<Move> moves_into_gaps(std::span<const std::uint32_t> group,
                                         std::span<const std::uint32_t> leaving) {
  std::vector<Move> moves;
  std::size_t gone = 0;  // from the groups before
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

/// @param size  number of items that stay
template <class Value>
void close_gaps(std::vector<Value>& values, std::span<const Move> moves, std::size_t size) {
  for (const Move& move : moves) values[move.to] = values[move.from];
  values.resize(size);
}

}  // namespace whipple
