// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "src/grid/geometry.hpp"

namespace whipple::grid {

/// Holds a set of velocity fields: one bit per field, in words of 64.
class FieldSet {
 public:
  static constexpr std::size_t size = 256;
  static_assert(maximum_fields < size);  // so that the number of fields of a set, too, fits in a byte

  constexpr FieldSet() = default;
  /// Returns the set of one field.
  [[nodiscard]] static constexpr FieldSet of(unsigned field) {
    FieldSet set;
    set.insert(field);
    return set;
  }
  /// Returns the set of the fields in [begin, `size`).
  [[nodiscard]] static constexpr FieldSet from(unsigned begin) {
    FieldSet set;
    for (unsigned field = begin; field < size; ++field) set.insert(field);
    return set;
  }
  /// Returns a set of some of the first 64 fields, one bit each.
  [[nodiscard]] static constexpr FieldSet of_bits(std::uint64_t bits) {
    FieldSet set;
    set.words_[0] = bits;
    return set;
  }

  constexpr void insert(unsigned field) { words_[field / 64] |= std::uint64_t{1} << field % 64; }
  [[nodiscard]] constexpr bool contains(unsigned field) const {
    return (words_[field / 64] >> field % 64 & 1U) != 0;
  }
  [[nodiscard]] constexpr bool empty() const { return (words_[0] | words_[1] | words_[2] | words_[3]) == 0; }
  [[nodiscard]] constexpr bool is_full() const {
    return (words_[0] & words_[1] & words_[2] & words_[3]) == ~std::uint64_t{0};
  }
  /// Returns the number of fields.
  [[nodiscard]] constexpr std::size_t count() const {
    std::size_t sum = 0;
    for (const std::uint64_t word : words_) sum += static_cast<std::size_t>(std::popcount(word));
    return sum;
  }
  /// Returns the number of fields below one.
  [[nodiscard]] constexpr std::size_t count_below(unsigned field) const {
    std::size_t sum = 0;
    for (std::size_t w = 0; w < field / 64; ++w) sum += static_cast<std::size_t>(std::popcount(words_[w]));
    const std::uint64_t below = words_[field / 64] & ((std::uint64_t{1} << field % 64) - 1);
    return sum + static_cast<std::size_t>(std::popcount(below));
  }
  /// Returns the n-th field of the set, counted from 0.
  [[nodiscard]] constexpr unsigned nth(std::size_t n) const {
    unsigned first = 0;
    for (const std::uint64_t word : words_) {
      const auto here = static_cast<std::size_t>(std::popcount(word));
      if (n < here) {
        std::uint64_t bits = word;
        for (; n > 0; --n) bits &= bits - 1;
        return first + static_cast<unsigned>(std::countr_zero(bits));
      }
      n -= here;
      first += 64;
    }
    return size;
  }
  /// Calls f(field) for every field, from the lowest.
  template <class Function>
  constexpr void for_each(Function&& f) const {
    unsigned first = 0;
    for (std::uint64_t bits : words_) {
      for (; bits != 0; bits &= bits - 1) f(first + static_cast<unsigned>(std::countr_zero(bits)));
      first += 64;
    }
  }
  constexpr FieldSet& operator|=(const FieldSet& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] |= other.words_[w];
    return *this;
  }
  constexpr FieldSet& operator&=(const FieldSet& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
    return *this;
  }
  friend constexpr FieldSet operator&(FieldSet a, const FieldSet& b) { return a &= b; }
  friend constexpr bool operator==(const FieldSet&, const FieldSet&) = default;

 private:
  std::array<std::uint64_t, size / 64> words_{};
};

}  // namespace whipple::grid
