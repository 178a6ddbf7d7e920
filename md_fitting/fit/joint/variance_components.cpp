// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/joint/variance_components.hpp"

#include <gsl/gsl_multimin.h>

#include <cmath>
#include <exception>
#include <memory>

#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Holds the factors of Sigma and of J^T Sigma^-1 J.
struct SystemFactors {
  Cholesky sigma, normal;
  MatrixXd weighted;  ///< Sigma^-1 J
};

SystemFactors factors_of(const LinearSystem& system, const VectorXd& log_factors) {
  SystemFactors factors{Cholesky(system.covariance(log_factors)), {}, {}};
  if (!factors.sigma.is_positive())
    throw StateError("joint fit: the covariance of the data is not positive definite");
  factors.weighted = factors.sigma.solve(system.jacobian);
  // Columns of unit length: the constants of a fit have different units.
  factors.normal = Cholesky(system.jacobian.transpose() * factors.weighted);
  if (!factors.normal.is_positive())
    throw StateError("joint fit: the data leave a combination of the constants undetermined");
  return factors;
}

double log_determinant(const Cholesky& factor) { return 2.0 * factor.lower().diagonal().array().log().sum(); }

/// Holds the function to be minimised and its gradient.
struct Objective {
  double value = 0.0;
  VectorXd gradient;
};

Objective objective(const LinearSystem& system, const VectorXd& log_factors) {
  const SystemFactors factors = factors_of(system, log_factors);
  const VectorXd weighted = factors.sigma.solve(system.residuals);
  const VectorXd rest =
      weighted - factors.weighted * factors.normal.solve(system.jacobian.transpose() * weighted);  // P r
  const auto size = system.residuals.size();
  const MatrixXd projector = factors.sigma.solve(MatrixXd::Identity(size, size)) -
                             factors.weighted * factors.normal.solve(factors.weighted.transpose());
  Objective result;
  result.value =
      log_determinant(factors.sigma) + log_determinant(factors.normal) + system.residuals.dot(rest);
  result.gradient.resize(log_factors.size());
  for (std::size_t i = 0; i < system.components.size(); ++i) {
    const VarianceComponent& component = system.components[i];
    const double x = log_factors[static_cast<Index>(i)];
    const MatrixXd block = projector(component.rows, component.rows);
    const VectorXd part = rest(component.rows);
    const double slope =
        block.cwiseProduct(component.covariance).sum() - part.dot(component.covariance * part);
    result.gradient[static_cast<Index>(i)] =
        2.0 * std::exp(2.0 * x) * slope + 2.0 * x / (component.spread * component.spread);
    result.value += x * x / (component.spread * component.spread);
  }
  return result;
}

/// Passes the objective to GSL; no exception may propagate through its C frames.
struct Callback {
  const LinearSystem* system;
  std::exception_ptr failure;

  double evaluate(const gsl_vector* x, gsl_vector* gradient) {
    constexpr double worse_than_any = 1e30;
    try {
      VectorXd place(static_cast<Index>(x->size));
      for (std::size_t i = 0; i < x->size; ++i) place[static_cast<Index>(i)] = gsl_vector_get(x, i);
      const Objective at = objective(*system, place);
      if (gradient != nullptr) {
        for (std::size_t i = 0; i < x->size; ++i)
          gsl_vector_set(gradient, i, at.gradient[static_cast<Index>(i)]);
      }
      return at.value;
    } catch (...) {
      failure = std::current_exception();
      if (gradient != nullptr) gsl_vector_set_zero(gradient);
      return worse_than_any;
    }
  }
};

double value_of(const gsl_vector* x, void* data) {
  return static_cast<Callback*>(data)->evaluate(x, nullptr);
}
void gradient_of(const gsl_vector* x, void* data, gsl_vector* gradient) {
  static_cast<Callback*>(data)->evaluate(x, gradient);
}
void both_of(const gsl_vector* x, void* data, double* value, gsl_vector* gradient) {
  *value = static_cast<Callback*>(data)->evaluate(x, gradient);
}

}  // namespace

MatrixXd LinearSystem::covariance(const VectorXd& log_factors) const {
  MatrixXd sigma = fixed;
  for (std::size_t i = 0; i < components.size(); ++i) {
    sigma(components[i].rows, components[i].rows) +=
        std::exp(2.0 * log_factors[static_cast<Index>(i)]) * components[i].covariance;
  }
  return sigma;
}

LinearEstimate estimate(const LinearSystem& system, const VectorXd& log_factors) {
  const SystemFactors factors = factors_of(system, log_factors);
  const Index count = system.jacobian.cols();
  LinearEstimate result;
  result.covariance = factors.normal.solve(MatrixXd::Identity(count, count));
  const MatrixXd estimator = -result.covariance * factors.weighted.transpose();
  result.parameters = estimator * system.residuals;
  result.statistical_covariance = estimator * system.noise * estimator.transpose();
  const VectorXd rest = system.residuals + system.jacobian * result.parameters;
  result.chi_squared = rest.dot(VectorXd(factors.sigma.solve(rest)));
  return result;
}

VectorXd most_probable_factors(const LinearSystem& system, const VectorXd& start) {
  const auto count = static_cast<std::size_t>(start.size());
  if (count == 0) return start;
  Callback callback{&system, nullptr};
  gsl_multimin_function_fdf function{value_of, gradient_of, both_of, count, &callback};
  const std::unique_ptr<gsl_multimin_fdfminimizer, decltype(&gsl_multimin_fdfminimizer_free)> minimiser(
      gsl_multimin_fdfminimizer_alloc(gsl_multimin_fdfminimizer_vector_bfgs2, count),
      &gsl_multimin_fdfminimizer_free);
  const std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)> x(gsl_vector_alloc(count), &gsl_vector_free);
  for (std::size_t i = 0; i < count; ++i) gsl_vector_set(x.get(), i, start[static_cast<Index>(i)]);
  constexpr double first_step = 0.3, line_tolerance = 0.1, settled = 1e-3;
  constexpr int most_steps = 60;
  gsl_multimin_fdfminimizer_set(minimiser.get(), &function, x.get(), first_step, line_tolerance);
  for (int step = 0; step < most_steps; ++step) {
    if (gsl_multimin_fdfminimizer_iterate(minimiser.get()) != GSL_SUCCESS) break;  // no better point exists
    if (gsl_multimin_test_gradient(gsl_multimin_fdfminimizer_gradient(minimiser.get()), settled) ==
        GSL_SUCCESS)
      break;
  }
  const gsl_vector* found = gsl_multimin_fdfminimizer_x(minimiser.get());
  VectorXd best(start.size());
  for (std::size_t i = 0; i < count; ++i) best[static_cast<Index>(i)] = gsl_vector_get(found, i);
  if (callback.failure && !std::isfinite(best.sum())) std::rethrow_exception(callback.failure);
  objective(system, best);  // reports what is wrong with it, if anything is
  return best;
}

}  // namespace whipple::fit
