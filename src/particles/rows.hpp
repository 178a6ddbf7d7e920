// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/particles/material_points.hpp"

/// Rows of sets of points (particles, nodes, elements, Gauss points) with all of their fields.
namespace whipple {

/// Selects rows as new[i] = old[order[i]] in every field in use; `order` may be shorter or longer than the points.
template <class Points>
void select_rows(Points& points, std::span<const std::uint32_t> order) {
  for_each_field(points, [&](const auto& field) {
    auto& values = field.of(points);
    if (field.optional && values.empty()) return;  // not in use
    std::remove_reference_t<decltype(values)> selected;
    selected.reserve(order.size());
    for (const std::uint32_t row : order) selected.push_back(values[row]);
    values.swap(selected);
  });
}

/// Sends values[p] of the rows p of leaving[r] to rank r; nothing for an empty array. Collective.
/// @returns the bytes received from each rank
template <class Value>
std::vector<std::vector<std::byte>> send_rows(const std::vector<Value>& values,
                                              const std::vector<std::vector<std::uint32_t>>& leaving,
                                              MPI_Comm communicator) {
  std::vector<std::vector<std::byte>> outgoing(leaving.size());
  for (std::size_t r = 0; !values.empty() && r < leaving.size(); ++r) {
    outgoing[r].resize(leaving[r].size() * sizeof(Value));
    std::byte* to = outgoing[r].data();
    for (const std::uint32_t p : leaving[r]) {
      const auto* from = reinterpret_cast<const std::byte*>(&values[p]);
      to = std::copy(from, from + sizeof(Value), to);
    }
  }
  return parallel::exchange_bytes(communicator, outgoing);
}

/// Appends the result of `send_rows`, rank by rank.
template <class Value>
void append_rows(std::vector<Value>& values, const std::vector<std::vector<std::byte>>& incoming) {
  for (const std::vector<std::byte>& bytes : incoming) {
    const std::size_t first = values.size();
    values.resize(first + bytes.size() / sizeof(Value));
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::byte*>(values.data() + first));
  }
}

/// Sends the rows leaving[r] to rank r, with all of their fields. Afterwards the rows `staying` come first, in their
/// order, then the received rows by rank and order. Collective.
template <class Points>
void exchange_rows(Points& points, std::span<const std::uint32_t> staying,
                   const std::vector<std::vector<std::uint32_t>>& leaving, MPI_Comm communicator) {
  for_each_field(points, [&](const auto& field) {
    auto& values = field.of(points);
    const auto incoming = send_rows(values, leaving, communicator);
    std::remove_reference_t<decltype(values)> now;
    now.reserve(staying.size());
    if (!values.empty()) {  // otherwise an optional field that is empty on all ranks
      for (const std::uint32_t p : staying) now.push_back(values[p]);
    }
    append_rows(now, incoming);
    values.swap(now);
  });
}

}  // namespace whipple
