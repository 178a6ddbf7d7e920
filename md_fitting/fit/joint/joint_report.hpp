// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "md_fitting/fit/joint/joint_result.hpp"

namespace whipple::fit {

/// Formats the tables of a joint fit: residuals of each curve, predictions of curves left out, sizes of the
/// deviations, and the constants without each kind of data.
std::string joint_text(const JointResult& joint);

/// Formats the array of tables [[coverage]] of a material file.
std::string coverage_tables(const JointResult& joint);

}  // namespace whipple::fit
