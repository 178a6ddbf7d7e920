// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

/// Items marked by one byte each (0: unmarked). Marks are sparse: eight unmarked items cost one comparison.
namespace whipple {

/// Calls f(i) for every marked item, ascending.
template <class Function>
void for_each_marked(std::span<const std::uint8_t> marks, Function&& f) {
  for (std::size_t i = 0; i < marks.size();) {
    std::uint64_t eight = 0;
    if (i + sizeof(eight) <= marks.size()) {
      std::memcpy(&eight, &marks[i], sizeof(eight));
      if (eight == 0) {
        i += sizeof(eight);
        continue;
      }
    }
    const std::size_t end = i + sizeof(eight) <= marks.size() ? i + sizeof(eight) : marks.size();
    for (; i < end; ++i) {
      if (marks[i] != 0) f(i);
    }
  }
}

/// Returns whether none of the four items from `first` on is marked.
inline bool none_of_four(std::span<const std::uint8_t> marks, std::size_t first) {
  std::uint32_t four = 0;
  std::memcpy(&four, &marks[first], sizeof(four));
  return four == 0;
}

}  // namespace whipple
