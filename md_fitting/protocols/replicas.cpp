// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/replicas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/hash.hpp"

namespace whipple::md {

Estimate replica_mean(std::span<const double> values) {
  if (values.size() < 2) throw InternalError("the error of a mean needs two independent runs");
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n * (n - 1.0)))};
}

std::int64_t least_replicas(std::int64_t wanted) { return std::max<std::int64_t>(2, wanted / 2 + 1); }

std::string repeat_runs(std::int64_t wanted, std::int64_t seed,
                        const std::function<void(std::int64_t)>& run) {
  std::string failures;
  std::int64_t failed = 0;
  const auto left_out = [&](std::int64_t number, const char* reason) {
    failures += fmt::format("{}run {}: {}", failures.empty() ? "" : "; ", number + 1, reason);
    ++failed;
  };
  for (std::int64_t number = 0; number < wanted; ++number) {
    try {
      run(seed_from(sha256(fmt::format("{} {}", seed, number))));
    } catch (const StateError& error) {
      left_out(number, error.what());
    } catch (const LammpsError& error) {
      left_out(number, error.what());
    }
    if (wanted - failed < least_replicas(wanted)) {
      throw StateError(fmt::format("{} of {} runs failed, at least {} are needed: {}", failed, wanted,
                                   least_replicas(wanted), failures));
    }
  }
  return failed > 0 ? fmt::format("{} of {} runs left out: {}", failed, wanted, failures) : std::string{};
}

}  // namespace whipple::md
