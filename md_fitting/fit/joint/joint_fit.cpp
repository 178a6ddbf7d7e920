// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/joint/joint_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "eos/experiments/calibration.hpp"
#include "md_fitting/fit/joint/joint_problem.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Holds the solution of one selection of the data.
struct Solution {
  VectorXd log_factors;
  LinearEstimate estimate;
};

Solution solve(const LinearSystem& system, VectorXd start) {
  start.conservativeResizeLike(VectorXd::Zero(static_cast<Index>(system.components.size())));
  Solution solution;
  solution.log_factors = most_probable_factors(system, start);
  solution.estimate = estimate(system, solution.log_factors);
  return solution;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Holds the factors of the deviations of one curve.
struct Factors {
  double form = 1.0, table = 1.0;
};

/// Returns the factors found for the kind of a curve and its table; as stated if they took no part.
/// @param number  of the curve
Factors factors_for(const LinearCurve& linear, std::size_t number, const LinearSystem& system,
                    const Solution& solution) {
  const auto kind = static_cast<std::size_t>(linear.curve->experiment.kind);
  Factors factors;
  for (std::size_t i = 0; i < system.components.size(); ++i) {
    const VarianceComponent& component = system.components[i];
    const double factor = std::exp(solution.log_factors[static_cast<Index>(i)]);
    if (component.deviation == Deviation::form && component.of == kind) factors.form = factor;
    if (component.deviation == Deviation::table && component.of == number) factors.table = factor;
  }
  return factors;
}

/// Compares the material with a measured curve.
CurveResult curve_result(const LinearCurve& linear, const Factors& factors) {
  const MeasuredCurve& curve = *linear.curve;
  CurveResult result{curve.experiment.name, kind_name(curve.experiment.kind)};
  result.points = static_cast<int>(linear.used.size());
  result.out_of_range = static_cast<int>(curve.points()) - result.points;
  for (Index row = 0; row < linear.residuals.size(); ++row) {
    const std::size_t i = linear.used[static_cast<std::size_t>(row)];
    const double deviation = -linear.residuals[row] / curve.experiment.ordinate[i];
    const double variance =
        curve.error[i] * curve.error[i] + linear.deviation_variance(row, factors.form, factors.table);
    result.rms += deviation * deviation;
    result.mean += deviation;
    result.rms_of_errors += linear.residuals[row] * linear.residuals[row] / variance;
  }
  if (result.points == 0) return result;
  result.rms = std::sqrt(result.rms / result.points);
  result.mean /= result.points;
  result.rms_of_errors = std::sqrt(result.rms_of_errors / result.points);
  return result;
}

/// Predicts a curve by constants fitted without it.
/// @param covariance  of the parameters of the constants
CurveCoverage predict(const LinearCurve& linear, const CurveModel& model, const MatrixXd& covariance,
                      const Factors& factors) {
  const MeasuredCurve& curve = *linear.curve;
  CurveCoverage result{curve.experiment.name, kind_name(curve.experiment.kind)};
  const std::vector<double> values = model.values(curve.experiment);
  std::vector<double> widths, form_widths;
  for (Index row = 0; row < linear.residuals.size(); ++row) {
    const std::size_t i = linear.used[static_cast<std::size_t>(row)];
    if (!std::isfinite(values[i])) continue;
    const double measured = curve.experiment.ordinate[i];
    const double band =
        (linear.jacobian.row(row) * covariance * linear.jacobian.row(row).transpose()).value();
    const double form = linear.deviation_variance(row, factors.form, 0.0);
    const double table = linear.deviation_variance(row, 0.0, factors.table);
    const double pull =
        std::abs(values[i] - measured) / std::sqrt(band + form + table + curve.error[i] * curve.error[i]);
    const double level = std::erf(pull / std::numbers::sqrt2);
    ++result.points;
    result.inside_68 += level <= 0.68 ? 1.0 : 0.0;
    result.inside_95 += level <= 0.95 ? 1.0 : 0.0;
    result.rms += std::pow((values[i] - measured) / measured, 2);
    widths.push_back(eos::experiments::half_width_95 * std::sqrt(band) / measured);
    form_widths.push_back(eos::experiments::half_width_95 * std::sqrt(band + form) / measured);
  }
  if (result.points == 0) return result;
  result.inside_68 /= result.points;
  result.inside_95 /= result.points;
  result.rms = std::sqrt(result.rms / result.points);
  result.half_width = median(widths);
  result.form_width = median(form_widths);
  return result;
}

VectorXd values_of(const SolidModel& model, const SolidConstants& constants) {
  VectorXd values(static_cast<Index>(model.free.size()));
  for (std::size_t k = 0; k < model.free.size(); ++k)
    values[static_cast<Index>(k)] = at(constants, model.free[k]);
  return values;
}

/// Holds a fit at its constants: the linearised problem, the system of the curves that take part, its solution.
struct Settled {
  SolidConstants constants;
  std::optional<JointProblem> problem;
  LinearSystem system;
  Solution solution;

  /// Returns ln f of the deviations of the potential, where fits of fewer curves begin.
  [[nodiscard]] VectorXd potential() const {
    return solution.log_factors.head(static_cast<Index>(problem->potential_components()));
  }
};

/// Linearises and solves until the constants change by a small part of their errors.
/// @throws StateError if they do not settle
Settled settle(const SolidFit& fit, const std::vector<MeasuredCurve>& curves, double density,
               const std::vector<bool>& takes_part) {
  constexpr int most_passes = 25;
  constexpr double settled = 0.01;      // of the error of a constant
  constexpr double longest_step = 0.2;  // of the logarithm of a constant
  Settled at{fit.constants, {}, {}, {}};
  for (int pass = 0; pass < most_passes; ++pass) {
    at.problem.emplace(fit, at.constants, curves, density);
    at.system = at.problem->system(takes_part);
    at.solution = solve(at.system, at.solution.log_factors);
    const Index count = at.problem->constants();
    VectorXd step = at.solution.estimate.parameters;
    const VectorXd errors = at.solution.estimate.covariance.diagonal().head(count).cwiseSqrt();
    if (step.head(count).cwiseQuotient(errors).lpNorm<Eigen::Infinity>() < settled) return at;
    step *= std::min(1.0, longest_step / step.head(count).lpNorm<Eigen::Infinity>());
    at.constants = at.problem->constants_at(step);
  }
  throw StateError("the joint fit does not settle");
}

/// Predicts each fitted curve by a fit without it, and the others by the fit itself.
void add_predictions(const Settled& at, const std::vector<bool>& fitted, double density,
                     JointResult& result) {
  const Index count = at.problem->constants();
  const auto prediction = [&](std::size_t c, const LinearSystem& system, const Solution& solution) {
    const LinearCurve& linear = at.problem->curves()[c];
    const MatrixXd covariance = solution.estimate.covariance.topLeftCorner(count, count);
    try {
      const CurveModel model(
          material_constants(at.problem->constants_at(solution.estimate.parameters), density));
      return predict(linear, model, covariance, factors_for(linear, c, system, solution));
    } catch (const InputError&) {  // the rest of the data leaves constants that make no material
      return CurveCoverage{.name = linear.curve->experiment.name,
                           .kind = kind_name(linear.curve->experiment.kind)};
    }
  };
  const auto number = std::ranges::count(fitted, true);
  for (std::size_t c = 0; c < fitted.size(); ++c) {
    if (fitted[c] && number == 1) continue;
    if (fitted[c]) {
      std::vector<bool> others = fitted;
      others[c] = false;
      const LinearSystem rest = at.problem->system(others);
      result.coverage.push_back(prediction(c, rest, solve(rest, at.potential())));
    } else {
      result.coverage.push_back(prediction(c, at.system, at.solution));
    }
    result.coverage.back().left_out = fitted[c];
  }
}

/// Lists the constants without each kind of curve, and without any.
void add_without(const Settled& at, const std::vector<MeasuredCurve>& curves, const SolidModel& model,
                 JointResult& result) {
  const auto add = [&](const std::string& kind, const std::vector<bool>& takes_part) {
    const Solution partial = solve(at.problem->system(takes_part), at.potential());
    const VectorXd& parameters = partial.estimate.parameters;
    const VectorXd errors = partial.estimate.covariance.diagonal().head(at.problem->constants()).cwiseSqrt();
    result.without.push_back({kind, values_of(model, at.problem->constants_at(parameters)),
                              at.problem->scale(parameters).cwiseProduct(errors)});
  };
  std::set<eos::experiments::ExperimentKind> kinds;
  for (const MeasuredCurve& curve : curves) {
    if (curve.fitted) kinds.insert(curve.experiment.kind);
  }
  for (const auto kind : kinds) {
    if (kinds.size() == 1) break;  // the row of all measurements
    std::vector<bool> others;
    for (const MeasuredCurve& curve : curves) others.push_back(curve.fitted && curve.experiment.kind != kind);
    add(kind_name(kind), others);
  }
  add("all measurements", std::vector<bool>(curves.size(), false));
}

}  // namespace

JointResult fit_jointly(SolidFit& fit, const std::vector<MeasuredCurve>& curves, double density) {
  const bool melts = std::ranges::any_of(curves, [](const MeasuredCurve& curve) {
    return curve.fitted && curve.experiment.kind == eos::experiments::ExperimentKind::melting;
  });
  if (melts && !fit.model.fits(Place::melting)) fit.model.free.push_back(Place::melting);
  fit.model.free.push_back(Place::quadratic);
  std::vector<bool> fitted;
  for (const MeasuredCurve& curve : curves) fitted.push_back(curve.fitted);

  const Settled at = settle(fit, curves, density, fitted);
  const Index count = at.problem->constants();
  const VectorXd scale = at.problem->scale(VectorXd::Zero(at.system.jacobian.cols()));
  const auto in_units = [&](const MatrixXd& covariance) {
    return MatrixXd(scale.asDiagonal() * covariance.topLeftCorner(count, count) * scale.asDiagonal());
  };
  fit.constants = at.constants;
  fit.covariance = in_units(at.solution.estimate.covariance);
  fit.statistical_covariance = in_units(at.solution.estimate.statistical_covariance);

  JointResult result;
  for (const Place place : fit.model.free) result.names.emplace_back(name_of(place));
  result.values = values_of(fit.model, at.constants);
  result.errors = fit.covariance.diagonal().cwiseSqrt();
  result.chi_squared = at.solution.estimate.chi_squared;
  const Index data = at.system.residuals.size() - count;  // less the rows of the constants
  result.degrees_of_freedom = static_cast<int>(data - at.system.jacobian.cols());
  for (std::size_t i = 0; i < at.system.components.size(); ++i) {
    result.sizes.push_back(
        {at.system.components[i].name, std::exp(at.solution.log_factors[static_cast<Index>(i)])});
  }
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const LinearCurve& linear = at.problem->curves()[c];
    if (fitted[c])
      result.curves.push_back(curve_result(linear, factors_for(linear, c, at.system, at.solution)));
  }
  add_predictions(at, fitted, density, result);
  add_without(at, curves, fit.model, result);
  return result;
}

}  // namespace whipple::fit
