// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/vapour_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "eos/models/gray_free_energy.hpp"
#include "md_fitting/fit/bounds.hpp"
#include "md_fitting/fit/least_squares.hpp"
#include "md_fitting/fit/table_access.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using eos::GrayConstants;

// Below the range the join is within the melting band; above it, the form of gamma gives an unphysical fluid
// (docs/theory/gray.md, section 8).
constexpr Bounds join_bounds = {.lower = 1.05, .upper = 1.45};
constexpr double beside_the_bounds = 0.01;

/// Returns the logarithms of the saturated densities, melt and vapour alternating; NaN from the first temperature at
/// which the model has none.
VectorXd log_densities(const GrayConstants& constants, const std::vector<SaturationState>& data) {
  VectorXd values =
      VectorXd::Constant(2 * static_cast<Index>(data.size()), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < data.size(); ++i) {
    try {
      const auto [liquid, vapour] = saturated_densities(constants, data[i].temperature);
      values[2 * static_cast<Index>(i)] = std::log(liquid);
      values[2 * static_cast<Index>(i) + 1] = std::log(vapour);
    } catch (const StateError&) {
      break;
    } catch (const InputError&) {
      break;
    }
  }
  return values;
}

class VapourProblem {
 public:
  VapourProblem(GrayConstants constants, const std::vector<SaturationState>& data, const ModelErrors& errors,
                bool with_join)
      : constants_(constants), data_(data), errors_(errors), attraction_(1.0, {.lower = 0.0}) {
    constants_.vapour = eos::VapourCondition::attraction;
    attraction_ = {best_start(), {.lower = 0.0}};
    if (with_join) join_.emplace_back(constants_.join_volume_ratio, join_bounds);
  }

  [[nodiscard]] Index parameters() const { return 1 + static_cast<Index>(join_.size()); }
  [[nodiscard]] GrayConstants constants_at(const VectorXd& p) const {
    GrayConstants trial = constants_;
    trial.vapour_attraction = attraction_.value(p[0]);
    if (!join_.empty()) trial.join_volume_ratio = join_.front().value(p[1]);
    return trial;
  }
  [[nodiscard]] VectorXd slopes(const VectorXd& p) const {
    VectorXd s(parameters());
    s[0] = attraction_.slope(p[0]);
    if (!join_.empty()) s[1] = join_.front().slope(p[1]);
    return s;
  }
  [[nodiscard]] VectorXd residuals(const GrayConstants& constants) const {
    VectorXd r = -log_densities(constants, data_);
    for (std::size_t i = 0; i < data_.size(); ++i) {
      r[2 * static_cast<Index>(i)] += std::log(data_[i].liquid_density.value);
      r[2 * static_cast<Index>(i) + 1] += std::log(data_[i].vapour_density.value);
    }
    return r;
  }
  [[nodiscard]] LeastSquaresProblem least_squares() const {
    LeastSquaresProblem problem;
    problem.residuals = [this](const VectorXd& p) { return residuals(constants_at(p)); };
    problem.start = VectorXd::Zero(parameters());
    problem.statistical = noise().asDiagonal();
    problem.model = misfit().asDiagonal();
    return problem;
  }

 private:
  [[nodiscard]] VectorXd noise() const {
    VectorXd variance(2 * static_cast<Index>(data_.size()));
    for (std::size_t i = 0; i < data_.size(); ++i) {
      const SaturationState& state = data_[i];
      variance[2 * static_cast<Index>(i)] =
          std::pow(state.liquid_density.error / state.liquid_density.value, 2);
      variance[2 * static_cast<Index>(i) + 1] =
          std::pow(state.vapour_density.error / state.vapour_density.value, 2);
    }
    return variance;
  }
  [[nodiscard]] VectorXd misfit() const {
    VectorXd variance(2 * static_cast<Index>(data_.size()));
    for (Index i = 0; i < variance.size(); i += 2) {
      variance[i] = std::pow(errors_.liquid_density, 2);
      variance[i + 1] = std::pow(errors_.vapour_density, 2);
    }
    return variance;
  }
  /// Returns the attraction of minimum chi^2 among a few: far from it the isotherms of the data have no loop.
  [[nodiscard]] double best_start() {
    // Young-Alder fluid with a critical temperature somewhat above the data (docs/theory/gray.md, G30).
    const double covolume = constants_.covolume_ratio * constants_.reference_specific_volume;
    const double rule =
        GrayConstants::gas_constant / constants_.molar_mass * covolume * data_.back().temperature / 0.0943287;
    const VectorXd weight = (noise() + misfit()).cwiseInverse();
    double best = 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (double factor = 0.6; factor < 3.0; factor *= 1.08) {
      constants_.vapour_attraction = factor * rule;
      const double chi_squared = residuals(constants_).cwiseAbs2().dot(weight);
      if (chi_squared < least) least = chi_squared, best = factor * rule;
    }
    if (!std::isfinite(least)) {
      throw StateError(
          fmt::format("no attraction gives the model liquid and vapour in equilibrium at {:.0f} K",
                      data_.back().temperature));
    }
    return best;
  }

  GrayConstants constants_;
  const std::vector<SaturationState>& data_;
  ModelErrors errors_;
  BoundedParameter attraction_;
  std::vector<BoundedParameter> join_;  ///< one, or none
};

/// Returns d(residual)/d(constant) for the constants fitted before, by central differences over a tenth of their
/// errors.
MatrixXd slopes_by(const VapourProblem& problem, const GrayConstants& constants, const FittedBefore& before) {
  MatrixXd slopes;
  for (std::size_t k = 0; k < before.names.size(); ++k) {
    const auto column = static_cast<Index>(k);
    const double step = 0.1 * std::sqrt(before.covariance(column, column));
    const auto moved = [&](double by) {
      GrayConstants trial = constants;
      number_of(trial, before.names[k]) += by;
      return problem.residuals(trial);
    };
    const VectorXd slope = (moved(step) - moved(-step)) / (2.0 * step);
    if (k == 0) slopes.resize(slope.size(), static_cast<Index>(before.names.size()));
    slopes.col(column) = slope;
  }
  return slopes;
}

VapourFit solve_vapour(const GrayConstants& constants, const std::vector<SaturationState>& data,
                       const ModelErrors& errors, bool inflation, const FittedBefore& before,
                       bool with_join) {
  const VapourProblem problem(constants, data, errors, with_join);
  const LeastSquaresProblem weights = problem.least_squares();
  const LeastSquaresSolution solution = solve(weights);
  const GrayConstants fitted = problem.constants_at(solution.parameters);
  const VectorXd scale = problem.slopes(solution.parameters);
  VapourFit fit;
  fit.names = {"vapour_attraction"};
  fit.values = VectorXd::Constant(problem.parameters(), fitted.vapour_attraction);
  if (with_join) {
    fit.names.emplace_back("join_volume_ratio");
    fit.values[1] = fitted.join_volume_ratio;
  }
  // dq/dp = -(J^T W J)^-1 J^T W dr/dp: sensitivity to the constants p of the solid.
  const MatrixXd gain = scale.asDiagonal() * solution.covariance * solution.jacobian.transpose();
  const MatrixXd moved = slopes_by(problem, fitted, before);
  if (!moved.allFinite())
    throw StateError("the saturated densities do not depend smoothly on the solid's constants");
  fit.sensitivity = -gain * solution.sigma_factor.whitened(moved);
  const auto total = [&](const MatrixXd& own, const MatrixXd& solid) -> MatrixXd {
    return scale.asDiagonal() * own * scale.asDiagonal() +
           fit.sensitivity * solid * fit.sensitivity.transpose();
  };
  const double freedom = solution.degrees_of_freedom;
  if (inflation && freedom > 0.0) fit.inflation = std::sqrt(std::max(1.0, solution.chi_squared / freedom));
  fit.covariance = total(fit.inflation * fit.inflation * solution.covariance, before.covariance);
  fit.statistical_covariance = total(solution.statistical_covariance, before.statistical_covariance);
  fit.chi_squared = solution.chi_squared;
  fit.degrees_of_freedom = solution.degrees_of_freedom;
  return fit;
}

}  // namespace

std::pair<double, double> saturated_densities(const GrayConstants& constants, double temperature) {
  const eos::GrayFreeEnergy surface(constants);
  const eos::VapourDome::Search search = surface.dome_search();
  const eos::LoopPoint loop = eos::steepest_point(search, temperature);
  if (!(loop.steepness > 0.0)) throw StateError("above the critical temperature of the model");
  const eos::Saturation state = eos::saturation(search, temperature, loop.volume);
  return {1.0 / state.liquid_volume, 1.0 / state.vapour_volume};
}

VapourFit fit_vapour(const GrayConstants& constants, const std::vector<SaturationState>& data,
                     const ModelErrors& errors, bool inflation, const FittedBefore& before) {
  constexpr double width = join_bounds.upper - join_bounds.lower;
  const double unknown = width / std::sqrt(12.0);  // standard deviation of a uniform distribution
  std::string remark;
  try {
    VapourFit fit = solve_vapour(constants, data, errors, inflation, before, true);
    const double join = fit.values[1];
    const double error = std::sqrt(fit.covariance(1, 1));
    const double margin = beside_the_bounds * width;
    const bool inside = join > join_bounds.lower + margin && join < join_bounds.upper - margin;
    if (inside && error < unknown) return fit;
    remark =
        inside ? fmt::format("the saturated densities leave V_J/V0 = {:.2f} uncertain by {:.2f}", join, error)
               : fmt::format("the saturated densities drive V_J/V0 to the bound {:.2f}", join);
  } catch (const StateError& error) {
    remark = error.what();
  }
  VapourFit fit = solve_vapour(constants, data, errors, inflation, before, false);
  fit.remark = fmt::format("V_J/V0 stays at {:.4g}: {}", constants.join_volume_ratio, remark);
  return fit;
}

}  // namespace whipple::fit
