// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "src/core/parallel/threads.hpp"

namespace whipple::device {

/// Runs the kernels of a device on the threads of the host: the emulated device. Results do not depend on their number.
struct HostSpace {
  template <class T>
  class Array {
   public:
    /// Makes room; what the array held is lost if it grows.
    void reserve(std::size_t n) {
      if (n > values_.size()) values_ = std::vector<T>(n + n / 8);
    }
    [[nodiscard]] T* data() { return values_.data(); }
    [[nodiscard]] std::size_t bytes() const { return values_.size() * sizeof(T); }
    void upload(const T* from, std::size_t n, std::size_t at = 0) {
      std::copy_n(from, n, values_.data() + at);
    }
    void download(T* to, std::size_t n, std::size_t at = 0) const { std::copy_n(values_.data() + at, n, to); }

   private:
    std::vector<T> values_;
  };

  static std::string name() { return "emulated on the host's threads"; }
  static void synchronize() {}
  template <class Kernel>
  static void for_each(std::size_t n, const Kernel& kernel) {
    parallel::for_each_chunk(n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) kernel(i);
    });
  }
  template <class Kernel>
  static typename Kernel::Result reduce(std::size_t n, const Kernel& kernel) {
    std::vector<typename Kernel::Result> parts(parallel::chunk_count(n));
    parallel::for_each_chunk(n, [&](std::size_t begin, std::size_t end) {
      typename Kernel::Result part;
      for (std::size_t i = begin; i < end; ++i) kernel(i, part);
      parts[begin / parallel::chunk_size] = part;
    });
    typename Kernel::Result all;
    for (const auto& part : parts) all.merge(part);
    return all;
  }
  /// Sets before[i] to the sum of the flags before i.
  /// @returns the sum of all
  static std::uint32_t scan(const std::uint32_t* flags, std::uint32_t* before, std::size_t n) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      before[i] = sum;
      sum += flags[i];
    }
    return sum;
  }
  /// Sorts pairs by key; equal keys stay in order.
  void sort(Array<std::uint32_t>& keys, Array<std::uint32_t>& values, std::size_t n, unsigned bits) {
    constexpr unsigned digit = 11, buckets = 1U << digit;
    other_keys_.resize(n);
    other_values_.resize(n);
    std::uint32_t *k = keys.data(), *v = values.data(), *k2 = other_keys_.data(), *v2 = other_values_.data();
    for (unsigned shift = 0; shift < bits; shift += digit) {
      std::array<std::uint32_t, buckets + 1> begin{};
      for (std::size_t i = 0; i < n; ++i) ++begin[(k[i] >> shift & (buckets - 1)) + 1];
      for (std::size_t b = 0; b < buckets; ++b) begin[b + 1] += begin[b];
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t to = begin[k[i] >> shift & (buckets - 1)]++;
        k2[to] = k[i];
        v2[to] = v[i];
      }
      std::swap(k, k2);
      std::swap(v, v2);
    }
    if (k == keys.data()) return;
    std::copy_n(k, n, keys.data());
    std::copy_n(v, n, values.data());
  }

  [[nodiscard]] std::size_t bytes() const {
    return (other_keys_.size() + other_values_.size()) * sizeof(std::uint32_t);
  }

 private:
  std::vector<std::uint32_t> other_keys_, other_values_;
};

}  // namespace whipple::device
