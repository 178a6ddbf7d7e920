// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/coexistence.hpp"
#include "md_fitting/protocols/replicas.hpp"
#include "md_fitting/protocols/statistics.hpp"

namespace whipple::md {

/// The numbers by which one coexistence run is judged.
struct CoexistenceRun {
  Estimate first_half;       ///< K, mean temperature of the first half of the averaged part
  Estimate second_half;      ///< K
  double first_share = 0.0;  ///< of crystal in the first half
  double second_share = 0.0;
  double least_share = 0.0;  ///< over both halves
  double largest_share = 0.0;
  /// Crystal in the least and the most ordered layer of the second half, 0 for melt, 1 for the hot crystal.
  double least_order = 0.0;
  double largest_order = 1.0;
  Estimate whole{};  ///< K, mean temperature of both halves; its error holds the slow exchange of the phases
};

/// Standard error of the mean temperature of crystal and melt at constant enthalpy. A run shorter than some
/// ten times of relaxation of the phases' slow exchange does not show that part of the fluctuations; but
/// their whole variance is known, 2 T^2/(3 N) (the effective heat capacity of coexistence has no bound), and
/// what the run lacks of it is the variance of its mean. Taken where it exceeds the error of the series
/// clearly. docs/theory/molecular_dynamics.md, "Melting by coexistence".
double coexistence_error(const SeriesMean& temperature, double atoms);

/// Returns whether a run is two phases at rest with each other: both are there, the halves agree within three
/// standard errors of their difference (twice that of the whole), and the fraction of crystal drifts by less
/// than 0.12. A cell that has become all crystal or all melt looks just as steady in its temperature, and the
/// fraction of a hot crystal with defects is no clear mark: a layer of melt and a layer of crystal must be there
/// (crystal below 0.35 and above 0.5), with a fraction between 0.15 and 0.85. Returns the reason for a refusal,
/// or an empty text.
std::string refusal(const CoexistenceRun& run);

/// Temperatures of starts that lost a phase: where the next one begins.
class StartingTemperature {
 public:
  explicit StartingTemperature(double first) : next_(first) {}
  [[nodiscard]] double next() const { return next_; }
  /// The whole cell froze: it began too cold.
  void froze();
  /// The whole cell melted: it began too hot.
  void melted();
  /// Both phases, but still on their way.
  void ended_at(double temperature) { next_ = temperature; }

 private:
  double next_;
  double too_cold_ = 0.0;
  double too_hot_ = 0.0;  ///< 0: not known
};

/// The melting temperature at a pressure from a crystal in contact with its melt at constant enthalpy and
/// pressure (Morris, Wang, Ho, Chan, Phys. Rev. B 49 (1994) 3109), in a cell n x n x length; then volume and
/// enthalpy of both phases at that temperature in cells of their own; all of independent runs. Face-centred
/// cubic crystals only. Results: melting_temperature (K), solid_share (of the atoms), solid_ and
/// liquid_specific_volume (m^3/kg), latent_heat (J/kg), fusion_volume (m^3/kg).
/// @throws StateError if too many runs find no coexistence, with what each ended like.
ReplicaSet measure_coexistence(const Potential& potential, double pressure, double first_guess,
                               const CoexistencePlan& section, std::int64_t seed);

}  // namespace whipple::md
