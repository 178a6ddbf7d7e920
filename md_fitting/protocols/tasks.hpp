// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/refinement.hpp"

namespace whipple::md {

/// Holds the results of a task.
struct TaskResult {
  std::map<std::string, Estimate> results;
  std::string message;     ///< remark, e.g. that the crystal melted
  std::string transcript;  ///< LAMMPS commands
  std::map<std::string, std::vector<double>>
      blocks{};  ///< means over parts of the averaged time, of some results
};

/// One point of a plan: what it is, what it depends on, and how it is computed.
struct Task {
  std::string key;
  std::string protocol;
  std::map<std::string, double> conditions;
  std::map<std::string, std::string> provenance;
  std::string dependency;  ///< key of the point that must be finished before; empty: none
  Precision precision{};   ///< whether one segment is enough
  /// @param dependency the finished point of that key; null if there is none
  std::function<TaskResult(const PointRecord* dependency)> compute;
  /// One more independent run; only with a precision. @param segment 1, 2, ...
  std::function<TaskResult(const PointRecord* dependency, int segment)> extend;
};

/// All points of a plan, those that others depend on first. The key of each is the hash of everything that
/// its numbers depend on: tables of the potential, protocol and its revision, conditions, sizes, seed,
/// release of LAMMPS, ranks of a point and the key of the point it depends on. The potential must outlive
/// the tasks.
/// @throws InputError for states outside the range of the potential, all at once.
std::vector<Task> make_tasks(const Plan& plan, const Potential& potential);

}  // namespace whipple::md
