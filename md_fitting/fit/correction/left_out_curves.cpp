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

/// Collects the deviations of one kind.
struct Sums {
  LeftOutCurves of_kind{};
  double squares = 0.0;
  std::vector<double> half_widths{};
  std::string last_curve{};

  void add(const LeftOutDatum& datum, double deviation, double variance, double error) {
    ++of_kind.data;
    if (last_curve != datum.curve) ++of_kind.curves;
    last_curve = datum.curve;
    const double whole = std::sqrt(variance);
    of_kind.inside_68 += std::abs(deviation) <= of_68 * whole ? 1.0 : 0.0;
    of_kind.inside_95 += std::abs(deviation) <= of_95 * whole ? 1.0 : 0.0;
    squares += std::pow(deviation / datum.scale, 2);
    half_widths.push_back(of_95 * std::sqrt(std::max(variance - error, 0.0)) / std::abs(datum.scale));
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
    if (datum.is_known && place.emplace(datum.kind, kinds.size()).second)
      kinds.emplace_back().of_kind.kind = datum.kind;
  }
  for (const auto& [name, rows] : curves) {
    const MatrixXd of_curve = inverse_of_symmetric(Q(rows, rows));
    const VectorXd deviations = of_curve * VectorXd(weighted(rows));
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto i = static_cast<Index>(k);
      const LeftOutDatum& datum = data[static_cast<std::size_t>(rows[k])];
      kinds[place.at(datum.kind)].add(datum, deviations[i], of_curve(i, i), errors(rows[k], rows[k]));
    }
  }
  std::vector<LeftOutCurves> results;
  for (Sums& kind : kinds) results.push_back(kind.result());
  return results;
}

}  // namespace whipple::fit
