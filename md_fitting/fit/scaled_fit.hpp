// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "md_fitting/fit/observations.hpp"
#include "md_fitting/fit/solid_constants.hpp"
#include "md_fitting/fit/solid_problem.hpp"

/// Fits one window of particle velocities with scaled model errors, and averages over windows (docs/theory/fit.md,
/// section 3).
namespace whipple::fit {

struct ScaledFit {
  SolidConstants constants;
  ModelScale scale;                                    ///< of the model errors
  Eigen::MatrixXd covariance, statistical_covariance;  ///< of the fitted constants, SI
};

/// Iterates until the linearisation point of the melting data is the solution; one pass without such data.
/// @throws StateError if that takes more than thirty passes
SolidConstants converged(const Observations& data, const SolidModel& model, const FitSettings& settings,
                         SolidConstants constants, const ModelScale& scale = {});

/// Solves for the constants, and with `settings.inflation` for the amplitudes of the model errors: the factor f of
/// each kind of data is increased until chi^2 of that kind equals its redundancy r = n - tr(J_k (J^T J)^-1 J_k^T),
/// f >= 1 (simplified Helmert estimate of variance components: Foerstner, Allg. Vermessungs-Nachr. 86 (1979) 446).
/// Kinds with less than half a redundant datum keep f = 1.
/// @throws StateError if constants or factors do not converge
ScaledFit fit_scaled(const Observations& data, const SolidModel& model, const FitSettings& settings,
                     const SolidConstants& start);

/// Returns the covariance of the fitted constants in SI from the covariance of the parameters of a solution.
Eigen::MatrixXd constants_covariance(const SolidProblem& problem, const LeastSquaresSolution& solution,
                                     const Eigen::MatrixXd& covariance);

/// Holds the fit of one window of particle velocities.
struct WindowFit {
  double least = 0.0, most = 0.0;  ///< m/s
  int states = 0;
  double weight = 0.0;
  ScaledFit fit;
};

/// Describes a window whose fit does not converge, with the reason.
struct UnsettledWindow {
  double least = 0.0, most = 0.0;  ///< m/s
  int states = 0;
  std::string reason;
};

struct WindowFits {
  std::vector<WindowFit> settled;  ///< never empty; the window of the settings comes first if it converges
  std::vector<UnsettledWindow> left_out;
};

/// Fits the window of the settings and those of the list {0-1, 0-1.5, 0-2, 0-3, 0.3-1.5, 1-3 km/s} that contain
/// three or more states; windows with the same states count once. Weights are equal; with WindowChoice::single the
/// window of the settings has all the weight. A window whose fit does not converge is excluded.
/// @throws StateError if no window converges, or with WindowChoice::single if that of the settings does not
WindowFits fit_windows(const Observations& data, const SolidModel& model, const FitSettings& settings,
                       const SolidConstants& start);

/// Returns the mean over windows with their weights w: constants sum w p, covariances sum w (C + (p - mean)(p -
/// mean)^T); the noise part omits the second term.
ScaledFit mean_of(const std::vector<WindowFit>& windows, const SolidModel& model);

}  // namespace whipple::fit
