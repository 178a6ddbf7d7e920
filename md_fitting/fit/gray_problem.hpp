// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/fit/fit_settings.hpp"
#include "md_fitting/fit/least_squares.hpp"
#include "md_fitting/fit/observations.hpp"

namespace whipple::fit {

/// The least-squares problem of GRAY: which residual belongs to which datum, and with which weight
/// (docs/theory/fit.md, sections 2 and 3). Rows: V0; the Hugoniot states of the window; P and E of each
/// isochore state; the coexistence points. Parameters: the constants, then two intercepts per isochore.
class GrayProblem {
 public:
  /// @param data   outlives the problem
  /// @param start  start values of the fitted constants, and the values of all others
  /// @throws InputError if the start values contradict each other
  GrayProblem(const Observations& data, const FitSettings& settings, const eos::GrayConstants& start);

  [[nodiscard]] LeastSquaresProblem least_squares() const;
  [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& parameters) const;

  /// Names of the fitted constants, in the order of the parameters.
  [[nodiscard]] std::vector<std::string> fitted_names() const;
  [[nodiscard]] eos::GrayConstants constants_at(const Eigen::VectorXd& parameters) const;
  /// d(constant)/d(parameter), diagonal: brings the covariance of the parameters to SI.
  [[nodiscard]] Eigen::VectorXd scale(const eos::GrayConstants& constants) const;

  /// Us and up of a state from its pressure and volume by the jump conditions about V0.
  static std::pair<double, double> velocities(const HugoniotState& state, double reference_volume);

  [[nodiscard]] Eigen::Index constants() const { return constants_; }  ///< number of fitted ones
  [[nodiscard]] const std::vector<HugoniotState>& window() const { return window_; }
  [[nodiscard]] Eigen::Index hugoniot_begin() const { return 1; }
  [[nodiscard]] Eigen::Index isochores_begin() const { return 1 + static_cast<Eigen::Index>(window_.size()); }
  [[nodiscard]] Eigen::Index melting_begin() const { return isochores_begin() + 2 * thermal_states_; }
  [[nodiscard]] Eigen::Index size() const {
    return melting_begin() + static_cast<Eigen::Index>(data_.melting.size());
  }

 private:
  enum Place : Eigen::Index { volume, intercept, slope, gruneisen, gruneisen_slope, anharmonic, melting };

  struct Intercepts {
    double pressure, energy;  ///< of P - gamma E/V - ... and of E - 3RT - ..., at T = 0
  };
  [[nodiscard]] Intercepts intercepts(const Eigen::VectorXd& parameters, std::size_t isochore) const;
  void linearise_solidus();
  void weigh(Eigen::MatrixXd& statistical, Eigen::MatrixXd& model) const;
  void weigh_isochore(const Isochore& isochore, Eigen::Index begin, Eigen::MatrixXd& statistical,
                      Eigen::MatrixXd& model) const;
  [[nodiscard]] bool fits_melting() const { return !data_.melting.empty(); }

  const Observations& data_;
  FitSettings settings_;
  eos::GrayConstants start_;
  std::vector<HugoniotState> window_;
  std::vector<Intercepts> cold_;    ///< of the start values: the parameters count from there
  Eigen::VectorXd solidus_;         ///< of the coexistence points, at the start values, K
  Eigen::MatrixXd solidus_slopes_;  ///< by the parameters
  Eigen::Index thermal_states_ = 0;
  Eigen::Index constants_ = 0;
};

}  // namespace whipple::fit
