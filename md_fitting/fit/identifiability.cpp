// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/identifiability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd sizes(const Fit& fit) {
  VectorXd size(static_cast<Index>(fit.fitted_names.size()));
  for (Index k = 0; k < size.size(); ++k) {
    const double value = fit.value(fit.fitted_names[static_cast<std::size_t>(k)]);
    size[k] = std::max(std::abs(value), std::sqrt(fit.covariance(k, k)));
  }
  return size;
}

/// Formats the largest components of a combination, e.g. "0.98 hugoniot_intercept - 0.21 hugoniot_slope".
std::string combination(const Fit& fit, const VectorXd& vector) {
  constexpr double least_part = 0.3;
  std::vector<Index> order(static_cast<std::size_t>(vector.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::sort(order, [&](Index a, Index b) { return std::abs(vector[a]) > std::abs(vector[b]); });
  const double sign = vector[order.front()] < 0.0 ? -1.0 : 1.0;
  std::string text;
  for (const Index k : order) {
    const double part = sign * vector[k];
    if (std::abs(part) < least_part) break;
    text += fmt::format("{}{:.2f} {}",
                        text.empty() ? ""
                        : part < 0.0 ? " - "
                                     : " + ",
                        std::abs(part), fit.fitted_names[static_cast<std::size_t>(k)]);
  }
  return text;
}

/// Describes in words how well the data determine a constant.
std::string verdict(const Fit& fit, const Determination& one) {
  constexpr double two_errors = 0.5;       // relative error of a constant compatible with zero
  constexpr double in_combination = 0.95;  // correlation
  std::string text = one.relative_error > two_errors
                         ? std::string("not distinguished from zero")
                         : fmt::format("known to {:.2g} %", 100.0 * one.relative_error);
  if (std::abs(one.correlation) > in_combination) {
    text += fmt::format(", mostly with {}", fit.fitted_names[one.partner]);
  }
  return text;
}

}  // namespace

Identifiability identifiability(const Fit& fit) {
  const VectorXd size = sizes(fit);
  const MatrixXd scaled =
      size.cwiseInverse().asDiagonal() * fit.covariance * size.cwiseInverse().asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(scaled);
  if (!(eigen.values[0] > 0.0)) throw StateError("the covariance of the fitted constants is singular");
  Identifiability result;
  result.eigenvalues = eigen.values.cwiseInverse().reverse();
  result.vectors = eigen.vectors.rowwise().reverse();
  const MatrixXd fisher = inverse_of_symmetric(scaled);
  const MatrixXd correlation = fit.correlation();
  for (Index k = 0; k < size.size(); ++k) {
    Determination one;
    const double error = std::sqrt(fit.covariance(k, k));
    one.relative_error = error / std::abs(fit.value(fit.fitted_names[static_cast<std::size_t>(k)]));
    one.conditional_error = size[k] / std::sqrt(fisher(k, k));
    one.inflation = error / one.conditional_error;
    for (Index i = 0; i < size.size(); ++i) {
      if (i == k || std::abs(correlation(k, i)) <= std::abs(one.correlation)) continue;
      one.partner = static_cast<std::size_t>(i);
      one.correlation = correlation(k, i);
    }
    result.constants.push_back(one);
  }
  return result;
}

std::string identifiability_text(const Fit& fit) {
  const Identifiability result = identifiability(fit);
  std::string text =
      "\ninformation of the data: eigenvalues of the Fisher matrix (constants in units of themselves, or of "
      "their "
      "errors where larger), and the combination that is known to eigenvalue^(-1/2)\n";
  for (Index k = 0; k < result.eigenvalues.size(); ++k) {
    text += fmt::format("  {:.3g}: {}\n", result.eigenvalues[k], combination(fit, result.vectors.col(k)));
  }
  text +=
      "identifiability: constant, total error over the error with all others known, largest correlation\n";
  for (std::size_t k = 0; k < result.constants.size(); ++k) {
    const Determination& one = result.constants[k];
    text += fmt::format("  {}: {:.1f}, {:+.2f} with {}; {}\n", fit.fitted_names[k], one.inflation,
                        one.correlation, fit.fitted_names[one.partner], verdict(fit, one));
  }
  return text;
}

}  // namespace whipple::fit
