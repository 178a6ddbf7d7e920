// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/cross_validation.hpp"

#include <algorithm>
#include <cmath>

#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<LeaveOneOut> leave_one_out(std::span<const Datum> data, const LeastSquaresSolution& solution,
                                       Index constants) {
  const MatrixXd& J = solution.jacobian;
  const Index n = J.rows();
  const MatrixXd inverse_factor = solution.sigma_factor.whitened(MatrixXd::Identity(n, n));
  const MatrixXd& covariance = solution.covariance;
  const MatrixXd projection = MatrixXd::Identity(n, n) - J * covariance * J.transpose();
  const MatrixXd Q = inverse_factor.transpose() * projection * inverse_factor;
  const MatrixXd inverse_sigma = inverse_factor.transpose() * inverse_factor;
  const VectorXd weighted = inverse_factor.transpose() * (projection * solution.whitened);
  // Change of the parameters per unit of a datum's weighted residual.
  const MatrixXd gain = -covariance * J.transpose() * inverse_factor;

  std::vector<LeaveOneOut> parts;
  for (const Datum& datum : data) {
    if (parts.empty() || parts.back().quantity != datum.quantity)
      parts.push_back({.quantity = datum.quantity});
    LeaveOneOut& part = parts.back();
    const MatrixXd block = Q.block(datum.begin, datum.begin, datum.rows, datum.rows);
    // Scaled by the single-datum weight: the rows of a datum may be a pressure and an energy.
    const VectorXd unit =
        inverse_sigma.diagonal().segment(datum.begin, datum.rows).cwiseSqrt().cwiseInverse();
    const SymmetricEigen eigen = symmetric_eigen(unit.asDiagonal() * block * unit.asDiagonal());
    if (!(eigen.values[0] > 1e-9)) continue;  // the other data do not determine it
    const VectorXd weight = weighted.segment(datum.begin, datum.rows);
    const VectorXd difference = solve_symmetric(block, weight);
    const double pull = std::sqrt(weight.dot(difference) / static_cast<double>(datum.rows));
    ++part.data;
    part.rms += pull * pull;
    if (pull > part.largest) part.largest = pull, part.worst = datum.label;
    const VectorXd shift = gain.middleCols(datum.begin, datum.rows) * difference;
    for (Index k = 0; k < constants; ++k) {
      const double size = std::abs(shift[k]) / std::sqrt(covariance(k, k));
      if (size > part.shift) {
        part.shift = size;
        part.constant = static_cast<std::size_t>(k);
        part.mover = datum.label;
      }
    }
  }
  for (LeaveOneOut& part : parts) part.rms = part.data > 0 ? std::sqrt(part.rms / part.data) : 0.0;
  return parts;
}

}  // namespace whipple::fit
