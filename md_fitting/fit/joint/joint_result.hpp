// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

/// Defines what a joint fit of simulations and measurements reports.
namespace whipple::fit {

/// Holds the residuals of one measured curve.
struct CurveResult {
  std::string name, kind;
  int points = 0;                ///< with a value of the model
  int out_of_range = 0;          ///< without one: not part of the fit
  double rms = 0.0, mean = 0.0;  ///< (material - measured)/measured
  double rms_of_errors = 0.0;    ///< of the residual over the error of the measurement and the form
};

/// Holds the prediction of one curve by a fit without it.
struct CurveCoverage {
  std::string name, kind;
  bool left_out = true;  ///< of the fit for this prediction; otherwise never part of it
  int points = 0;
  double inside_68 = 0.0, inside_95 = 0.0;  ///< fraction within both errors of model and measurement
  double half_width = 0.0;                  ///< median half-width of the 95 % band of the model, relative
  double form_width = 0.0;                  ///< the same with the deviation of the form
  double rms = 0.0;                         ///< (prediction - measured)/measured

  /// Returns whether the other data predict the curve at all: a half-width below a half.
  [[nodiscard]] bool determined() const { return points > 0 && half_width < 0.5; }
};

/// Holds the estimated size of one deviation.
struct DeviationSize {
  std::string name;     ///< "potential, shock velocity", "form, isotherm", "table, cu_hugoniot_marsh1980"
  double factor = 1.0;  ///< of the stated size
};

/// Holds the constants of a fit without one kind of data.
struct WithoutKind {
  std::string kind;  ///< left out; "measurements": the simulations alone
  Eigen::VectorXd values, errors;
};

struct JointResult {
  std::vector<CurveResult> curves;
  std::vector<CurveCoverage> coverage;  ///< in the order of the curves; one curve alone has none
  std::vector<DeviationSize> sizes;
  std::vector<std::string> names;  ///< of the constants
  Eigen::VectorXd values, errors;
  std::vector<WithoutKind> without;
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
};

}  // namespace whipple::fit
