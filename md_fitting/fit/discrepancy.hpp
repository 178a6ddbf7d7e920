// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

/// Models the covariance of the model discrepancy of a law along its curve (docs/theory/fit.md, section 3).
namespace whipple::fit {

/// Returns the correlation of a smooth function at two places: Matern's with nu = 3/2, (1 + r) exp(-r), r = 3^(1/2)
/// d/length (Rasmussen & Williams, Gaussian Processes for Machine Learning (2006), eq. 4.17). Its functions are
/// once differentiable: smoother ones (squared exponential) make the covariance of neighbouring states singular.
double matern(double distance, double length);

/// Describes one discrepancy of a law: its standard deviation at each state, in the unit of the row, and the
/// correlation of two states.
struct Discrepancy {
  std::vector<double> size;
  std::function<double(std::size_t, std::size_t)> correlation;
};

/// Returns a discrepancy that is smooth along a curve, with Matern's correlation.
/// @param place, length  of the states and over which it changes, in one unit
Discrepancy smooth(std::vector<double> size, std::vector<double> place, double length);

/// Returns row indices from `begin` on.
std::vector<Eigen::Index> rows_from(Eigen::Index begin, std::size_t count, Eigen::Index step = 1);

/// Adds the covariance of a discrepancy to the rows of its states.
/// @param rows  row of each state in `covariance`
void add_discrepancy(const Discrepancy& deviation, std::span<const Eigen::Index> rows,
                     Eigen::MatrixXd& covariance);

}  // namespace whipple::fit
