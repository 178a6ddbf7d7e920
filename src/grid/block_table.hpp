// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "src/grid/geometry.hpp"

namespace whipple::grid {

/// Maps block coordinates to integers (hash table with open addressing and linear probing). Rebuilt in each adaptation.
class BlockTable {
 public:
  static constexpr std::int32_t none = -1;

  void reserve(std::size_t blocks) {
    std::size_t capacity = 64;
    while (capacity < 2 * blocks) capacity *= 2;
    keys_.assign(capacity, empty);
    values_.assign(capacity, none);
    size_ = 0;
  }

  /// Returns the value of a coordinate; inserts `fallback` if there is none.
  std::int32_t& find_or_insert(const BlockCoordinate& block, std::int32_t fallback) {
    if (2 * (size_ + 1) > keys_.size()) grow();
    const std::size_t i = probe(key(block));
    if (keys_[i] == empty) {
      keys_[i] = key(block);
      values_[i] = fallback;
      ++size_;
    }
    return values_[i];
  }

  [[nodiscard]] std::int32_t find(const BlockCoordinate& block) const {
    return keys_.empty() ? none : values_[probe(key(block))];
  }

  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  static constexpr std::uint64_t empty = ~std::uint64_t{0};

  /// Packs 21 bits per direction, shifted so that the layer outside of the domain is not negative, and the level.
  static std::uint64_t key(const BlockCoordinate& b) {
    const auto part = [](std::int32_t c) { return static_cast<std::uint64_t>(c + 1) & 0x1fffff; };
    return static_cast<std::uint64_t>(b.level) << 63 | part(b[0]) << 42 | part(b[1]) << 21 | part(b[2]);
  }

  [[nodiscard]] std::size_t probe(std::uint64_t k) const {
    const std::size_t mask = keys_.size() - 1;
    // Fibonacci hashing: only the highest bits of the product depend on all directions.
    std::size_t i = k * 0x9e3779b97f4a7c15ULL >> (64 - std::countr_zero(keys_.size()));
    while (keys_[i] != empty && keys_[i] != k) i = (i + 1) & mask;
    return i;
  }

  void grow() {
    const std::vector<std::uint64_t> old_keys = std::move(keys_);
    const std::vector<std::int32_t> old_values = std::move(values_);
    reserve(old_keys.size());
    for (std::size_t j = 0; j < old_keys.size(); ++j) {
      if (old_keys[j] == empty) continue;
      const std::size_t i = probe(old_keys[j]);
      keys_[i] = old_keys[j];
      values_[i] = old_values[j];
      ++size_;
    }
  }

  std::vector<std::uint64_t> keys_;
  std::vector<std::int32_t> values_;
  std::size_t size_ = 0;
};

}  // namespace whipple::grid
