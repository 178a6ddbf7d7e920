// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "md_fitting/protocols/tasks.hpp"

namespace whipple::md {

/// Describes a point that a protocol wants measured, as far as it differs from the other points of the plan.
struct PointRequest {
  std::map<std::string, double> conditions;     ///< SI; units by `unit_of`
  std::map<std::string, std::string> settings;  ///< sizes, steps and choices on which the numbers depend
  std::string dependency;                       ///< key of the point that is needed first; empty: none
  Precision precision{};                        ///< no part of the key
};

/// Collects the tasks of a plan: each protocol adds its own.
class TaskList {
 public:
  /// @param seed       of this point, made from its key
  /// @param dependency the finished point that was asked for; null if none was
  using Compute = std::function<TaskResult(std::int64_t seed, const PointRecord* dependency)>;

  /// @param potential must outlive the tasks
  TaskList(const Plan& plan, const Potential& potential);

  /// The points that follow belong to this protocol.
  void begin_protocol(const std::string& name, int revision);

  [[nodiscard]] const Potential& potential() const { return potential_; }
  /// Notes an error of the plan.
  void fault(const std::string& text);
  /// Notes an error unless the potential covers the volume ratio.
  void require_range(double volume_ratio);
  /// Adds a point, unless the plan asked for the same one before. Returns its key. Notes an error if its box
  /// is narrower than the cutoff: atoms would interact with their own images.
  std::string add(const PointRequest& request, Compute compute);
  /// Key of the first point of a protocol; empty: there is none yet.
  [[nodiscard]] std::string first_key(const std::string& protocol) const;

  /// @throws InputError with all faults, if any.
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

/// The settings of a run as they enter the key of a point.
std::map<std::string, std::string> size_settings(const RunSize& size);

/// Translates a section's target to points whose segments have the steps of `size`, `replicas` times.
Precision precision_of(const std::string& quantity, bool relative, const Target& target, const RunSize& size,
                       std::int64_t replicas = 1);

/// The remark of a point whose crystal did not survive, or holds defects or a cavity; empty for a crystal.
/// @param crystal_share of the atoms, in the nearest minimum of the energy
/// @param displacement  root mean square, over the distance of nearest neighbours
std::string structure_remark(double crystal_share, bool solid, double displacement = 0.0);

/// Adds to the remark of a finished point that its pressure is beyond the validity of its potential, if it
/// is.
std::string with_validity(std::string message, const PointRecord& point);

}  // namespace whipple::md
