// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "md_fitting/fit/candidates.hpp"
#include "md_fitting/fit/gray_fit.hpp"
#include "md_fitting/fit/solid_problem.hpp"

namespace whipple::fit {

/// Holds the data of a fit together with those that candidates would add: values as predicted by the fit, and
/// errors scaled from points of the same protocol, sigma = a (cells x steps)^-1/2 with the geometric mean of a over
/// the database (docs/theory/fit.md, section 8).
class ExpectedData {
 public:
  /// @param fit    supplies the values
  /// @param points of the database, supply the errors
  ExpectedData(const GrayFit& fit, std::span<const md::PointRecord> points, const Ranges& ranges,
               const std::vector<Candidate>& candidates);

  [[nodiscard]] const Observations& data() const { return data_; }

  /// Holds row indices of the least-squares problem of `data`.
  struct Rows {
    std::vector<Eigen::Index> present;                  ///< rows of the database
    std::vector<std::vector<Eigen::Index>> candidates;  ///< rows of each candidate; empty: it adds no datum
  };
  [[nodiscard]] Rows rows(const SolidProblem& problem) const;

 private:
  void add(const PlannedPoint& point, int owner, const GrayFit& fit);
  void add_hugoniot(const PlannedPoint& point, int owner);
  void add_isochore(const PlannedPoint& point, int owner);
  void add_coexistence(const PlannedPoint& point, int owner, const GrayFit& fit);
  [[nodiscard]] double error(double coefficient, const PlannedPoint& point) const;

  const Ranges& ranges_;
  SolidConstants constants_;
  Observations data_;
  std::size_t candidates_ = 0;
  // Coefficients a of the errors.
  double shock_pressure_ = 0.0;           // relative
  double pressure_ = 0.0, energy_ = 0.0;  // over T^1/2
  double melting_ = 0.0, solid_volume_ = 0.0, latent_heat_ = 0.0;
  double correlation_ = 0.0;
  // Owners of the data, in the order of the data: index of a candidate, or -1 for the database.
  std::vector<int> hugoniot_owners_, melting_owners_;
  std::vector<std::vector<int>> isochore_owners_;
};

}  // namespace whipple::fit
