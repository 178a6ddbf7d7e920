// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

/// How well corrections predict data that took no part in them (docs/theory/fit.md, section 10).
namespace whipple::fit {

/// Names the curves whose predictions are widened by one factor.
enum class CurveGroup {
  none,  ///< not widened
  isotherm,
  molten_isotherm,
  isochore,
  molten_isochore,
  shock,
  molten_shock,
  zero_pressure,
  fluid,
  melt,
  coexistence,
  film,
  measured
};

/// Describes data of one kind, each predicted without the curve that it belongs to.
struct LeftOutCurves {
  std::string kind;
  CurveGroup group = CurveGroup::none;
  int data = 0, curves = 0;
  double inside_68 = 0.0, inside_95 = 0.0;  ///< fraction within both errors, of prediction and datum
  double half_width = 0.0;  ///< median half-width of the 95 % band of the prediction, over the scale
  double widened = 1.0;     ///< factor of the standard deviations of predictions, of all curves of the group
  double rms = 0.0;         ///< of datum less prediction, over the scale
};

/// Names what a datum belongs to.
struct LeftOutDatum {
  std::string kind, curve;
  CurveGroup group = CurveGroup::none;
  double scale = 1.0;    ///< of the kind, in the unit of the datum
  bool is_known = true;  ///< otherwise it stays and is not predicted
};

/// Predicts the data curve by curve from all others, exactly for a linear problem: with the inverse Q of the covariance of
/// all residuals r the data of a curve deviate by Q_cc^-1 (Q r)_c, with covariance Q_cc^-1 (Dubrule, Math. Geol. 15 (1983)
/// 687). Sizes and limits of the problem stay those of all data.
///
/// Predictions of a group are widened by the factor s >= 1 at which the mean of (deviation/error)^2 is 1, error^2 = s^2
/// variance of the prediction + that of the datum (Bachoc, Comput. Stat. Data Anal. 66 (2013) 55: where a covariance is not
/// that of the data, prediction errors that are seen set its size better than the likelihood). The s of a curve is that of
/// the other curves of its group, of which at least four are needed.
/// @param data        the first rows; those beyond them are kept (limits of stability)
/// @param covariance  of all residuals: of the corrections before the data, and of the errors
/// @param errors      of the data alone
/// @returns one entry for each kind, in the order of the data
std::vector<LeftOutCurves> left_out_curves(std::span<const LeftOutDatum> data,
                                           const Eigen::VectorXd& residuals,
                                           const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& errors);

}  // namespace whipple::fit
