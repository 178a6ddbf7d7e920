// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/gray_fit.hpp"
#include "md_fitting/fit/observations.hpp"

namespace whipple::fit {

/// The complete model of the material, electrons included, against everything solid that was simulated, used
/// in the fit or not. Points outside the model's range are left out of a figure.
/// @throws InputError if the constants make no complete model
std::vector<ModelCheck> check_model(const eos::GrayConstants& constants, const Observations& data,
                                    std::span<const md::PointRecord> points);

}  // namespace whipple::fit
