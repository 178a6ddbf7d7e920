// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace whipple::eos {

/// Finds the root of a continuous function between two points with values of opposite sign (or zero), by the
/// bracketing method TOMS 748 of Boost.Math; at most 200 evaluations.
/// @param digits  required bits of the result
/// @throws StateError if the signs are equal or a value is NaN; `what` names the quantity in the message
double find_root(const std::function<double(double)>& function, double from, double to, const char* what,
                 int digits = 48);

}  // namespace whipple::eos
