// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/solid_fit.hpp"

/// Fits the constants of the GRAY equation of state to molecular dynamics: one weighted nonlinear least-squares
/// problem, one covariance (docs/theory/fit.md).
namespace whipple::fit {

struct GrayFit : Fit {
  eos::GrayConstants gray;  ///< the model of the material
  SolidFit solid;           ///< fit of the solid
};

/// Fits V0, C, S, gamma0, a, g_anh; with coexistence points also T_m0; with latent heats Delta S; with saturated
/// densities at two or more temperatures a_y and, if the data determine it, V_J. Takes the remaining constants from
/// the element's table (element_defaults.hpp).
/// @param store_name  for messages
/// @throws InputError if points are missing (all missing protocols in one message); StateError if the fit
/// does not converge.
GrayFit fit_gray(std::span<const md::PointRecord> points, const FitSettings& settings,
                 const std::string& store_name);

}  // namespace whipple::fit
