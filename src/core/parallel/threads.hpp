// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// The only file with OpenMP pragmas. Every result is bitwise independent of the number of threads: loops write to
/// disjoint elements, and sums are taken over fixed chunks in a fixed order.
namespace whipple::parallel {

inline void set_threads(int n) { omp_set_num_threads(n); }
inline int threads() { return omp_get_max_threads(); }
/// Returns the number of cores that this process may use but its threads do not.
inline int free_cores() { return std::max(0, omp_get_num_procs() - threads()); }
/// Returns whether this is the thread that continues alone after a loop.
inline bool is_first_thread() { return omp_get_thread_num() == 0; }

constexpr std::size_t chunk_size = 1024;
/// Returns the number of chunks of at most `chunk_size` items.
constexpr std::size_t chunk_count(std::size_t items) { return (items + chunk_size - 1) / chunk_size; }

/// Calls body(i) for i in [0, n).
template <class Body>
void for_each(std::size_t n, Body&& body) {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) body(i);
}

/// Calls body(i) for i in [0, n) with varying cost per item. Threads fetch several items at a time, as fetching each
/// one would cost more than the shortest bodies.
template <class Body>
void for_each_uneven(std::size_t n, Body&& body) {
  constexpr std::size_t turns = 128;  // minimum per thread, if there are enough items
  const std::size_t together = std::max(std::size_t{1}, n / (turns * static_cast<std::size_t>(threads())));
#pragma omp parallel for schedule(dynamic, together)
  for (std::size_t i = 0; i < n; ++i) body(i);
}

/// Calls body(begin, end) for chunks of at most `chunk_size` items.
template <class Body>
void for_each_chunk(std::size_t n, Body&& body) {
  for_each_uneven(chunk_count(n),
                  [&](std::size_t c) { body(c * chunk_size, std::min(n, (c + 1) * chunk_size)); });
}

/// Sets of_chunk[c] to value(begin, end) of every chunk of at most `chunk_size` items, except where stays(c) is true.
template <class Value, class Stays, class Evaluate>
void update_chunks(std::size_t n, std::vector<Value>& of_chunk, Stays&& stays, Evaluate&& value) {
  of_chunk.resize(chunk_count(n));
  for_each(of_chunk.size(), [&](std::size_t c) {
    if (!stays(c)) of_chunk[c] = value(c * chunk_size, std::min(n, (c + 1) * chunk_size));
  });
}

/// Returns the sum over chunks of at most `chunk_size` items of term(begin, end), whose type is default-constructible
/// to zero and has +=. Chunks are summed in order.
template <class Sum, class Term>
Sum sum_of_chunks(std::size_t n, Term&& term) {
  std::vector<Sum> partial;
  update_chunks(n, partial, [](std::size_t) { return false; }, term);
  Sum total{};
  for (const Sum& part : partial) total += part;
  return total;
}

/// Returns the sum over i of term(i), by chunks.
template <class Sum, class Term>
Sum sum(std::size_t n, Term&& term) {
  return sum_of_chunks<Sum>(n, [&](std::size_t begin, std::size_t end) {
    Sum local{};
    for (std::size_t i = begin; i < end; ++i) local += term(i);
    return local;
  });
}

/// Returns the maximum over i of value(i), at least `start`.
template <class Value>
double maximum(std::size_t n, double start, Value&& value) {
  double result = start;
#pragma omp parallel for schedule(static) reduction(max : result)
  for (std::size_t i = 0; i < n; ++i) result = std::max(result, value(i));
  return result;
}

/// Returns the i of [0, n) for which condition(i) is true, ascending.
template <class Condition>
std::vector<std::uint32_t> where(std::size_t n, Condition&& condition) {
  std::vector<std::vector<std::uint32_t>> found(static_cast<std::size_t>(threads()));
  for_each(found.size(), [&](std::size_t part) {
    for (std::size_t i = n * part / found.size(); i < n * (part + 1) / found.size(); ++i) {
      if (condition(i)) found[part].push_back(static_cast<std::uint32_t>(i));
    }
  });
  std::vector<std::uint32_t> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace whipple::parallel
