// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/models/gray_constants.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/observations.hpp"

namespace whipple::fit {

/// The complete model of the material, electrons included, against everything that was simulated, used in the
/// fit or not: Hugoniot, isotherms and isochores, expansion; for GRAY also melting temperature, heat and
/// volume of fusion, melt and saturated densities. Points outside the model's range are left out of a figure.
/// @throws InputError if the constants make no complete model
std::vector<ModelCheck> check_gray(const eos::GrayConstants& constants, const Observations& data,
                                   std::span<const md::PointRecord> points);
/// @param solid_pressure  of the model's solid at (V, T), Pa
std::vector<ModelCheck> check_solid(const eos::EquationOfState& model,
                                    const std::function<double(double, double)>& solid_pressure,
                                    const Observations& data, std::span<const md::PointRecord> points);

}  // namespace whipple::fit
