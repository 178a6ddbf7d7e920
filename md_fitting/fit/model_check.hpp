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

/// Compares the complete material model, including electrons, with all simulated points, whether or not they were
/// used in the fit: Hugoniot, isotherms and isochores, expansion; for GRAY also melting temperature, heat and
/// volume of fusion, melt and saturated densities. Points outside the model's range are excluded.
/// @throws InputError if the constants do not form a complete model
std::vector<ModelCheck> check_gray(const eos::GrayConstants& constants, const Observations& data,
                                   std::span<const md::PointRecord> points);
/// Compares a model of a solid with the simulated points.
/// @param solid_pressure  pressure of the model's solid at (V, T), Pa
std::vector<ModelCheck> check_solid(const eos::EquationOfState& model,
                                    const std::function<double(double, double)>& solid_pressure,
                                    const Observations& data, std::span<const md::PointRecord> points);

}  // namespace whipple::fit
