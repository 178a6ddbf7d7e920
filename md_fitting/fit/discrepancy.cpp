// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/discrepancy.hpp"

#include <cmath>
#include <numbers>

namespace whipple::fit {

double matern(double distance, double length) {
  const double r = std::numbers::sqrt3 * std::abs(distance) / length;
  return (1.0 + r) * std::exp(-r);
}

void add_discrepancy(const Discrepancy& deviation, std::span<const Eigen::Index> rows,
                     Eigen::MatrixXd& covariance) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      covariance(rows[i], rows[k]) += deviation.size[i] * deviation.size[k] * deviation.correlation(i, k);
    }
  }
}

}  // namespace whipple::fit
