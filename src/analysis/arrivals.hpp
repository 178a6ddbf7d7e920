// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <unordered_set>
#include <vector>

#include "src/analysis/hits.hpp"

namespace whipple::analysis {

/// Records the material passing a plane during a run, as the loads on a wall behind it (docs/theory/analysis.md,
/// section 5.1). Particles that start before the plane are counted when they first pass it.
class Arrivals {
 public:
  /// Sets up the record for a plane.
  /// @param frame     about the point where the line of flight meets the plane
  /// @param position  axial coordinate of the plane, m
  /// @param wall      body behind the plane, which does not count as a load
  Arrivals(const Frame& frame, double position, std::optional<std::size_t> wall = {})
      : frame_(frame), position_(position), wall_(wall) {}

  /// Adds a snapshot; snapshots must be added in order of time.
  void add(const Snapshot& snapshot);

  /// Tabulates the loads up to the last snapshot in rings of width `ring` (m).
  [[nodiscard]] Loads loads(double ring) const;

 private:
  Frame frame_;
  double position_;
  std::optional<std::size_t> wall_;
  Snapshot before_;                           // the previous snapshot, without its fields
  std::unordered_set<std::uint64_t> beyond_;  // particles that have been beyond the plane
  std::vector<Hit> hits_;
};

}  // namespace whipple::analysis
