// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/coexistence.hpp"
#include "md_fitting/protocols/replicas.hpp"
#include "md_fitting/protocols/statistics.hpp"

namespace whipple::md {

/// Holds the quantities by which a coexistence run is accepted or rejected.
struct CoexistenceRun {
  Estimate first_half;       ///< K, mean temperature of the first half of the averaged part
  Estimate second_half;      ///< K
  double first_share = 0.0;  ///< crystal fraction in the first half
  double second_share = 0.0;
  double least_share = 0.0;  ///< over both halves
  double largest_share = 0.0;
  /// Crystal order in the least and the most ordered layer of the second half, 0 for melt, 1 for the hot crystal.
  double least_order = 0.0;
  double largest_order = 1.0;
  Estimate whole{};  ///< K, mean temperature of both halves; the error includes the slow phase exchange
};

/// Returns the standard error of the mean temperature of crystal and melt at constant enthalpy. A run shorter than
/// about ten relaxation times of the slow phase exchange does not sample that part of the fluctuations. Their total
/// variance is known, 2 T^2/(3 N) (the effective heat capacity of coexistence is unbounded), and the part missing
/// from the run is the variance of its mean. It is used where it clearly exceeds the error of the series.
/// docs/theory/molecular_dynamics.md, "Melting by coexistence".
double coexistence_error(const SeriesMean& temperature, double atoms);

/// Returns the reason to reject a run as two phases in equilibrium, or an empty text. Both phases must be present,
/// the halves must agree within three standard errors of their difference (twice that of the whole), and the
/// crystal fraction must drift by less than 0.12. A fully crystallised or fully molten cell has an equally steady
/// temperature, and the fraction of a hot crystal with defects is no clear criterion: a layer of melt and a layer
/// of crystal are required (crystal below 0.35 and above 0.5), with a fraction between 0.15 and 0.85.
std::string refusal(const CoexistenceRun& run);

/// Determines the starting temperature of the next attempt from attempts that lost a phase.
class StartingTemperature {
 public:
  explicit StartingTemperature(double first) : next_(first) {}
  [[nodiscard]] double next() const { return next_; }
  /// Records that the whole cell froze: the start was too cold.
  void froze();
  /// Records that the whole cell melted: the start was too hot.
  void melted();
  /// Records a run with both phases that have not equilibrated.
  void ended_at(double temperature) { next_ = temperature; }

 private:
  double next_;
  double too_cold_ = 0.0;
  double too_hot_ = 0.0;  ///< 0: unknown
};

/// Measures the melting temperature at a pressure from a crystal in contact with its melt at constant enthalpy and
/// pressure (Morris, Wang, Ho, Chan, Phys. Rev. B 49 (1994) 3109), in a cell n x n x length; then volume and
/// enthalpy of each phase at that temperature in a separate cell; all from independent runs. Face-centred cubic
/// crystals only.
/// @throws StateError if too many runs find no coexistence, with the outcome of each.
ReplicaSet<CoexistencePoint> measure_coexistence(const Potential& potential, double pressure,
                                                 double first_guess, const CoexistencePlan& section,
                                                 std::int64_t seed);

}  // namespace whipple::md
