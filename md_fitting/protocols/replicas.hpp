// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/protocols/tasks.hpp"

/// State points whose slowest motion lasts as long as a run can: the series of one run does not show it, so
/// value and error come from independent runs. docs/theory/molecular_dynamics.md, "Replicas".
namespace whipple::md {

/// Holds the results of one run of a state point by their names; SI.
using ReplicaValues = std::map<std::string, double>;

struct ReplicaSet {
  std::map<std::string, std::vector<double>> values;  ///< of each result, run by run
  std::string remark;                                 ///< the runs left out, and why; empty: none
  std::string transcript;

  /// @throws std::out_of_range for a name that no run brought
  [[nodiscard]] Estimate mean(const std::string& result) const;
};

/// Mean of n >= 2 independent values and its standard error, [sum (x - <x>)^2 / (n (n - 1))]^(1/2), which is
/// itself known to 1/sqrt(2 (n - 1)).
Estimate replica_mean(std::span<const double> values);

/// Runs that must come to a result: more than half, two at least.
std::int64_t least_replicas(std::int64_t wanted);

/// Runs a state point several times, each time with a seed made from that of the point and the number of the
/// run. One that ends in StateError or LammpsError is left out and named in the remark.
/// @throws StateError with what each ended like if fewer than `least_replicas` come to a result.
ReplicaSet run_replicas(std::int64_t wanted, std::int64_t seed,
                        const std::function<ReplicaValues(std::int64_t seed, std::string& transcript)>& run);

/// Means with their errors; the values of the single runs are the blocks.
TaskResult to_result(ReplicaSet set);

}  // namespace whipple::md
