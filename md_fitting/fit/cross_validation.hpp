// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "md_fitting/fit/least_squares.hpp"
#include "md_fitting/fit/solid_problem.hpp"

namespace whipple::fit {

/// Describes how well the remaining data predict each datum of one kind that is left out in turn.
struct LeaveOneOut {
  std::string quantity;
  int data = 0;          ///< data predicted by the rest; excludes a datum that alone determines a constant
  double rms = 0.0;      ///< of (datum - prediction)/error: 1 is expected
  double largest = 0.0;  ///< largest magnitude of the same
  std::string worst{};   ///< the datum with the largest deviation
  double shift = 0.0;    ///< largest change of a constant, in units of its error
  std::size_t constant = 0;  ///< index of that constant
  std::string mover{};       ///< the datum whose omission shifts it
};

/// Computes leave-one-out residuals and shifts, exact for a linear problem, here linearised about the solution: with
/// the inverse covariance Q = Sigma^-1 - Sigma^-1 X (X^T Sigma^-1 X)^-1 X^T Sigma^-1 of the residuals, a datum R
/// predicted from the others deviates by Q_RR^-1 (Q r)_R, with covariance Q_RR^-1 (Dubrule, Math. Geol. 15 (1983) 687).
/// @param constants  number of leading parameters whose shifts are evaluated
std::vector<LeaveOneOut> leave_one_out(std::span<const Datum> data, const LeastSquaresSolution& solution,
                                       Eigen::Index constants);

}  // namespace whipple::fit
