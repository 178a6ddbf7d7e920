// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"

/// Which points belong together (docs/theory/analysis.md, section 3).
namespace whipple::analysis {

/// Components of points closer than `distance` to each other: for every point the least index of its
/// component. Cell list and concurrent union-find; the result does not depend on the number of threads.
std::vector<std::uint32_t> connected_components(std::span<const Vector3> points, double distance);

/// Marks a point that belongs to no piece.
constexpr std::uint32_t loose = std::numeric_limits<std::uint32_t>::max();

/// Divides points into pieces: intact ones closer than `distance` to each other are connected, and a failed one belongs to
/// the piece of the nearest intact one closer than that. Returns for every point the least index of the intact ones of
/// its piece, or `loose`. The result does not depend on the number of threads.
/// @param failed  of every point whether it has failed
std::vector<std::uint32_t> pieces_of(std::span<const Vector3> points, const std::vector<bool>& failed,
                                     double distance);

}  // namespace whipple::analysis
