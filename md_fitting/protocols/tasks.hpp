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
      blocks{};  ///< means over parts of the averaged time, for some results
};

/// Describes one point of a plan: its identity, its dependency and its computation.
struct Task {
  std::string key;
  std::string protocol;
  std::map<std::string, double> conditions;
  std::map<std::string, std::string> provenance;
  std::string dependency;  ///< key of the point that must be finished first; empty: none
  Precision precision{};   ///< decides whether one segment is enough
  /// @param dependency the finished point with that key; null if there is none
  std::function<TaskResult(const PointRecord* dependency)> compute;
  /// Computes one more independent run; only with a precision. @param segment 1, 2, ...
  std::function<TaskResult(const PointRecord* dependency, int segment)> extend;
};

/// Returns all points of a plan, dependencies first. The key of each is the hash of everything on which its numbers
/// depend: tables of the potential, protocol and its revision, conditions, sizes, seed, LAMMPS release, ranks per
/// point and the key of the point on which it depends. The potential must outlive the tasks.
/// @throws InputError listing all states outside the range of the potential.
std::vector<Task> make_tasks(const Plan& plan, const Potential& potential);

}  // namespace whipple::md
