// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/protocols/tasks.hpp"

/// Computes state points whose slowest motion lasts as long as a feasible run: the series of one run does not
/// sample it, so that value and error come from independent runs. docs/theory/molecular_dynamics.md, "Replicas".
namespace whipple::md {

/// Returns the mean of n >= 2 independent values and its standard error, [sum (x - <x>)^2 / (n (n - 1))]^(1/2),
/// whose relative uncertainty is 1/sqrt(2 (n - 1)).
Estimate replica_mean(std::span<const double> values);

/// Returns the number of runs that must succeed: more than half, two at least.
std::int64_t least_replicas(std::int64_t wanted);

/// Runs of a state point that succeeded.
/// @tparam Point  record of the protocol, or a record derived from it; the results of a run have no errors
template <class Point>
struct ReplicaSet {
  std::vector<Point> runs;
  std::string remark;  ///< the runs excluded, and why; empty: none
  std::string transcript;

  /// Returns the values of a result, run by run.
  template <class Record, class Value>
  [[nodiscard]] std::vector<double> values(Value Record::* member) const {
    std::vector<double> numbers;
    for (const Point& run : runs) {
      if constexpr (std::is_same_v<Value, double>) numbers.push_back(run.*member);
      if constexpr (std::is_same_v<Value, Estimate>) numbers.push_back((run.*member).value);
      if constexpr (std::is_same_v<Value, std::optional<Estimate>>) {
        if (run.*member) numbers.push_back((run.*member)->value);
      }
    }
    return numbers;
  }
  /// Returns the mean of a result with its error.
  template <class Record, class Value>
  [[nodiscard]] Estimate mean(Value Record::* member) const {
    return replica_mean(values(member));
  }
};

/// Runs a state point several times, each with a seed derived from that of the point and the index of the run. A
/// run that ends in StateError or LammpsError is excluded and named in the remark.
/// @param run  appends its commands to the transcript
/// @returns the remark
/// @throws StateError with the outcome of each run if fewer than `least_replicas` succeed.
std::string repeat_runs(std::int64_t wanted, std::int64_t seed,
                        const std::function<void(std::int64_t seed)>& run);

/// Runs a state point several times, as `repeat_runs` does.
/// @param run  run(seed, transcript) returns the record of one run
template <class Point>
ReplicaSet<Point> run_replicas(
    std::int64_t wanted, std::int64_t seed,
    const std::type_identity_t<std::function<Point(std::int64_t seed, std::string& transcript)>>& run) {
  ReplicaSet<Point> set;
  set.remark = repeat_runs(wanted, seed,
                           [&](std::int64_t own_seed) { set.runs.push_back(run(own_seed, set.transcript)); });
  return set;
}

/// Returns the means with their errors; the values of the single runs are the blocks.
/// @tparam Record  of the protocol
template <class Record, class Point>
TaskResult to_result(const ReplicaSet<Point>& set) {
  TaskResult result{.results = {}, .message = set.remark, .transcript = set.transcript};
  for (const Quantity<Record>& quantity : Record::results()) {
    std::vector<double> values = std::visit([&](auto member) { return set.values(member); }, quantity.member);
    if (values.empty()) continue;
    result.results[std::string(quantity.name)] = replica_mean(values);
    result.blocks[std::string(quantity.name)] = std::move(values);
  }
  return result;
}

}  // namespace whipple::md
