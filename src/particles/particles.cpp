// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/particles.hpp"

#include <algorithm>
#include <numeric>

#include "src/parallel/threads.hpp"

namespace whipple {

void reorder(Particles& particles, std::span<const std::uint32_t> order) {
  for_each_field<Particles>([&](const auto& field) {
    auto& values = particles.*(field.values);
    if (field.optional && values.empty()) return;  // not in use
    std::remove_reference_t<decltype(values)> sorted(order.size());
    parallel::for_each(order.size(), [&](std::size_t i) { sorted[i] = values[order[i]]; });
    values.swap(sorted);
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
