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

/// Holds the attraction a_y of GRAY's vapour and, if the data determine it, the volume V_J of its join to the liquid.
struct VapourFit {
  std::vector<std::string> names;          ///< keys of GRAY's parameter table
  Eigen::VectorXd values;                  ///< SI
  Eigen::MatrixXd covariance;              ///< includes the uncertainty of the other constants
  Eigen::MatrixXd statistical_covariance;  ///< part due to the noise of all data
  Eigen::MatrixXd sensitivity;             ///< d(value)/d(constant), for the constants fitted before
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  /// Factor on the stated model errors: (chi^2/degrees of freedom)^(1/2) if that exceeds 1.
  double inflation = 1.0;
  std::string remark;  ///< why V_J was left at its default; empty otherwise
};

/// Holds the constants that were fitted before, by their keys in GRAY's parameter table.
struct FittedBefore {
  std::vector<std::string> names;
  Eigen::MatrixXd covariance, statistical_covariance;
};

/// Fits the saturated densities by least squares (docs/theory/fit.md, section 1). The constants of the solid are
/// kept: the fluid of GRAY is too approximate for its misfit to influence them. V_J keeps its value if the data
/// drive it to a bound, or leave it as uncertain as its bounds do.
/// @param constants  complete, with start values of both
/// @param inflation  whether chi^2 may enlarge the errors
/// @throws StateError if the model has no liquid-vapour equilibrium at the temperatures of the data for any
/// attraction, or the fit does not converge
VapourFit fit_vapour(const eos::GrayConstants& constants, const std::vector<SaturationState>& data,
                     const ModelErrors& errors, bool inflation, const FittedBefore& before);

/// Returns the saturated densities of the model at a temperature, kg/m^3.
/// @throws StateError, InputError if there are none
std::pair<double, double> saturated_densities(const eos::GrayConstants& constants, double temperature);

}  // namespace whipple::fit
