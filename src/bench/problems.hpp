// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace whipple::bench {

/// Describes a case of the project as a benchmark problem. The preliminary steps bring it to the state of interest.
struct Problem {
  std::string name;
  std::string what;
  std::string case_file;  ///< in the source tree
  std::vector<std::pair<std::string, std::string>> overrides;
  int steps_before = 0;
  int steps = 0;  ///< five parts, in each of which the particles are sorted once (not with --quick)
  /// Sets the time (s) for which all material moves without forces after the preliminary steps, so that a cloud becomes
  /// as thin as late ones without the cost of computing it; 0: none.
  double thinning = 0.0;
  bool only_by_name = false;  ///< needs gigabytes and minutes: not included in the default problems
};

const std::vector<Problem>& problems();

/// Returns the problem of a name.
/// @throws InputError that lists the names
const Problem& find_problem(std::string_view name);

/// Returns a problem with about `times` as many points, in cells finer by the cube root of it, at the same depth.
/// @throws InputError if its case cannot be read
Problem refined(const Problem& problem, int times);

}  // namespace whipple::bench
