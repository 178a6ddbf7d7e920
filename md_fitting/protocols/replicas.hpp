// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/protocols/tasks.hpp"

/// Computes state points whose slowest motion lasts as long as a feasible run: the series of one run does not
/// sample it, so that value and error come from independent runs. docs/theory/molecular_dynamics.md, "Replicas".
namespace whipple::md {

/// Holds the results of one run of a state point by their names; SI.
using ReplicaValues = std::map<std::string, double>;

struct ReplicaSet {
  std::map<std::string, std::vector<double>> values;  ///< of each result, run by run
  std::string remark;                                 ///< the runs excluded, and why; empty: none
  std::string transcript;

  /// Returns the mean of a result. @throws std::out_of_range for a name that no run returned
  [[nodiscard]] Estimate mean(const std::string& result) const;
};

/// Returns the mean of n >= 2 independent values and its standard error, [sum (x - <x>)^2 / (n (n - 1))]^(1/2),
/// whose relative uncertainty is 1/sqrt(2 (n - 1)).
Estimate replica_mean(std::span<const double> values);

/// Returns the number of runs that must succeed: more than half, two at least.
std::int64_t least_replicas(std::int64_t wanted);

/// Runs a state point several times, each with a seed derived from that of the point and the index of the run. A
/// run that ends in StateError or LammpsError is excluded and named in the remark.
/// @throws StateError with the outcome of each run if fewer than `least_replicas` succeed.
ReplicaSet run_replicas(std::int64_t wanted, std::int64_t seed,
                        const std::function<ReplicaValues(std::int64_t seed, std::string& transcript)>& run);

/// Returns the means with their errors; the values of the single runs are the blocks.
TaskResult to_result(ReplicaSet set);

}  // namespace whipple::md
