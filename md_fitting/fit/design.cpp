// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/design.hpp"

#include <utility>

#include "src/core/base/error.hpp"

namespace whipple::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

std::vector<Index> as_vector(std::span<const Index> rows) { return {rows.begin(), rows.end()}; }

}  // namespace

Design::Design(MatrixXd jacobian, MatrixXd sigma, VectorXd weak, std::vector<Index> present)
    : jacobian_(std::move(jacobian)),
      sigma_(std::move(sigma)),
      weak_(std::move(weak)),
      present_(std::move(present)) {
  update();
}

void Design::update() {
  factor_ = Cholesky(sigma_(present_, present_));
  if (!factor_.is_positive()) {
    throw StateError("the covariance of the data is not positive definite (a datum without error?)");
  }
  const MatrixXd present = jacobian_(present_, Eigen::all);
  whitened_ = factor_.whitened(present);
  MatrixXd information = whitened_.transpose() * whitened_;
  information.diagonal() += weak_.cwiseAbs2().cwiseInverse();
  covariance_ = Cholesky(information).solve(MatrixXd::Identity(information.rows(), information.cols()));
}

double Design::reduction(std::span<const Index> rows, const VectorXd& gradient) const {
  const std::vector<Index> chosen = as_vector(rows);
  // Part of the new rows not predicted by the present ones: u = J_c - Sigma_cA Sigma_A^-1 J_A.
  const MatrixXd common = sigma_(present_, chosen);
  const MatrixXd shared = factor_.whitened(common);
  const MatrixXd jacobian = jacobian_(chosen, Eigen::all);
  const MatrixXd own = jacobian - shared.transpose() * whitened_;
  const MatrixXd noise = sigma_(chosen, chosen);
  const MatrixXd spread = noise - shared.transpose() * shared + own * covariance_ * own.transpose();
  const VectorXd told = own * (covariance_ * gradient);
  return told.dot(VectorXd(Cholesky(spread).solve(told)));
}

void Design::add(std::span<const Index> rows) {
  present_.insert(present_.end(), rows.begin(), rows.end());
  update();
}

}  // namespace whipple::fit
