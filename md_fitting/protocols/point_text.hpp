// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "md_fitting/data_set/data_set.hpp"

/// Points and their results as text for the user.
namespace whipple::md {

/// Formats a result for the user, e.g. "pressure = 45.312 +- 0.011 GPa": usual units, two digits of the error.
std::string format_result(const std::string& quantity, const Estimate& estimate);

/// Returns a label such as "isotherm at specific_volume = 0.1119 cm^3/g, temperature = 293 K".
std::string short_label(const PointRecord& point);

/// Summarises a point and its results in one line.
std::string summarize(const PointRecord& point);

}  // namespace whipple::md
