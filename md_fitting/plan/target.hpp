// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "md_fitting/plan/run_size.hpp"

namespace whipple::md {

/// Specifies the target accuracy of the points of a section. It is not part of the identity of a point: a plan with
/// a smaller error continues the points in the database.
struct Target {
  double error = 0.0;
  std::int64_t most_steps = 0;

  /// @param unit    unit of the error; empty: relative
  /// @param meaning error to which the target applies
  static ParameterTable<Target> parameters(const std::string& unit, const std::string& meaning);
};

/// Returns the table of a section followed by the keys of its run size and target error.
template <class Section>
ParameterTable<Section> with_run(ParameterTable<Section> own, RunSize Section::* size,
                                 Target Section::* target, const std::string& unit,
                                 const std::string& meaning) {
  return with_part(with_part(std::move(own), size, RunSize::parameters()), target,
                   Target::parameters(unit, meaning));
}

}  // namespace whipple::md
