// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"

/// Connected pieces of sets of points (docs/theory/analysis.md, section 3).
namespace whipple::analysis {

/// Finds the connected components of points closer than `distance` to each other and returns for every point the
/// smallest index of its component. Uses a cell list and concurrent union-find; the result is independent of the number
/// of threads.
std::vector<std::uint32_t> connected_components(std::span<const Vector3> points, double distance);

/// Marks a point that belongs to no piece.
constexpr std::uint32_t loose = std::numeric_limits<std::uint32_t>::max();

/// Divides points into pieces: intact points closer than `distance` to each other are connected, and a failed point
/// belongs to the piece of the nearest intact point within that distance. Returns for every point the smallest index of
/// the intact points of its piece, or `loose`. The result is independent of the number of threads.
/// @param failed  for every point whether it has failed
std::vector<std::uint32_t> pieces_of(std::span<const Vector3> points, const std::vector<bool>& failed,
                                     double distance);

}  // namespace whipple::analysis
