// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/joint/joint_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

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
    constexpr double half_width_95 = 1.959964;
    ++result.points;
    result.inside_68 += level <= 0.68 ? 1.0 : 0.0;
    result.inside_95 += level <= 0.95 ? 1.0 : 0.0;
    result.rms += std::pow((values[i] - measured) / measured, 2);
    widths.push_back(half_width_95 * std::sqrt(band) / measured);
    form_widths.push_back(half_width_95 * std::sqrt(band + form) / measured);
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

}  // namespace

JointResult fit_jointly(SolidFit& fit, const std::vector<MeasuredCurve>& curves, double density) {
  constexpr int most_passes = 25;
  constexpr double settled = 0.01;      // of the error of a constant
  constexpr double longest_step = 0.2;  // of the logarithm of a constant
  const bool melts = std::ranges::any_of(curves, [](const MeasuredCurve& curve) {
    return curve.fitted && curve.experiment.kind == eos::experiments::ExperimentKind::melting;
  });
  if (melts && !fit.model.fits(Place::melting)) fit.model.free.push_back(Place::melting);
  fit.model.free.push_back(Place::quadratic);

  std::vector<bool> all;
  for (const MeasuredCurve& curve : curves) all.push_back(curve.fitted);
  const auto fitted = std::ranges::count(all, true);
  SolidConstants constants = fit.constants;
  Solution solution;
  std::optional<JointProblem> problem;
  LinearSystem system;
  bool done = false;
  for (int pass = 0; pass < most_passes && !done; ++pass) {
    problem.emplace(fit, constants, curves, density);
    system = problem->system(all);
    solution = solve(system, solution.log_factors);
    VectorXd step = solution.estimate.parameters;
    const VectorXd of_constants = step.head(problem->constants());
    const VectorXd errors = solution.estimate.covariance.diagonal().head(problem->constants()).cwiseSqrt();
    done = of_constants.cwiseQuotient(errors).lpNorm<Eigen::Infinity>() < settled;
    if (done) break;
    step *= std::min(1.0, longest_step / of_constants.lpNorm<Eigen::Infinity>());
    constants = problem->constants_at(step);
  }
  if (!done) throw StateError("the joint fit does not settle");

  const auto count = problem->constants();
  const VectorXd at_rest = VectorXd::Zero(system.jacobian.cols());
  const VectorXd scale = problem->scale(at_rest);
  const auto in_units = [&](const MatrixXd& covariance) {
    return MatrixXd(scale.asDiagonal() * covariance.topLeftCorner(count, count) * scale.asDiagonal());
  };
  fit.constants = constants;
  fit.covariance = in_units(solution.estimate.covariance);
  fit.statistical_covariance = in_units(solution.estimate.statistical_covariance);

  JointResult result;
  for (const Place place : fit.model.free) result.names.emplace_back(name_of(place));
  result.values = values_of(fit.model, constants);
  result.errors = fit.covariance.diagonal().cwiseSqrt();
  result.chi_squared = solution.estimate.chi_squared;
  result.degrees_of_freedom = static_cast<int>(system.residuals.size() - count -
                                               system.jacobian.cols());  // less the rows of the constants
  for (std::size_t i = 0; i < system.components.size(); ++i) {
    result.sizes.push_back(
        {system.components[i].name, std::exp(solution.log_factors[static_cast<Index>(i)])});
  }
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const LinearCurve& linear = problem->curves()[c];
    if (all[c]) result.curves.push_back(curve_result(linear, factors_for(linear, c, system, solution)));
  }

  const VectorXd potential = solution.log_factors.head(static_cast<Index>(problem->potential_components()));
  const auto add_prediction = [&](std::size_t c, const LinearSystem& rest, const Solution& partial) {
    const CurveModel model(material_constants(problem->constants_at(partial.estimate.parameters), density));
    const LinearCurve& linear = problem->curves()[c];
    result.coverage.push_back(predict(linear, model, partial.estimate.covariance.topLeftCorner(count, count),
                                      factors_for(linear, c, rest, partial)));
    result.coverage.back().left_out = all[c];
  };
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (!all[c]) {
      add_prediction(c, system, solution);
    } else if (fitted > 1) {
      std::vector<bool> others = all;
      others[c] = false;
      const LinearSystem rest = problem->system(others);
      add_prediction(c, rest, solve(rest, potential));
    }
  }
  const auto add_without = [&](const std::string& kind, const std::vector<bool>& takes_part) {
    const Solution partial = solve(problem->system(takes_part), potential);
    const VectorXd slope = problem->scale(partial.estimate.parameters);
    const VectorXd errors = partial.estimate.covariance.diagonal().head(count).cwiseSqrt();
    result.without.push_back({kind, values_of(fit.model, problem->constants_at(partial.estimate.parameters)),
                              slope.cwiseProduct(errors)});
  };
  std::set<eos::experiments::ExperimentKind> kinds;
  for (const MeasuredCurve& curve : curves) {
    if (curve.fitted) kinds.insert(curve.experiment.kind);
  }
  for (const auto kind : kinds) {
    if (kinds.size() == 1) break;  // the row of all measurements
    std::vector<bool> others;
    for (const MeasuredCurve& curve : curves) others.push_back(curve.fitted && curve.experiment.kind != kind);
    add_without(kind_name(kind), others);
  }
  add_without("all measurements", std::vector<bool>(curves.size(), false));
  return result;
}

}  // namespace whipple::fit
