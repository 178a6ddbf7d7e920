// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace whipple::bench {

/// A case of the project as a problem to time. The steps before the timed ones bring it into the state of
/// interest.
struct Problem {
  std::string name;
  std::string what;
  std::string case_file;  ///< in the source tree
  std::vector<std::pair<std::string, std::string>> overrides;
  int steps_before = 0;
  int steps = 0;  ///< five parts, in each of which the particles are sorted once (not with --quick)
  /// s: after the first steps all material flies on for so long without forces, so that a cloud gets as thin as
  /// late ones are without the cost of getting there; 0: none
  double thinning = 0.0;
  bool only_by_name = false;  ///< needs gigabytes and minutes: not one of those that are timed unasked
};

const std::vector<Problem>& problems();

/// @throws InputError that lists the names
const Problem& find_problem(std::string_view name);

}  // namespace whipple::bench
