// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/discrepancy.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace whipple::fit {

double matern(double distance, double length) {
  const double r = std::numbers::sqrt3 * std::abs(distance) / length;
  return (1.0 + r) * std::exp(-r);
}

Discrepancy smooth(std::vector<double> size, std::vector<double> place, double length) {
  return {std::move(size), [place = std::move(place), length](std::size_t i, std::size_t k) {
            return matern(place[i] - place[k], length);
          }};
}

std::vector<Eigen::Index> rows_from(Eigen::Index begin, std::size_t count, Eigen::Index step) {
  std::vector<Eigen::Index> rows(count);
  for (std::size_t i = 0; i < count; ++i) rows[i] = begin + step * static_cast<Eigen::Index>(i);
  return rows;
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
