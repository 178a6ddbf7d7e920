// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "md_fitting/fit/observations.hpp"
#include "md_fitting/fit/solid_constants.hpp"
#include "md_fitting/fit/solid_problem.hpp"

/// The fit of one window of particle velocities with model errors of the right size, and the mean over windows
/// (docs/theory/fit.md, section 3).
namespace whipple::fit {

struct ScaledFit {
  SolidConstants constants;
  ModelScale scale;                                    ///< of the model errors
  Eigen::MatrixXd covariance, statistical_covariance;  ///< of the fitted constants, SI
};

/// Solves until the point about which the melting data are linear is the solution; one pass without such data.
/// @throws StateError if that takes more than thirty passes
SolidConstants converged(const Observations& data, const SolidModel& model, const FitSettings& settings,
                         SolidConstants constants, const ModelScale& scale = {});

/// Solves for the constants, and with `settings.inflation` for the amplitudes of the model errors: the factor f of
/// each kind of data grows until chi^2 of the kind is its redundancy r = n - tr(J_k (J^T J)^-1 J_k^T), f >= 1
/// (simplified Helmert estimate of variance components: Foerstner, Allg. Vermessungs-Nachr. 86 (1979) 446). Kinds of
/// less than half a redundant datum keep f = 1.
/// @throws StateError if constants or factors do not settle
ScaledFit fit_scaled(const Observations& data, const SolidModel& model, const FitSettings& settings,
                     const SolidConstants& start);

/// Covariance of the fitted constants in SI from that of the parameters of a solution.
Eigen::MatrixXd constants_covariance(const SolidProblem& problem, const LeastSquaresSolution& solution,
                                     const Eigen::MatrixXd& covariance);

/// Fit of one window of particle velocities.
struct WindowFit {
  double least = 0.0, most = 0.0;  ///< m/s
  int states = 0;
  double weight = 0.0;
  ScaledFit fit;
};

/// Window whose fit does not settle, and why.
struct UnsettledWindow {
  double least = 0.0, most = 0.0;  ///< m/s
  int states = 0;
  std::string reason;
};

struct WindowFits {
  std::vector<WindowFit> settled;  ///< never empty; the window of the settings comes first if it settles
  std::vector<UnsettledWindow> left_out;
};

/// Fits the window of the settings and those of the list {0-1, 0-1.5, 0-2, 0-3, 0.3-1.5, 1-3 km/s} that hold three
/// states or more; windows of the same states count once. Equal weights, with WindowChoice::single all to the
/// window of the settings. A window whose fit does not settle is left out.
/// @throws StateError if no window settles, or with WindowChoice::single that of the settings does not
WindowFits fit_windows(const Observations& data, const SolidModel& model, const FitSettings& settings,
                       const SolidConstants& start);

/// Mean over windows with their weights w: constants sum w p, covariances sum w (C + (p - mean)(p - mean)^T), the
/// part of the noise without the second term.
ScaledFit mean_of(const std::vector<WindowFit>& windows, const SolidModel& model);

}  // namespace whipple::fit
