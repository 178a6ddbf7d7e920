// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/sweep/points.hpp"

namespace whipple::sweep {

/// Checks that the results which a study wants exist in runs of its case, and that the threshold of its limit has the unit
/// of its quantity, where that is known before a run.
/// @throws InputError naming the study and what is accepted
void check_quantities(const Plan& plan);

}  // namespace whipple::sweep
