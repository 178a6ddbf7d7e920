// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/data_set/run_cost.hpp"
#include "md_fitting/plan/plan.hpp"

namespace whipple::fit {

/// A point that a plan with [adaptive] may ask for.
struct PlannedPoint {
  md::PointKind protocol = md::PointKind::zero_pressure_volume;
  double volume_ratio = 0.0;  ///< V over that of the static crystal; of hugoniot and isochore
  double temperature = 0.0;   ///< K; of coexistence the first guess, of hugoniot none
  double pressure = 0.0;      ///< Pa; of coexistence
};

/// Points that are worth something together: three temperatures of a new isochore, else one.
struct Candidate {
  std::vector<PlannedPoint> points;
  double cost = 0.0;  ///< atom-steps
};

/// The sections of a plan as ranges, each with equidistant values; and what a store holds of them.
class Ranges {
 public:
  /// @param points  of the store; may be none
  Ranges(const md::Plan& plan, std::span<const md::PointRecord> points);

  /// The least that a fit needs, less what the store holds: the zero-pressure volumes, five Hugoniot states
  /// over their whole range, three temperatures of the largest and of the smallest volume, the lowest
  /// coexistence pressure.
  [[nodiscard]] std::vector<PlannedPoint> start() const;
  /// Everything else that the store does not hold. A point that failed is none.
  /// @param isochore_volumes  m^3/kg, with at least three states already: there a single state is worth
  /// something
  [[nodiscard]] std::vector<Candidate> candidates(std::span<const double> isochore_volumes) const;

  /// Atoms times steps (docs/theory/fit.md, section 8).
  [[nodiscard]] double cost(const PlannedPoint& point) const;
  /// Returns the cost of all points of the store, failed ones included.
  [[nodiscard]] double spent() const;
  /// V of the static crystal at zero pressure, as the store has it, m^3/kg.
  [[nodiscard]] double static_volume() const { return static_volume_; }
  /// Unit cells times averaged steps: the inverse of the variance goes with it.
  [[nodiscard]] double sampling(const PlannedPoint& point) const;
  [[nodiscard]] static double sampling(const md::PointRecord& point);

  /// The plan of these points, with the sizes of their sections.
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
