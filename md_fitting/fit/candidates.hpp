// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/data_set/run_cost.hpp"
#include "md_fitting/plan/plan.hpp"

namespace whipple::fit {

/// Describes a point that a plan with [adaptive] may request.
struct PlannedPoint {
  md::PointKind protocol = md::PointKind::zero_pressure_volume;
  double volume_ratio = 0.0;  ///< V over that of the static crystal; for hugoniot and isochore
  double temperature = 0.0;   ///< K; the first guess for coexistence, unused for hugoniot
  double pressure = 0.0;      ///< Pa; for coexistence
};

/// Groups points that are useful only together: three temperatures of a new isochore, otherwise one point.
struct Candidate {
  std::vector<PlannedPoint> points;
  double cost = 0.0;  ///< atom-steps
};

/// Represents the sections of a plan as ranges of equidistant values, with the points that a database holds of them.
class Ranges {
 public:
  /// @param points  of the database; may be empty
  Ranges(const md::Plan& plan, std::span<const md::PointRecord> points);

  /// Returns the minimum that a fit needs, less the points in the database: the zero-pressure volumes, five
  /// Hugoniot states over their whole range, three temperatures at the largest and at the smallest volume, and the
  /// lowest coexistence pressure.
  [[nodiscard]] std::vector<PlannedPoint> start() const;
  /// Returns all other points that are not in the database. Points that failed are not candidates.
  /// @param isochore_volumes  m^3/kg, with at least three states already: there a single further state is useful
  [[nodiscard]] std::vector<Candidate> candidates(std::span<const double> isochore_volumes) const;

  /// Returns atoms times steps (docs/theory/fit.md, section 8).
  [[nodiscard]] double cost(const PlannedPoint& point) const;
  /// Returns the cost of all points in the database, including failed ones.
  [[nodiscard]] double spent() const;
  /// Returns V of the static crystal at zero pressure from the database, m^3/kg.
  [[nodiscard]] double static_volume() const { return static_volume_; }
  /// Returns unit cells times averaged steps; the variance is inversely proportional to it.
  [[nodiscard]] double sampling(const PlannedPoint& point) const;
  [[nodiscard]] static double sampling(const md::PointRecord& point);

  /// Returns the plan of these points, with the run sizes of their sections.
  [[nodiscard]] md::Plan plan_of(std::span<const PlannedPoint> points) const;

 private:
  [[nodiscard]] md::RunShape shape_of(const PlannedPoint& point) const;
  [[nodiscard]] const md::IsochorePlan& nearest_isochore(double volume_ratio) const;
  [[nodiscard]] std::vector<PlannedPoint> isochore(double volume_ratio) const;
  [[nodiscard]] std::vector<PlannedPoint> hugoniot() const;
  [[nodiscard]] std::vector<PlannedPoint> coexistence() const;
  [[nodiscard]] std::vector<double> isochore_ratios() const;
  [[nodiscard]] bool present(const PlannedPoint& point) const;

  const md::Plan& plan_;
  std::span<const md::PointRecord> points_;
  double static_volume_ = 0.0;
  double atoms_per_cell_ = 4.0;
};

}  // namespace whipple::fit
