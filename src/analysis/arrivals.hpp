// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <unordered_set>
#include <vector>

#include "src/analysis/hits.hpp"

namespace whipple::analysis {

/// Follows what passes a plane in the course of a run, as the loads on a wall behind it (docs/theory/analysis.md,
/// section 5.1). Particles that begin before the plane count when they pass it for the first time.
class Arrivals {
 public:
  /// @param frame     about the point where the line of flight meets the plane
  /// @param position  axial coordinate of the plane, m
  /// @param wall      body behind the plane, which is no load on itself
  Arrivals(const Frame& frame, double position, std::optional<std::size_t> wall = {})
      : frame_(frame), position_(position), wall_(wall) {}

  /// Adds a snapshot; they come in the order of time.
  void add(const Snapshot& snapshot);

  /// Tabulates the loads until the last snapshot, in rings of a width (m).
  [[nodiscard]] Loads loads(double ring) const;

 private:
  Frame frame_;
  double position_;
  std::optional<std::size_t> wall_;
  Snapshot before_;                           // the snapshot before, without its fields
  std::unordered_set<std::uint64_t> beyond_;  // particles that have been beyond the plane
  std::vector<Hit> hits_;
};

}  // namespace whipple::analysis
