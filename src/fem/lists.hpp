// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace whipple::fem {

/// Inverts a map: the values v with item_of_value[v] = i become values[first[i]] ... values[first[i + 1] - 1],
/// ascending.
inline void list_by_item(std::span<const std::uint32_t> item_of_value, std::size_t items,
                         std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& values) {
  first.assign(items + 1, 0);
  for (const std::uint32_t item : item_of_value) ++first[item + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  values.resize(item_of_value.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::size_t v = 0; v < item_of_value.size(); ++v) {
    values[next[item_of_value[v]]++] = static_cast<std::uint32_t>(v);
  }
}

}  // namespace whipple::fem
