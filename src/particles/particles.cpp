// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/particles.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>

#include "src/core/parallel/threads.hpp"

namespace whipple {

namespace {

/// Calls f(values) for every field in use with values of one type.
template <class Value, class Function>
void for_each_field_of(Particles& particles, Function&& f) {
  for_each_field(particles, [&](const auto& field) {
    auto& values = field.of(particles);
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(values)>, std::vector<Value>>) {
      if (!field.optional || !values.empty()) f(values);
    }
  });
}

/// Reorders the fields of one type. Vectors and numbers exchange their memory with the buffer. Tensors pass through it
/// three numbers at a time, and types with few fields as a whole.
template <class Value>
void reorder_fields_of(Particles& particles, std::span<const std::uint32_t> order, SortBuffers& buffers) {
  const auto reorder_into = [&](auto& sorted) {
    for_each_field_of<Value>(particles, [&](std::vector<Value>& values) {
      sorted.resize(order.size());
      parallel::for_each(order.size(), [&](std::size_t i) { sorted[i] = values[order[i]]; });
      values.swap(sorted);
    });
  };
  if constexpr (std::is_same_v<Value, Vector3>) {
    reorder_into(buffers.vectors);
  } else if constexpr (std::is_same_v<Value, double>) {
    reorder_into(buffers.numbers);
  } else {
    constexpr std::size_t size = std::min(sizeof(Value), sizeof(Vector3));
    static_assert(sizeof(Value) % size == 0);
    buffers.vectors.resize(order.size());
    for_each_field_of<Value>(particles, [&](std::vector<Value>& values) {
      for (std::size_t begin = 0; begin < sizeof(Value); begin += size) {
        const auto part = [&](std::size_t i) { return reinterpret_cast<char*>(&values[i]) + begin; };
        const auto place = [&](std::size_t i) {
          return reinterpret_cast<char*>(buffers.vectors.data()) + size * i;
        };
        parallel::for_each(order.size(), [&](std::size_t i) { std::memcpy(place(i), part(order[i]), size); });
        parallel::for_each(order.size(), [&](std::size_t i) { std::memcpy(part(i), place(i), size); });
      }
      values.resize(order.size());
    });
  }
}

template <class... Values>
struct Types {
  template <class Value>
  static constexpr bool hold = (std::is_same_v<Value, Values> || ...);
  static void reorder(Particles& particles, std::span<const std::uint32_t> order, SortBuffers& buffers) {
    for_each_field<Particles>([]<class Points, class Value>(const Field<Points, Value>&) {
      static_assert(hold<Value>, "a field of a type that is not reordered");
    });
    (reorder_fields_of<Values>(particles, order, buffers), ...);
  }
};
using FieldTypes =
    Types<double, std::uint8_t, std::uint32_t, std::uint64_t, Vector3, SymmetricTensor, Matrix3>;

}  // namespace

void reorder(Particles& particles, std::span<const std::uint32_t> order, SortBuffers& buffers) {
  FieldTypes::reorder(particles, order, buffers);
}

void remove(Particles& particles, std::span<const Move> moves, std::size_t size) {
  for_each_field(particles, [&](const auto& field) {
    auto& values = field.of(particles);
    if (!field.optional || !values.empty()) close_gaps(values, moves, size);
  });
}

void sort_by_body(Particles& particles) {
  if (std::ranges::is_sorted(particles.body)) return;
  std::vector<std::uint32_t> order(particles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t p) { return particles.body[p]; });
  SortBuffers buffers;
  reorder(particles, order, buffers);
}

}  // namespace whipple
