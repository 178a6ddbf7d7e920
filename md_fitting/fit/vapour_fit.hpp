// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/fit/fit_settings.hpp"
#include "md_fitting/fit/observations.hpp"

namespace whipple::fit {

/// The attraction a_y of GRAY's vapour and, if the data bear it, the volume V_J of its join to the liquid.
struct VapourFit {
  std::vector<std::string> names;          ///< keys of GRAY's parameter table
  Eigen::VectorXd values;                  ///< SI
  Eigen::MatrixXd covariance;              ///< with what the other constants leave uncertain
  Eigen::MatrixXd statistical_covariance;  ///< part that stems from the noise of all data
  Eigen::MatrixXd sensitivity;             ///< d(value)/d(constant), of the constants fitted before
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  double inflation =
      1.0;             ///< of the stated model errors: (chi^2/degrees of freedom)^(1/2) where that is above 1
  std::string remark;  ///< why V_J was left at its default; empty otherwise
};

/// The constants that were fitted before, by their keys in GRAY's parameter table.
struct FittedBefore {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance, statistical_covariance;
};

/// Least squares over the saturated densities (docs/theory/fit.md, section 1). The solid's constants stay:
/// the fluid of GRAY is too rough a model for its misfit to have a say in them.
/// V_J keeps its value if the data drive it to a bound, or leave it as uncertain as its bounds do.
/// @param constants  complete, with start values of both
/// @param inflation  whether chi^2 may enlarge the errors
/// @throws StateError if the model has no liquid and vapour in equilibrium at the temperatures of the data
/// for any attraction, or the fit does not converge
VapourFit fit_vapour(const eos::GrayConstants& constants, const std::vector<SaturationState>& data,
                     const ModelErrors& errors, bool inflation, const FittedBefore& before);

/// Saturated densities of the model at a temperature, kg/m^3.
/// @throws StateError, InputError if there are none
std::pair<double, double> saturated_densities(const eos::GrayConstants& constants, double temperature);

}  // namespace whipple::fit
