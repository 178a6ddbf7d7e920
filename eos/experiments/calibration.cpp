// SPDX-License-Identifier: BSD-3-Clause
#include "eos/experiments/calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::eos::experiments {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return nan;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Returns the rms deviation of points from their least-squares quadratic, with n - 3 degrees of freedom.
double scatter_about_quadratic(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr std::size_t coefficients = 3;
  if (x.size() <= coefficients) {
    throw InputError(fmt::format(
        "{} points are too few to tell their scatter: four, or a column of errors, are needed", x.size()));
  }
  const double size = *std::ranges::max_element(x);
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(x.size()), static_cast<Eigen::Index>(coefficients));
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    const double u = x[static_cast<std::size_t>(i)] / size;
    basis.row(i) << 1.0, u, u * u;
  }
  const Eigen::Map<const Eigen::VectorXd> values(y.data(), static_cast<Eigen::Index>(y.size()));
  const Eigen::VectorXd rest = values - basis * least_squares_solution(basis, values);
  return rest.norm() / std::sqrt(static_cast<double>(x.size() - coefficients));
}

}  // namespace

std::vector<double> measurement_errors(const Experiment& experiment, std::span<const double> slope) {
  std::vector<double> errors;
  if (!experiment.states_errors) {
    if (is_pressure(experiment.kind)) return std::vector<double>(experiment.abscissa.size(), nan);
    errors.assign(experiment.abscissa.size(),
                  scatter_about_quadratic(experiment.abscissa, experiment.ordinate));
    return errors;
  }
  for (std::size_t i = 0; i < experiment.abscissa.size(); ++i) {
    errors.push_back(std::hypot(experiment.ordinate_error[i], slope[i] * experiment.abscissa_error[i]));
  }
  return errors;
}

Calibration calibrate(const EquationOfState& eos, const State& initial,
                      std::span<const std::pair<const EquationOfState*, State>> samples,
                      const Experiment& experiment) {
  if (samples.size() < 2) throw InputError("a scatter needs two samples or more");
  const std::size_t count = experiment.abscissa.size();
  const auto values_of = [&](const EquationOfState& model, const State& start, double factor) {
    std::vector<double> abscissa = experiment.abscissa;
    for (double& x : abscissa) x *= factor;
    return curve(
        model, start, experiment,
        {std::move(abscissa), initial_densities(start.density, experiment), experiment.temperatures});
  };
  Calibration result;
  result.model = values_of(eos, initial, 1.0);
  constexpr double step = 1e-3;
  const std::vector<double> before = values_of(eos, initial, 1.0 - step);
  std::vector<double> slope(count);
  for (std::size_t i = 0; i < count; ++i)
    slope[i] = (result.model[i] - before[i]) / (step * experiment.abscissa[i]);
  result.measurement_error = measurement_errors(experiment, slope);

  std::vector<double> sum(count, 0.0), squares(count, 0.0);
  std::vector<std::size_t> states(count, 0);
  for (const auto& [sample, start] : samples) {
    const std::vector<double> values = values_of(*sample, start, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(values[i])) continue;
      ++states[i];
      const double change = values[i] - sum[i];
      sum[i] += change / static_cast<double>(states[i]);
      squares[i] += change * (values[i] - sum[i]);
    }
  }
  std::vector<double> widths, errors;
  int within_band = 0;
  std::array<int, coverage_levels.size()> within{};
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_band = std::isfinite(result.model[i]) && 2 * states[i] > samples.size();
    const double deviation = has_band ? std::sqrt(squares[i] / static_cast<double>(states[i] - 1)) : nan;
    result.deviation.push_back(deviation);
    const double off = result.model[i] - experiment.ordinate[i];
    const bool counts = has_band && std::isfinite(result.measurement_error[i]);
    result.pull.push_back(counts ? off / std::hypot(deviation, result.measurement_error[i]) : nan);
    if (!has_band) continue;
    ++result.band_points;
    if (experiment.ordinate[i] > 0.0) widths.push_back(half_width_95 * deviation / experiment.ordinate[i]);
    within_band += std::abs(off) <= half_width_95 * deviation ? 1 : 0;
    if (!counts) continue;
    ++result.points;
    if (experiment.ordinate[i] > 0.0) errors.push_back(result.measurement_error[i] / experiment.ordinate[i]);
    const double level = std::erf(std::abs(result.pull[i]) / std::numbers::sqrt2);
    for (std::size_t k = 0; k < coverage_levels.size(); ++k) within[k] += level <= coverage_levels[k] ? 1 : 0;
  }
  for (std::size_t k = 0; k < within.size(); ++k)
    result.coverage[k] = static_cast<double>(within[k]) / result.points;
  result.coverage_of_band = static_cast<double>(within_band) / result.band_points;
  result.median_half_width = median(widths);
  result.median_error = median(errors);
  return result;
}

}  // namespace whipple::eos::experiments
