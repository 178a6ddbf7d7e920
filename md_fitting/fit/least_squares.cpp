// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/least_squares.hpp"

#include <fmt/format.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <exception>
#include <memory>

#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

struct Callback {
  const LeastSquaresProblem* problem;
  const Cholesky* sigma;
  std::exception_ptr failure;  // no exception may propagate through GSL's C frames
};

int whitened_residuals(const gsl_vector* x, void* data, gsl_vector* f) {
  auto* callback = static_cast<Callback*>(data);
  try {
    Eigen::VectorXd p(static_cast<Eigen::Index>(x->size));
    for (std::size_t i = 0; i < x->size; ++i) p[static_cast<Eigen::Index>(i)] = gsl_vector_get(x, i);
    p += callback->problem->start - Eigen::VectorXd::Ones(p.size());
    const Eigen::VectorXd r = callback->sigma->whitened(callback->problem->residuals(p));
    const bool usable = r.allFinite();  // otherwise worse than any fit: the step is rejected and shortened
    for (std::size_t i = 0; i < f->size; ++i)
      gsl_vector_set(f, i, usable ? r[static_cast<Eigen::Index>(i)] : 1e12);
    return GSL_SUCCESS;
  } catch (...) {
    callback->failure = std::current_exception();
    return GSL_EFAILED;
  }
}

using Workspace = std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)>;

Eigen::MatrixXd to_eigen(const gsl_matrix& m) {
  Eigen::MatrixXd result(static_cast<Eigen::Index>(m.size1), static_cast<Eigen::Index>(m.size2));
  for (std::size_t i = 0; i < m.size1; ++i) {
    for (std::size_t k = 0; k < m.size2; ++k) {
      result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = gsl_matrix_get(&m, i, k);
    }
  }
  return result;
}

/// Checks that the Jacobian determines every parameter: its columns, scaled to unit length, must be independent.
void require_determined(const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd scaled = jacobian;
  for (Eigen::Index k = 0; k < scaled.cols(); ++k) {
    const double norm = scaled.col(k).norm();
    if (!(norm > 0.0)) throw StateError(fmt::format("least squares: no data depend on parameter {}", k));
    scaled.col(k) /= norm;
  }
  const SymmetricEigen eigen = symmetric_eigen(scaled.transpose() * scaled);
  // The normal matrix of central differences is accurate to about 1e-10.
  if (!(eigen.values[0] > 1e-11)) {
    throw StateError("least squares: the data leave a combination of the parameters undetermined");
  }
}

}  // namespace

LeastSquaresSolution solve(const LeastSquaresProblem& problem) {
  const Eigen::Index p = problem.start.size();
  const Eigen::Index n = problem.statistical.rows();
  if (n < p) {
    throw StateError(fmt::format("least squares: {} data for {} parameters", n, p));
  }
  const Cholesky sigma(problem.statistical + problem.model);
  if (!sigma.is_positive()) {
    throw StateError(
        "least squares: the covariance of the data is not positive definite (a datum without error?)");
  }

  Callback callback{&problem, &sigma, nullptr};
  gsl_multifit_nlinear_fdf system{};
  system.f = &whitened_residuals;
  system.n = static_cast<std::size_t>(n);
  system.p = static_cast<std::size_t>(p);
  system.params = &callback;
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  settings.trs = gsl_multifit_nlinear_trs_lm;
  settings.fdtype = GSL_MULTIFIT_NLINEAR_CTRDIFF;
  settings.h_df = 1e-5;
  const Workspace workspace(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, system.n, system.p),
      &gsl_multifit_nlinear_free);

  // GSL's difference step is relative to the parameter: iterate on 1 + (p - start), so that none is near zero.
  Eigen::VectorXd start = Eigen::VectorXd::Ones(p);
  const gsl_vector_view view = gsl_vector_view_array(start.data(), system.p);
  gsl_error_handler_t* handler = gsl_set_error_handler_off();  // errors are returned as codes
  int status = gsl_multifit_nlinear_init(&view.vector, &system, workspace.get());
  int reason = 0;
  constexpr std::size_t most_iterations = 200;
  if (status == GSL_SUCCESS) {
    status = gsl_multifit_nlinear_driver(most_iterations, 1e-12, 1e-12, 0.0, nullptr, nullptr, &reason,
                                         workspace.get());
  }
  gsl_set_error_handler(handler);
  if (callback.failure) std::rethrow_exception(callback.failure);
  // GSL_ENOPROG: no step reduces chi squared any further, the minimum to rounding. If this occurs at the first
  // step, the driver returns GSL_EMAXITER and sets the reason.
  const bool at_minimum = status == GSL_ENOPROG || (status == GSL_EMAXITER && reason == GSL_ENOPROG);
  if (status != GSL_SUCCESS && !at_minimum) {
    throw StateError(fmt::format("least squares: no convergence after {} iterations ({})",
                                 gsl_multifit_nlinear_niter(workspace.get()), gsl_strerror(status)));
  }

  LeastSquaresSolution solution;
  const gsl_vector* x = gsl_multifit_nlinear_position(workspace.get());
  solution.parameters.resize(p);
  for (Eigen::Index i = 0; i < p; ++i) {
    solution.parameters[i] = problem.start[i] + gsl_vector_get(x, static_cast<std::size_t>(i)) - 1.0;
  }
  solution.residuals = problem.residuals(solution.parameters);
  solution.whitened = sigma.whitened(solution.residuals);
  solution.chi_squared = solution.whitened.squaredNorm();
  solution.degrees_of_freedom = static_cast<int>(n - p);
  solution.iterations = static_cast<int>(gsl_multifit_nlinear_niter(workspace.get()));

  const Eigen::MatrixXd jacobian = to_eigen(*gsl_multifit_nlinear_jac(workspace.get()));
  require_determined(jacobian);
  solution.jacobian = jacobian;
  solution.sigma_factor = sigma;
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd inverse = inverse_of_symmetric(normal);
  solution.covariance = 0.5 * (inverse + inverse.transpose());
  const Eigen::MatrixXd half = sigma.whitened(problem.statistical);
  const Eigen::MatrixXd noise = sigma.whitened(half.transpose());
  const Eigen::MatrixXd estimator = inverse * jacobian.transpose();
  solution.statistical_covariance = estimator * noise * estimator.transpose();
  return solution;
}

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  Line line;
  double c00 = 0, c01 = 0, c11 = 0, sum = 0;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &line.intercept, &line.slope, &c00, &c01, &c11, &sum);
  return line;
}

}  // namespace whipple::fit
