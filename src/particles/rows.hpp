// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/parallel/mpi.hpp"
#include "src/particles/material_points.hpp"

/// Rows of sets of points (particles, nodes, elements, Gauss points) with all of their fields.
namespace whipple {

/// new[i] = old[order[i]] in every field in use; `order` may be shorter or longer than the points.
template <class Points>
void select_rows(Points& points, std::span<const std::uint32_t> order) {
  for_each_field<Points>([&](const auto& field) {
    auto& values = points.*(field.values);
    if (field.optional && values.empty()) return;  // not in use
    std::remove_reference_t<decltype(values)> selected;
    selected.reserve(order.size());
    for (const std::uint32_t row : order) selected.push_back(values[row]);
    values.swap(selected);
  });
}

/// Sends the rows leaving[r] to rank r, with all of their fields. Afterwards the rows `staying` come first,
/// in their order, then the newcomers by rank and order. Collective.
template <class Points>
void exchange_rows(Points& points, std::span<const std::uint32_t> staying,
                   const std::vector<std::vector<std::uint32_t>>& leaving, MPI_Comm communicator) {
  const std::size_t before = points.size();
  for_each_field<Points>([&](const auto& field) {
    auto& values = points.*(field.values);
    using Value = typename std::decay_t<decltype(values)>::value_type;
    const bool in_use = values.size() == before;  // else an optional field that is empty on all ranks
    std::vector<std::vector<std::byte>> outgoing(leaving.size());
    for (std::size_t r = 0; in_use && r < leaving.size(); ++r) {
      outgoing[r].resize(leaving[r].size() * sizeof(Value));
      std::byte* to = outgoing[r].data();
      for (const std::uint32_t p : leaving[r]) {
        const auto* from = reinterpret_cast<const std::byte*>(&values[p]);
        to = std::copy(from, from + sizeof(Value), to);
      }
    }
    const auto incoming = parallel::exchange_bytes(communicator, outgoing);
    std::remove_reference_t<decltype(values)> now;
    now.reserve(staying.size());
    if (in_use) {
      for (const std::uint32_t p : staying) now.push_back(values[p]);
    }
    for (const std::vector<std::byte>& bytes : incoming) {
      const std::size_t first = now.size();
      now.resize(first + bytes.size() / sizeof(Value));
      std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::byte*>(now.data() + first));
    }
    values.swap(now);
  });
}

}  // namespace whipple
