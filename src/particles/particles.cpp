// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/particles.hpp"

#include "src/parallel/threads.hpp"

namespace whipple {

void reorder(Particles& particles, std::span<const std::uint32_t> order) {
  for_each_field<Particles>([&](const auto& field) {
    auto& values = particles.*(field.values);
    std::remove_reference_t<decltype(values)> sorted(order.size());
    parallel::for_each(order.size(), [&](std::size_t i) { sorted[i] = values[order[i]]; });
    values.swap(sorted);
  });
}

}  // namespace whipple
