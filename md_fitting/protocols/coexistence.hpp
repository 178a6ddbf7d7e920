// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/statistics.hpp"

namespace whipple::md {

struct CoexistenceResult {
  Estimate melting_temperature;     ///< K
  Estimate solid_share;             ///< of the atoms, 0 ... 1, mean of the averaged part
  Estimate solid_specific_volume;   ///< m^3/kg, of the crystal alone at the melting point
  Estimate liquid_specific_volume;  ///< m^3/kg, of the melt alone at the melting point
  Estimate latent_heat;             ///< J/kg, enthalpy of the melt less that of the crystal
  Estimate fusion_volume;           ///< m^3/kg, volume of the melt less that of the crystal
  int attempts = 0;
  std::string transcript;
};

/// The numbers by which one coexistence run is judged.
struct CoexistenceRun {
  Estimate first_half;       ///< K, mean temperature of the first half of the averaged part
  Estimate second_half;      ///< K
  double first_share = 0.0;  ///< of crystal in the first half
  double second_share = 0.0;
  double least_share = 0.0;  ///< over both halves
  double largest_share = 0.0;
  Estimate whole{};  ///< K, mean temperature of both halves; its error holds the slow exchange of the phases
};

/// Standard error of the mean temperature of crystal and melt at constant enthalpy. A run shorter than some
/// ten times of relaxation of the phases' slow exchange does not show that part of the fluctuations; but
/// their whole variance is known, 2 T^2/(3 N) (the effective heat capacity of coexistence has no bound), and
/// what the run lacks of it is the variance of its mean. Taken where it exceeds the error of the series
/// clearly. docs/theory/molecular_dynamics.md, "Melting by coexistence".
double coexistence_error(const SeriesMean& temperature, double atoms);

/// Whether a run is two phases at rest with each other: the halves agree within three standard errors of
/// their difference (twice that of the whole), the share of crystal stays between 0.15 and 0.85 and drifts by
/// less than 0.12. A cell that has become all crystal or all melt looks just as steady in its temperature, so
/// the share decides. Returns the reason for a refusal, or an empty text.
std::string refusal(const CoexistenceRun& run);

/// The melting temperature at a pressure from a crystal in contact with its melt at constant enthalpy and
/// pressure (Morris, Wang, Ho, Chan, Phys. Rev. B 49 (1994) 3109), in a cell n x n x 2n; then volume and
/// enthalpy of both phases at that temperature in cells n x n x n of their own. Face-centred cubic crystals
/// only.
/// @throws StateError if no attempt is accepted, with what each ended like.
CoexistenceResult measure_coexistence(const Potential& potential, double pressure, double first_guess,
                                      std::int64_t attempts, const RunSize& size, std::int64_t seed);

}  // namespace whipple::md
