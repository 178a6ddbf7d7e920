// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/correction/left_out_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "src/core/base/error.hpp"
#include "src/core/base/linear_algebra.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double of_68 = 0.99446, of_95 = 1.95996;  ///< standard deviations

constexpr std::size_t least_others = 4;  ///< curves that a factor is taken from
constexpr double greatest_factor = 30.0;

/// Holds the prediction of a datum from all other curves.
struct Prediction {
  std::size_t datum = 0;
  double deviation = 0.0, variance = 0.0, error = 0.0;  ///< variances: of the prediction alone, of the datum

  [[nodiscard]] double whole(double factor) const { return factor * factor * variance + error; }
};
using Curve = std::vector<Prediction>;

/// Returns the factor of the standard deviations of predictions at which the mean of (deviation/error)^2 is 1, at least 1.
/// @param without  a curve that is not counted
double factor_of(std::span<const Curve* const> curves, const Curve* without = nullptr) {
  const auto excess = [&](double factor) {
    double sum = 0.0, count = 0.0;
    for (const Curve* curve : curves) {
      if (curve == without) continue;
      for (const Prediction& p : *curve) {
        sum += p.deviation * p.deviation / p.whole(factor);
        count += 1.0;
      }
    }
    return sum - count;
  };
  if (curves.size() <= least_others || excess(1.0) <= 0.0) return 1.0;
  double low = 0.0, high = std::log(greatest_factor);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(std::exp(middle)) > 0.0 ? low : high) = middle;
  }
  return std::exp(high);
}

/// Collects the deviations of one kind.
struct Sums {
  LeftOutCurves of_kind{};
  double squares = 0.0;
  std::vector<double> half_widths{};
  std::string last_curve{};

  void add(const LeftOutDatum& datum, const Prediction& p, double factor) {
    ++of_kind.data;
    if (last_curve != datum.curve) ++of_kind.curves;
    last_curve = datum.curve;
    const double whole = std::sqrt(p.whole(factor));
    of_kind.inside_68 += std::abs(p.deviation) <= of_68 * whole ? 1.0 : 0.0;
    of_kind.inside_95 += std::abs(p.deviation) <= of_95 * whole ? 1.0 : 0.0;
    squares += std::pow(p.deviation / datum.scale, 2);
    half_widths.push_back(of_95 * factor * std::sqrt(p.variance) / std::abs(datum.scale));
  }
  [[nodiscard]] LeftOutCurves result() {
    of_kind.inside_68 /= of_kind.data;
    of_kind.inside_95 /= of_kind.data;
    of_kind.rms = std::sqrt(squares / of_kind.data);
    const auto middle = half_widths.begin() + static_cast<std::ptrdiff_t>(half_widths.size() / 2);
    std::ranges::nth_element(half_widths, middle);
    of_kind.half_width = *middle;
    return of_kind;
  }
};

}  // namespace

std::vector<LeftOutCurves> left_out_curves(std::span<const LeftOutDatum> data, const VectorXd& residuals,
                                           const MatrixXd& covariance, const MatrixXd& errors) {
  const Cholesky sigma(covariance);
  if (!sigma.is_positive()) throw StateError("left out curves: the covariance of the data is not positive");
  const MatrixXd Q = sigma.solve(MatrixXd::Identity(covariance.rows(), covariance.rows()));
  const VectorXd weighted = Q * residuals;
  std::map<std::string, std::vector<Index>> curves;
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (data[i].is_known) curves[data[i].curve].push_back(static_cast<Index>(i));
  }
  std::vector<Sums> kinds;
  std::map<std::string, std::size_t> place;
  for (const LeftOutDatum& datum : data) {
    if (!datum.is_known || !place.emplace(datum.kind, kinds.size()).second) continue;
    kinds.push_back({.of_kind = {.kind = datum.kind, .group = datum.group}});
  }
  std::vector<Curve> predicted;
  predicted.reserve(curves.size());
  std::map<CurveGroup, std::vector<const Curve*>> groups;
  for (const auto& [name, rows] : curves) {
    const MatrixXd of_curve = inverse_of_symmetric(Q(rows, rows));
    const VectorXd deviations = of_curve * VectorXd(weighted(rows));
    Curve& curve = predicted.emplace_back();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto i = static_cast<Index>(k);
      const double error = errors(rows[k], rows[k]);
      curve.push_back(
          {static_cast<std::size_t>(rows[k]), deviations[i], std::max(of_curve(i, i) - error, 0.0), error});
    }
    groups[data[curve.front().datum].group].push_back(&curve);
  }
  for (const auto& [group, members] : groups) {
    const bool is_widened = group != CurveGroup::none;
    const double of_all = is_widened ? factor_of(members) : 1.0;
    for (const Curve* curve : members) {
      const double factor = is_widened ? factor_of(members, curve) : 1.0;
      for (const Prediction& prediction : *curve) {
        Sums& kind = kinds[place.at(data[prediction.datum].kind)];
        kind.of_kind.widened = of_all;
        kind.add(data[prediction.datum], prediction, factor);
      }
    }
  }
  std::vector<LeftOutCurves> results;
  for (Sums& kind : kinds) results.push_back(kind.result());
  return results;
}

}  // namespace whipple::fit
