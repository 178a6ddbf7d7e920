// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/particles.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <type_traits>

#include "src/parallel/threads.hpp"

namespace whipple {

namespace {

/// Every field in use whose numbers are of one type.
template <class Value, class Function>
void for_each_field_of(Particles& particles, Function&& f) {
  for_each_field<Particles>([&](const auto& field) {
    auto& values = particles.*(field.values);
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(values)>, std::vector<Value>>) {
      if (!field.optional || !values.empty()) f(values);
    }
  });
}

/// Fields of one type hand their memory on to one another: new pages cost more than the copy. Tensors go
/// three numbers at a time, so that no more memory than that of a vector is needed beside the particles'.
template <class Value>
void reorder_fields_of(Particles& particles, std::span<const std::uint32_t> order) {
  if constexpr (sizeof(Value) > sizeof(Vector3)) {
    using Part = std::array<double, 3>;
    static_assert(sizeof(Value) % sizeof(Part) == 0);
    std::vector<Part> sorted(order.size());
    for_each_field_of<Value>(particles, [&](std::vector<Value>& values) {
      for (std::size_t begin = 0; begin < sizeof(Value); begin += sizeof(Part)) {
        const auto part = [&](std::size_t i) { return reinterpret_cast<char*>(&values[i]) + begin; };
        parallel::for_each(order.size(),
                           [&](std::size_t i) { std::memcpy(&sorted[i], part(order[i]), sizeof(Part)); });
        parallel::for_each(order.size(),
                           [&](std::size_t i) { std::memcpy(part(i), &sorted[i], sizeof(Part)); });
      }
      values.resize(order.size());
    });
  } else {
    std::vector<Value> sorted;
    for_each_field_of<Value>(particles, [&](std::vector<Value>& values) {
      sorted.resize(order.size());
      parallel::for_each(order.size(), [&](std::size_t i) { sorted[i] = values[order[i]]; });
      values.swap(sorted);
    });
  }
}

template <class... Values>
struct Types {
  template <class Value>
  static constexpr bool hold = (std::is_same_v<Value, Values> || ...);
  static void reorder(Particles& particles, std::span<const std::uint32_t> order) {
    for_each_field<Particles>([]<class Points, class Value>(const Field<Points, Value>&) {
      static_assert(hold<Value>, "a field of a type that is not reordered");
    });
    (reorder_fields_of<Values>(particles, order), ...);
  }
};
using FieldTypes =
    Types<double, std::uint8_t, std::uint32_t, std::uint64_t, Vector3, SymmetricTensor, Matrix3>;

}  // namespace

void reorder(Particles& particles, std::span<const std::uint32_t> order) {
  FieldTypes::reorder(particles, order);
}

void remove(Particles& particles, std::span<const Move> moves, std::size_t size) {
  for_each_field<Particles>([&](const auto& field) {
    auto& values = particles.*(field.values);
    if (!field.optional || !values.empty()) close_gaps(values, moves, size);
  });
}

void sort_by_body(Particles& particles) {
  if (std::ranges::is_sorted(particles.body)) return;
  std::vector<std::uint32_t> order(particles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t p) { return particles.body[p]; });
  reorder(particles, order);
}

}  // namespace whipple
