// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "md_fitting/fit/joint/measured_curves.hpp"
#include "md_fitting/fit/joint/variance_components.hpp"
#include "md_fitting/fit/solid_fit.hpp"

namespace whipple::fit {

/// Holds a measured curve linearised about some constants.
struct LinearCurve {
  const MeasuredCurve* curve = nullptr;
  std::vector<std::size_t> used;  ///< points with a value of the model
  Eigen::VectorXd residuals;      ///< measured minus model, of these
  Eigen::MatrixXd jacobian;       ///< with respect to the parameters of the constants
  // The deviation of GRAY's form from the curve:
  Eigen::VectorXd size;       ///< one standard deviation as stated
  std::vector<double> place;  ///< along the curve, in the unit of its length

  /// Returns the measured value of a row.
  [[nodiscard]] double ordinate(Eigen::Index row) const {
    return curve->experiment.ordinate[used[static_cast<std::size_t>(row)]];
  }
  /// Returns the variance of a row beside that of its measurement: form and table for factors of their sizes.
  [[nodiscard]] double deviation_variance(Eigen::Index row, double form, double table) const;
};

/// Linearises simulations and measurements about one set of constants and assembles the rows of all, or of some.
/// Rows: those of SolidProblem; the points of the curves; one for each constant, which says what is expected of it
/// before the data: S2 is 0 +- 0.3, all others are as simulated within a factor of exp(10).
class JointProblem {
 public:
  /// @param density  of the metal, kg/m^3
  /// @throws InputError if the constants make no material
  JointProblem(const SolidFit& fit, const SolidConstants& constants, const std::vector<MeasuredCurve>& curves,
               double density);

  /// Returns the system of the simulations and of the curves with `takes_part`.
  [[nodiscard]] LinearSystem system(const std::vector<bool>& takes_part) const;
  [[nodiscard]] const std::vector<LinearCurve>& curves() const { return curves_; }
  [[nodiscard]] SolidConstants constants_at(const Eigen::VectorXd& parameters) const {
    return simulated_.constants_at(parameters);
  }
  /// Returns the derivatives of the constants by their parameters.
  [[nodiscard]] Eigen::VectorXd scale(const Eigen::VectorXd& parameters) const {
    return simulated_.scale(parameters);
  }
  /// Returns the number of deviations of the potential, which come first among the components of a system.
  [[nodiscard]] std::size_t potential_components() const { return potential_.size(); }
  [[nodiscard]] Eigen::Index constants() const { return simulated_.constants(); }

 private:
  std::vector<Place> free_;
  std::vector<double> before_;  ///< parameters of the constants less those expected before the data
  SolidProblem simulated_;
  LeastSquaresProblem weights_;
  Eigen::VectorXd residuals_;  ///< of the simulated rows
  Eigen::MatrixXd jacobian_;
  std::vector<VarianceComponent> potential_;
  std::vector<LinearCurve> curves_;
};

/// Returns the constants of the metal's material: those of the fit at the measured density.
eos::GrayConstants material_constants(const SolidConstants& constants, double density);

}  // namespace whipple::fit
