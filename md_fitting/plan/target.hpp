// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "md_fitting/plan/run_size.hpp"

namespace whipple::md {

/// Target accuracy of the points of a section. It is no part of the identity of a point: a plan with a smaller error
/// continues the points that a database holds.
struct Target {
  double error = 0.0;
  std::int64_t most_steps = 0;

  /// @param unit    of the error; empty: relative
  /// @param meaning which error is meant
  static ParameterTable<Target> parameters(const std::string& unit, const std::string& meaning);
};

/// Returns the table of a section with the keys of its runs and of their target error at its end.
template <class Section>
ParameterTable<Section> with_run(ParameterTable<Section> own, RunSize Section::* size,
                                 Target Section::* target, const std::string& unit,
                                 const std::string& meaning) {
  return with_part(with_part(std::move(own), size, RunSize::parameters()), target,
                   Target::parameters(unit, meaning));
}

}  // namespace whipple::md
