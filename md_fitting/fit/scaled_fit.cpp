// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/scaled_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t least_states_of_window = 3;

/// Performs one iteration of the variance components: f^2 chi^2/r, at least 1. A kind without a model error is not
/// scaled.
ModelScale next_scale(const SolidProblem& problem, const LeastSquaresProblem& weights,
                      const LeastSquaresSolution& solution, const ModelScale& scale) {
  constexpr double least_redundancy = 0.5;
  std::array<double, data_kinds> chi_squared{}, redundancy{}, model{};
  for (const Datum& datum : problem.data()) {
    const auto kind = static_cast<std::size_t>(datum.kind);
    const MatrixXd rows = solution.jacobian.middleRows(datum.begin, datum.rows);
    chi_squared[kind] += solution.whitened.segment(datum.begin, datum.rows).squaredNorm();
    model[kind] += weights.model.diagonal().segment(datum.begin, datum.rows).sum();
    redundancy[kind] +=
        static_cast<double>(datum.rows) - (rows * solution.covariance * rows.transpose()).trace();
  }
  ModelScale next = scale;
  for (std::size_t k = 0; k < data_kinds; ++k) {
    if (redundancy[k] < least_redundancy || model[k] == 0.0) continue;
    next.factor[k] = std::max(1.0, scale.factor[k] * std::sqrt(chi_squared[k] / redundancy[k]));
  }
  return next;
}

double largest_change(const ModelScale& a, const ModelScale& b) {
  double change = 0.0;
  for (std::size_t k = 0; k < data_kinds; ++k)
    change = std::max(change, std::abs(b.factor[k] / a.factor[k] - 1.0));
  return change;
}

}  // namespace

SolidConstants converged(const Observations& data, const SolidModel& model, const FitSettings& settings,
                         SolidConstants constants, const ModelScale& scale) {
  constexpr int most_passes = 30;
  constexpr double settled_of_errors = 3e-3;
  double former_change = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes; ++pass) {
    const SolidProblem problem(data, settings, model, constants, scale);
    const LeastSquaresSolution solution = solve(problem.least_squares());
    const VectorXd& step = solution.parameters;
    constants = problem.constants_at(step);
    const double change = step.head(problem.constants()).lpNorm<Eigen::Infinity>();
    // Precise data make the problem badly conditioned, and its solution scatters by about 1e-6, which further
    // passes do not reduce.
    const bool at_its_noise = change < 1e-5 && change > 0.5 * former_change;
    if (change < 1e-7 || at_its_noise || !model.fits(Place::melting)) return constants;
    // Correlated model errors are worse conditioned: a small fraction of the errors of the constants is accepted.
    const VectorXd errors = solution.covariance.diagonal().head(problem.constants()).cwiseSqrt();
    const double of_errors = step.head(problem.constants()).cwiseQuotient(errors).lpNorm<Eigen::Infinity>();
    if (settings.structure == ErrorStructure::correlated && of_errors < settled_of_errors) return constants;
    former_change = change;
  }
  throw StateError("the fit of the melting temperature does not settle");
}

MatrixXd constants_covariance(const SolidProblem& problem, const LeastSquaresSolution& solution,
                              const MatrixXd& covariance) {
  const Index count = problem.constants();
  const VectorXd scale = problem.scale(solution.parameters);
  return scale.asDiagonal() * covariance.topLeftCorner(count, count) * scale.asDiagonal();
}

ScaledFit fit_scaled(const Observations& data, const SolidModel& model, const FitSettings& settings,
                     const SolidConstants& start) {
  constexpr int most_passes = 100;
  constexpr double settled = 1e-3;
  ScaledFit fit{start, {}, {}, {}};
  for (int pass = 0; pass < most_passes; ++pass) {
    fit.constants = converged(data, model, settings, fit.constants, fit.scale);
    const SolidProblem problem(data, settings, model, fit.constants, fit.scale);
    const LeastSquaresProblem weights = problem.least_squares();
    const LeastSquaresSolution solution = solve(weights);
    const ModelScale next =
        settings.inflation ? next_scale(problem, weights, solution, fit.scale) : fit.scale;
    if (largest_change(fit.scale, next) < settled) {
      fit.constants = problem.constants_at(solution.parameters);
      fit.covariance = constants_covariance(problem, solution, solution.covariance);
      fit.statistical_covariance = constants_covariance(problem, solution, solution.statistical_covariance);
      return fit;
    }
    fit.scale = next;
  }
  throw StateError("the amplitudes of the model errors do not settle");
}

WindowFits fit_windows(const Observations& data, const SolidModel& model, const FitSettings& settings,
                       const SolidConstants& start) {
  constexpr std::array<std::pair<double, double>, 6> others = {
      {{0.0, 1000.0}, {0.0, 1500.0}, {0.0, 2000.0}, {0.0, 3000.0}, {300.0, 1500.0}, {1000.0, 3000.0}}};
  const bool averaged = settings.windows == WindowChoice::averaged;
  WindowFits windows;
  std::vector<std::pair<double, double>> taken;  // first and last particle velocity
  std::string too_few;                           // of the first window without enough states
  const auto add = [&](const FitSettings& window) {
    const std::vector<HugoniotState> states = SolidProblem(data, window, model, start).window();
    if (states.size() < least_states_of_window) {
      if (too_few.empty()) {
        too_few = fmt::format("{} states of particle velocities from {:.6g} to {:.6g} m/s, {} are needed",
                              states.size(), window.least_particle_velocity, window.most_particle_velocity,
                              least_states_of_window);
      }
      return;
    }
    const std::pair ends(states.front().particle_velocity, states.back().particle_velocity);
    if (std::ranges::find(taken, ends) != taken.end()) return;
    taken.push_back(ends);
    const double least = window.least_particle_velocity, most = window.most_particle_velocity;
    const int count = static_cast<int>(states.size());
    const SolidConstants& near = windows.settled.empty() ? start : windows.settled.front().fit.constants;
    try {
      windows.settled.push_back({least, most, count, 0.0, fit_scaled(data, model, window, near)});
    } catch (const StateError& error) {
      windows.left_out.push_back({least, most, count, error.what()});
    }
  };
  const auto fault = [&] { return windows.left_out.empty() ? too_few : windows.left_out.front().reason; };
  add(settings);
  if (!averaged && windows.settled.empty()) throw StateError(fault());
  for (const auto& [least, most] : others) {
    FitSettings window = settings;
    window.least_particle_velocity = least;
    window.most_particle_velocity = most;
    add(window);
  }
  if (taken.empty()) throw StateError(too_few);
  if (windows.settled.empty()) {
    throw StateError(fmt::format("the fit settles in none of {} windows of particle velocities: {}",
                                 taken.size(), fault()));
  }
  for (WindowFit& window : windows.settled)
    window.weight = averaged ? 1.0 / static_cast<double>(windows.settled.size()) : 0.0;
  if (!averaged) windows.settled.front().weight = 1.0;
  return windows;
}

ScaledFit mean_of(const std::vector<WindowFit>& windows, const SolidModel& model) {
  ScaledFit mean = windows.front().fit;
  const auto count = static_cast<Index>(model.free.size());
  const auto values = [&](const WindowFit& window) {
    VectorXd p(count);
    for (Index k = 0; k < count; ++k)
      p[k] = at(window.fit.constants, model.free[static_cast<std::size_t>(k)]);
    return p;
  };
  VectorXd centre = VectorXd::Zero(count);
  for (const WindowFit& window : windows) centre += window.weight * values(window);
  mean.covariance = mean.statistical_covariance = MatrixXd::Zero(count, count);
  for (const WindowFit& window : windows) {
    const VectorXd off = values(window) - centre;
    mean.covariance += window.weight * (window.fit.covariance + off * off.transpose());
    mean.statistical_covariance += window.weight * window.fit.statistical_covariance;
  }
  for (Index k = 0; k < count; ++k) at(mean.constants, model.free[static_cast<std::size_t>(k)]) = centre[k];
  return mean;
}

}  // namespace whipple::fit
