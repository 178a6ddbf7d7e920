// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace whipple::solids {

/// Returns the number stored at a place of a file, whose bytes must be there.
template <class Number>
Number number_at(std::string_view bytes, std::size_t at, std::endian order = std::endian::little) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), bytes.data() + at, sizeof(Number));
  if (order != std::endian::native) std::ranges::reverse(raw);
  return std::bit_cast<Number>(raw);
}

}  // namespace whipple::solids
