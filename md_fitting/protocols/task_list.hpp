// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/protocols/tasks.hpp"

namespace whipple::md {

/// Describes a point requested by a protocol, as far as it differs from the other points of the plan.
struct PointRequest {
  std::map<std::string, double> conditions;     ///< SI; units by `unit_of`
  std::map<std::string, std::string> settings;  ///< sizes, steps and choices that affect the numbers
  std::string dependency;                       ///< key of the point that is required first; empty: none
  Precision precision{};                        ///< not part of the key
};

/// Collects the tasks of a plan, to which each protocol adds points.
class TaskList {
 public:
  /// @param seed       of this point, derived from its key
  /// @param dependency the requested finished point; null if none was requested
  using Compute = std::function<TaskResult(std::int64_t seed, const PointRecord* dependency)>;

  /// @param potential must outlive the tasks
  TaskList(const Plan& plan, const Potential& potential);

  /// Assigns the points that follow to a protocol.
  void begin_protocol(const std::string& name, int revision);

  [[nodiscard]] const Potential& potential() const { return potential_; }
  /// Records an error in the plan.
  void fault(const std::string& text);
  /// Records an error unless the potential covers the volume ratio.
  void require_range(double volume_ratio);
  /// Adds a point, unless the plan already contains it. Returns its key. Records an error if its box is narrower
  /// than the cutoff, since atoms would interact with their periodic images.
  std::string add(const PointRequest& request, Compute compute);
  /// Returns the key of the first point of a protocol; empty if there is none yet.
  [[nodiscard]] std::string first_key(std::string_view protocol) const;

  /// Returns the tasks. @throws InputError with all faults, if any.
  std::vector<Task> take();

 private:
  void require_box(const PointRequest& request);

  const Potential& potential_;
  std::map<std::string, std::string> common_;
  std::string protocol_;
  int revision_ = 0;
  std::vector<Task> tasks_;
  std::set<std::string> keys_;
  std::string faults_;
};

/// Returns the settings of a run that enter the key of a point.
std::map<std::string, std::string> size_settings(const RunSize& size);

/// Converts the target of a section to points whose segments have the steps of `size`, `replicas` times.
/// @param quantity  decisive result, by its member of the record
template <class Point>
Precision precision_of(Estimate Point::* quantity, bool relative, const Target& target, const RunSize& size,
                       std::int64_t replicas = 1) {
  constexpr std::int64_t usual_segments = 20;
  return {std::string(name_of(quantity)), target.error, relative,
          target.most_steps > 0 ? std::max<std::int64_t>(1, target.most_steps / (replicas * size.steps))
                                : usual_segments};
}

/// Returns the entry of block averages of a result.
template <class Point>
std::pair<std::string, std::vector<double>> blocks_of(Estimate Point::* result, std::vector<double> means) {
  return {std::string(name_of(result)), std::move(means)};
}

/// Returns the remark for a point whose crystal has melted or contains defects or a cavity; empty for an intact
/// crystal.
/// @param crystal_share of the atoms, in the nearest minimum of the energy
/// @param displacement  root mean square, over the nearest-neighbour distance
std::string structure_remark(double crystal_share, bool solid, double displacement = 0.0);

/// Adds a remark to a finished point whose pressure is beyond the validity of its potential.
std::string with_validity(std::string message, const PointRecord& point);

}  // namespace whipple::md
