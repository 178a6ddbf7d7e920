// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/material/material.hpp"

namespace whipple {

/// Describes how well a fit predicted a measured curve that took no part in it: a table [[coverage]] of a material
/// file (docs/theory/fit.md, section 9).
struct Coverage {
  std::string curve, kind;
  std::int64_t points = 0;
  double inside_68 = 0.0, inside_95 = 0.0;  ///< fraction of the points within these levels
  double half_width = 0.0;                  ///< of the 95 % band of the constants, relative
  double half_width_with_form = 0.0;        ///< with the error of the model's form
  double rms = 0.0;                         ///< (prediction - measured)/measured
};

/// Reads the tables [[coverage]] of the file of a material; none for one without. @throws InputError with file and line
std::vector<Coverage> coverage_of(const Material& material);

}  // namespace whipple
