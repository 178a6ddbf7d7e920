// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/fit/joint/joint_result.hpp"
#include "md_fitting/fit/joint/measured_curves.hpp"
#include "md_fitting/fit/solid_fit.hpp"

/// Fits the constants of GRAY to simulations and measurements in one likelihood (docs/theory/fit.md, section 9).
namespace whipple::fit {

/// Moves the constants and covariances of a fit of simulations to those that fit the measured curves as well.
/// @param fit      becomes the joint fit; T_m0 joins its free constants if a melting line is measured
/// @param curves   at least one of them `fitted`
/// @param density  of the metal, kg/m^3: V0 of the measured curves; the simulations keep their own
/// @throws InputError if constants on the way make no material; StateError if the fit does not converge
JointResult fit_jointly(SolidFit& fit, const std::vector<MeasuredCurve>& curves, double density);

}  // namespace whipple::fit
