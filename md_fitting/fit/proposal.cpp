// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/proposal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "md_fitting/fit/candidates.hpp"
#include "md_fitting/fit/constant_list.hpp"
#include "md_fitting/fit/design.hpp"
#include "md_fitting/fit/expected_data.hpp"
#include "md_fitting/fit/gray_fit.hpp"
#include "md_fitting/fit/outcomes.hpp"
#include "md_fitting/fit/solid_problem.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Prior standard deviation of a parameter without data: 100 GPa and 1 MJ/kg for the intercepts of an isochore,
/// e^100 for a constant.
constexpr double weak = 100.0;
/// Minimum relative reduction of the variance for which a point is worth its cost.
constexpr double least_gain = 1e-3;

/// Returns the Jacobian by central differences, as in `solve`.
MatrixXd jacobian_of(const LeastSquaresProblem& problem, Index rows) {
  constexpr double step = 1e-5;
  MatrixXd jacobian(rows, problem.start.size());
  VectorXd p = problem.start;
  for (Index k = 0; k < p.size(); ++k) {
    p[k] = step;
    const VectorXd above = problem.residuals(p);
    p[k] = -step;
    jacobian.col(k) = (above - problem.residuals(p)) / (2.0 * step);
    p[k] = 0.0;
  }
  return jacobian;
}

std::string point_text(const PlannedPoint& point) {
  if (point.protocol == md::PointKind::hugoniot)
    return fmt::format("hugoniot at V/Vs = {:.4g}", point.volume_ratio);
  if (point.protocol == md::PointKind::isochore) {
    return fmt::format("isochore V/Vs = {:.4g} at {:.0f} K", point.volume_ratio, point.temperature);
  }
  if (point.protocol == md::PointKind::coexistence) {
    return fmt::format("coexistence at {:.3g} GPa", 1e-9 * point.pressure);
  }
  return fmt::format("zero_pressure_volume at {:.0f} K", point.temperature);
}

void propose_points(Proposal& proposal, const Ranges& ranges, const std::vector<PlannedPoint>& points) {
  proposal.next = ranges.plan_of(points);
  for (const PlannedPoint& point : points) {
    proposal.lines.push_back(fmt::format("  {} ({:.3g} atom-steps)", point_text(point), ranges.cost(point)));
  }
}

/// Returns whether the database supports a fit, including melting if the plan has it.
bool bears_fit(const md::Plan& plan, std::span<const md::PointRecord> points, const FitSettings& settings,
               const std::string& store_name) {
  const bool melting = std::any_of(points.begin(), points.end(), [](const auto& point) {
    return point.kind() == md::PointKind::coexistence;
  });
  if (!plan.coexistences.empty() && !melting) return false;
  try {
    observe(points, settings, {}, store_name);
    return true;
  } catch (const InputError&) {
    return false;  // the fit reports missing data if the start does not supply them
  }
}

/// Holds the current fit and the linear model of all candidates.
class Planner {
 public:
  Planner(const md::AdaptivePlan& wish, const FitSettings& settings, const Ranges& ranges,
          std::span<const md::PointRecord> points, const std::string& store_name)
      : fit_(fit_gray(points, settings, store_name)),
        candidates_(ranges.candidates(isochore_volumes(fit_))),
        expected_(fit_, points, ranges, candidates_),
        problem_(expected_.data(), settings, fit_.solid.model, fit_.solid.constants),
        rows_(expected_.rows(problem_)),
        outcome_(outcome_of(fit_.gray, wish)),
        design_(design(problem_, rows_.present)),
        gradient_(VectorXd::Zero(design_.covariance().rows())) {
    std::vector<std::string> names;
    for (const Place place : fit_.solid.model.free) names.emplace_back(name_of(place));
    const MatrixXd& covariance = fit_.solid.covariance;
    const VectorXd slopes = outcome_gradient(fit_.gray, wish, names, covariance.diagonal().cwiseSqrt());
    standing_.value = outcome_.value;
    standing_.error = std::sqrt(slopes.dot(covariance * slopes));
    standing_.noise = std::sqrt(slopes.dot(fit_.solid.statistical_covariance * slopes));
    const VectorXd scale = problem_.scale(VectorXd::Zero(gradient_.size()));
    gradient_.head(slopes.size()) = scale.cwiseProduct(slopes);
  }

  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] Proposal::Standing standing() const {
    Proposal::Standing now = standing_;
    now.expected_error = std::sqrt(design_.variance(gradient_));
    return now;
  }

  /// Holds candidates taken one after the other until the error is below `target`, the budget is exhausted, or no
  /// candidate is worth its cost.
  struct Path {
    std::vector<std::size_t> steps;
    double cost = 0.0;
    double error = 0.0;     ///< expected at the end
    bool too_dear = false;  ///< a worthwhile candidate exceeds the remaining budget
  };

  /// Returns the better of two greedy paths: each step takes the largest reduction of the variance, either in absolute
  /// terms or per cost. Either can be misled by costs that differ a hundredfold; the better of the two is within a
  /// bounded factor of the optimum (Krause, Guestrin, CMU CALD-05-103 (2005); Leskovec et al., Proc. KDD 2007, 420).
  [[nodiscard]] Path best_path(double purse, double target) const {
    const Path by_gain = path(purse, target, false);
    const Path by_price = path(purse, target, true);
    const bool gain_arrives = by_gain.error <= target;
    const bool price_arrives = by_price.error <= target;
    if (gain_arrives != price_arrives) return gain_arrives ? by_gain : by_price;
    if (gain_arrives) return by_gain.cost < by_price.cost ? by_gain : by_price;
    return by_gain.error < by_price.error ? by_gain : by_price;
  }

  [[nodiscard]] const Candidate& candidate(std::size_t index) const { return candidates_[index]; }
  /// Adds the data of a candidate to the present rows.
  void take(std::size_t index) { design_.add(rows_.candidates[index]); }

 private:
  static std::vector<double> isochore_volumes(const GrayFit& fit) {
    std::vector<double> volumes;
    for (const Isochore& isochore : fit.solid.data.isochores) volumes.push_back(isochore.volume);
    return volumes;
  }
  [[nodiscard]] Path path(double purse, double target, bool for_its_cost) const {
    Path path;
    Design design = design_;
    std::vector<bool> taken(candidates_.size(), false);
    for (;;) {
      const double variance = design.variance(gradient_);
      path.error = std::sqrt(variance);
      if (path.error <= target) return path;
      std::size_t best = candidates_.size();
      double most = 0.0;
      bool too_dear = false;
      for (std::size_t c = 0; c < candidates_.size(); ++c) {
        if (taken[c] || rows_.candidates[c].empty()) continue;
        const double gain = design.reduction(rows_.candidates[c], gradient_);
        if (gain < least_gain * variance) continue;
        const double worth = for_its_cost ? gain / candidates_[c].cost : gain;
        if (path.cost + candidates_[c].cost > purse) {
          too_dear = true;
        } else if (worth > most) {
          most = worth;
          best = c;
        }
      }
      path.too_dear = too_dear;
      if (best == candidates_.size()) return path;
      design.add(rows_.candidates[best]);
      taken[best] = true;
      path.steps.push_back(best);
      path.cost += candidates_[best].cost;
    }
  }
  static Design design(const SolidProblem& problem, const std::vector<Index>& present) {
    const LeastSquaresProblem squares = problem.least_squares();
    return {jacobian_of(squares, problem.size()), squares.statistical + squares.model,
            VectorXd::Constant(squares.start.size(), weak), present};
  }

  GrayFit fit_;
  std::vector<Candidate> candidates_;
  ExpectedData expected_;
  SolidProblem problem_;
  ExpectedData::Rows rows_;
  Outcome outcome_;
  Design design_;
  VectorXd gradient_;  // of the outcome with respect to the parameters
  Proposal::Standing standing_;
};

}  // namespace

Proposal propose(const md::Plan& plan, std::span<const md::PointRecord> points, int count,
                 const std::string& store_name) {
  const md::AdaptivePlan& wish = plan.adaptive.value();
  const Ranges ranges(plan, points);
  Proposal proposal;
  proposal.spent = ranges.spent();
  const double purse = wish.budget > 0.0 ? wish.budget - proposal.spent : HUGE_VAL;
  FitSettings settings;
  settings.reference_temperature = plan.zero_pressure->temperature.front();
  settings = independent_errors(settings);  // the value of single points: docs/theory/fit.md, section 8
  if (!wish.model_errors) settings.model_errors = ModelErrors::none();
  const std::vector<PlannedPoint> start = ranges.start();
  if (!start.empty() && !bears_fit(plan, points, settings, store_name)) {
    double cost = 0.0;
    for (const PlannedPoint& point : start) cost += ranges.cost(point);
    if (cost > purse) {
      throw InputError(
          fmt::format("[adaptive]: the {} points that a first fit needs cost {:.3g} atom-steps, of "
                      "the budget of {:.3g} there are {:.3g} left",
                      start.size(), cost, wish.budget, std::fmax(purse, 0.0)));
    }
    proposal.lines.emplace_back("what a first fit needs:");
    propose_points(proposal, ranges, start);
    return proposal;
  }

  Planner planner(wish, settings, ranges, points, store_name);
  const double target = wish.target_error * std::abs(planner.outcome().value);
  const Planner::Path path = planner.best_path(purse, target);
  std::vector<PlannedPoint> chosen;
  for (const std::size_t step : path.steps) {
    if (static_cast<int>(chosen.size()) >= count) break;
    const Candidate& candidate = planner.candidate(step);
    chosen.insert(chosen.end(), candidate.points.begin(), candidate.points.end());
    planner.take(step);
  }
  const Proposal::Standing standing = planner.standing();
  proposal.standing = standing;
  const std::string& unit = planner.outcome().unit;
  proposal.lines.push_back(
      fmt::format("{} = {} +- {} ({:.2g} %; noise alone {:.2g} %) from {} points, {:.3g} atom-steps",
                  wish.outcome, practical_quantity(standing.value, unit),
                  practical_quantity(standing.error, unit), 100 * standing.error / standing.value,
                  100 * standing.noise / standing.value, points.size(), proposal.spent));
  if (!chosen.empty()) {
    proposal.lines.push_back(fmt::format("next, for an expected error of {:.2g} %:",
                                         100 * standing.expected_error / standing.value));
    propose_points(proposal, ranges, chosen);
  } else if (standing.error <= target) {
    proposal.end = fmt::format("the error is below the target of {:.2g} %", 100 * wish.target_error);
  } else if (path.too_dear) {
    proposal.end =
        fmt::format("what is left of the budget of {:.3g} atom-steps pays for no further point", wish.budget);
  } else {
    proposal.end = "no point of the ranges would lower the error by a noticeable amount";
  }
  return proposal;
}

}  // namespace whipple::fit
