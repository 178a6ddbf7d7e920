// SPDX-License-Identifier: BSD-3-Clause
#include "src/sweep/bisection.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace whipple::sweep {

std::vector<double> next_values(std::span<const Judged> judged, double tolerance) {
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < judged.size(); ++i) {
    const double from = judged[i].at, to = judged[i + 1].at, middle = from + 0.5 * (to - from);
    const bool can_divide = to - from > tolerance && middle > from && middle < to;
    if (judged[i].verdict != judged[i + 1].verdict && can_divide) values.push_back(middle);
  }
  return values;
}

Limit limit_of(std::span<const Judged> judged) {
  Limit limit;
  std::vector<Judged> decided;
  std::ranges::copy_if(judged, std::back_inserter(decided),
                       [](const Judged& j) { return j.verdict != Verdict::undecided; });
  for (std::size_t i = 0; i + 1 < decided.size(); ++i) {
    if (decided[i].verdict != decided[i + 1].verdict)
      limit.changes.emplace_back(decided[i].at, decided[i + 1].at);
  }
  // Undecided values at an end, or inside one side, leave open on which side of the limit they are.
  const bool ends_decided = !judged.empty() && judged.front().verdict != Verdict::undecided &&
                            judged.back().verdict != Verdict::undecided;
  const auto inside = [&](const Judged& j) {
    return j.verdict != Verdict::undecided ||
           (limit.changes.size() == 1 && j.at > limit.changes.front().first &&
            j.at < limit.changes.front().second);
  };
  if (limit.changes.size() > 1) {
    limit.kind = Limit::Kind::not_monotone;
  } else if (limit.changes.size() == 1 && ends_decided && std::ranges::all_of(judged, inside)) {
    limit.kind = Limit::Kind::found;
    std::tie(limit.lower, limit.upper) = limit.changes.front();
    limit.rises = decided.front().verdict == Verdict::below;
  }
  return limit;
}

std::optional<std::pair<double, double>> hull(std::span<const Limit> limits) {
  if (limits.empty()) return std::nullopt;
  std::pair<double, double> all = {limits.front().lower, limits.front().upper};
  for (const Limit& limit : limits) {
    if (limit.kind != Limit::Kind::found || limit.rises != limits.front().rises) return std::nullopt;
    all = {std::min(all.first, limit.lower), std::max(all.second, limit.upper)};
  }
  return all;
}

}  // namespace whipple::sweep
