// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/time_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace whipple::cases {

ParameterTable<TimeTable> TimeTable::parameters() {
  return {
      real_list("times", &TimeTable::times, "s", range::any(), "times of the factors, increasing").optional(),
      real_list("factors", &TimeTable::factors, "", range::any(),
                "factors at these times, linear between them, constant before and after")
          .optional()};
}

void TimeTable::check(const Faults& faults) const {
  if (times.empty() || times.size() != factors.size()) {
    faults.add("times", fmt::format("{} 'times' and {} 'factors': expected one factor per time, at least one",
                                    times.size(), factors.size()));
    return;
  }
  const auto later = std::ranges::adjacent_find(times, [](double a, double b) { return !(a < b); });
  if (later == times.end()) return;
  const auto entry = later - times.begin();
  faults.add("times", fmt::format("'times' are not in the order of time: entry {} is {} s, entry {} is {} s",
                                  entry, *later, entry + 1, *(later + 1)));
}

double TimeTable::at(double time) const {
  const auto behind = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
  if (behind == 0) return factors.front();
  if (behind == times.size()) return factors.back();
  const double share = (time - times[behind - 1]) / (times[behind] - times[behind - 1]);
  return (1.0 - share) * factors[behind - 1] + share * factors[behind];
}

double TimeTable::mean(double time, double step) const {
  if (time >= times.back()) return factors.back();
  if (time + step <= times.front()) return factors.front();
  return integral(time, time + step) / step;
}

/// Integrates the factor between two times, piece by piece with the trapezoidal rule, which is exact.
double TimeTable::integral(double from, double to) const {
  double sum = 0.0, begin = from, at_begin = at(from);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!(times[i] > from) || !(times[i] < to)) continue;
    sum += 0.5 * (at_begin + factors[i]) * (times[i] - begin);
    begin = times[i];
    at_begin = factors[i];
  }
  return sum + 0.5 * (at_begin + at(to)) * (to - begin);
}

double TimeTable::magnitude(double time) const {
  TimeTable positive = *this;
  for (double& factor : positive.factors) factor = std::abs(factor);
  return positive.integral(0.0, time);
}

double TimeTable::next_event(double time) const {
  if (factors.front() != 0.0 && time < times.front()) return time;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    if (times[i + 1] > time && (factors[i] != 0.0 || factors[i + 1] != 0.0)) return std::max(time, times[i]);
  }
  return factors.back() != 0.0 ? std::max(time, times.back()) : std::numeric_limits<double>::infinity();
}

}  // namespace whipple::cases
