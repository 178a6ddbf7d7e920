// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/protocols/state_source.hpp"

namespace whipple::md {

/// Holds the state ahead of the shock.
struct ReferenceState {
  Estimate specific_volume;           ///< m^3/kg
  Estimate specific_internal_energy;  ///< J/kg
  double pressure = 0.0;              ///< Pa
  double correlation = 0.0;           ///< of the errors of volume and energy, -1 ... 1
};

/// Returns the state ahead of the shock from a point of protocol "zero_pressure_volume".
/// @throws InputError naming the missing quantity.
ReferenceState reference_state(const PointRecord& zero_pressure);

struct HugoniotSearch {
  double first_temperature = 0.0;       ///< K; any guess; a good one saves runs
  double specific_heat = 0.0;           ///< J/(kg K) for the first Newton steps, about 3R
  double gruneisen = 2.0;               ///< for the first Newton steps
  double temperature_tolerance = 0.02;  ///< relative difference of two temperatures for the final run
  int most_runs = 8;
};

struct HugoniotState : HugoniotPoint {
  int runs = 0;
  /// Pa, of the final run, each shifted onto the Hugoniot; may be empty.
  std::vector<double> pressure_blocks{};
};

/// Computes the state behind a steady shock at one specific volume: the temperature at which G(T) = E - E0 - (P +
/// P0)(V0 - V)/2 vanishes (Rankine and Hugoniot; docs/theory/molecular_dynamics.md, equation 8). Uses Newton steps
/// with the slope of a harmonic solid until two temperatures are far enough apart for a secant slope not to be
/// dominated by noise; the last Newton step, from the final run, shifts temperature, energy and pressure along the
/// isochore. Errors include the noise of the final run, with its correlation of pressure and energy, and of the
/// reference, with that of volume and energy.
/// @param specific_volume below that of the reference
/// @throws StateError if the search does not converge or reaches non-positive temperatures.
HugoniotState solve_hugoniot(StateSource& source, const ReferenceState& reference, double specific_volume,
                             const HugoniotSearch& search);

}  // namespace whipple::md
