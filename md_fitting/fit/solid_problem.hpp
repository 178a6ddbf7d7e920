// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "md_fitting/fit/fit_settings.hpp"
#include "md_fitting/fit/least_squares.hpp"
#include "md_fitting/fit/observations.hpp"
#include "md_fitting/fit/solid_constants.hpp"

namespace whipple::fit {

/// Lists the kinds of data; each has a law and a model error.
enum class DataKind { volume, shock, isotherm, isochore, melting, fusion };
constexpr std::size_t data_kinds = 6;

/// Holds the factors of the model errors by kind of data: 1 as stated, larger where the data follow the law less well.
struct ModelScale {
  std::array<double, data_kinds> factor = {1, 1, 1, 1, 1, 1};
  double& of(DataKind kind) { return factor[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] double of(DataKind kind) const { return factor[static_cast<std::size_t>(kind)]; }
};

/// Describes the rows of one datum: a state of pressure and energy has two.
struct Datum {
  std::string quantity;  ///< "shock velocity", ...
  std::string label;     ///< "up = 1.2 km/s"
  Eigen::Index begin = 0, rows = 1;
  DataKind kind = DataKind::volume;
};

/// Sets up the least-squares problem of a model of the solid: the residual and weight of each datum
/// (docs/theory/fit.md, sections 2 and 3). Rows: V0; the Hugoniot states of the window; the states of the isotherm;
/// P and E of each isochore state; melting temperatures; latent heats. Parameters: the constants of the model, each
/// mapped into its bounds, then two intercepts per isochore.
class SolidProblem {
 public:
  /// @param data   must outlive the problem
  /// @param start  start values of the fitted constants, and the values of all others
  /// @param scale  of the model errors
  /// @throws InputError if the start values contradict each other
  SolidProblem(const Observations& data, const FitSettings& settings, const SolidModel& model,
               const SolidConstants& start, const ModelScale& scale = {});

  [[nodiscard]] LeastSquaresProblem least_squares() const;
  [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& parameters) const;

  [[nodiscard]] SolidConstants constants_at(const Eigen::VectorXd& parameters) const;
  /// Returns d(constant)/d(parameter), diagonal; converts the covariance of the parameters to SI.
  [[nodiscard]] Eigen::VectorXd scale(const Eigen::VectorXd& parameters) const;

  /// Returns Us and up of a state from its pressure and volume by the jump conditions relative to V0.
  static std::pair<double, double> velocities(const HugoniotState& state, double reference_volume);

  [[nodiscard]] Eigen::Index constants() const { return static_cast<Eigen::Index>(bounded_.size()); }
  [[nodiscard]] const std::vector<HugoniotState>& window() const { return window_; }
  /// Returns whether a state of the data has a row: its particle velocity is within the window of the settings.
  [[nodiscard]] bool in_window(const HugoniotState& state) const;
  /// Returns all data, in the order of the rows.
  [[nodiscard]] const std::vector<Datum>& data() const { return rows_; }
  [[nodiscard]] Eigen::Index size() const { return size_; }

 private:
  struct Intercepts {
    double pressure, energy;  ///< of P - gamma E/V - ... and of E - c T - ..., at T = 0
  };
  [[nodiscard]] Intercepts intercepts(const Eigen::VectorXd& parameters, std::size_t isochore) const;
  [[nodiscard]] Eigen::VectorXd melting_values(const SolidConstants& constants) const;
  void list_data();
  void linearise_melting();
  void weigh_noise(Eigen::MatrixXd& statistical) const;
  void weigh_model(Eigen::MatrixXd& model) const;
  void weigh_isochores(Eigen::Index begin, Eigen::MatrixXd& model) const;

  const Observations& observations_;
  FitSettings settings_;
  SolidModel model_;
  SolidConstants start_;
  ModelScale scale_;
  std::vector<BoundedParameter> bounded_;
  std::vector<HugoniotState> window_;
  std::vector<const MeltingPoint*> melting_,
      fusion_;                      ///< with a temperature, with a latent heat to be fitted
  std::vector<Intercepts> cold_;    ///< at the start values; the parameters are relative to them
  Eigen::VectorXd melting_start_;   ///< melting temperatures and latent heats at the start values
  Eigen::MatrixXd melting_slopes_;  ///< derivatives with respect to the parameters
  std::vector<Datum> rows_;
  Eigen::Index size_ = 0;
};

}  // namespace whipple::fit
