// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/piston.hpp"
#include "md_fitting/protocols/hugoniot.hpp"

namespace whipple::md {

struct PistonResult {
  Estimate shock_velocity;          ///< m/s, relative to the material ahead of the shock
  Estimate pressure;                ///< Pa, normal stress behind the front from the momentum jump condition
  Estimate temperature;             ///< K, behind the front
  double shear_stress_share = 0.0;  ///< (P_zz - (P_xx + P_yy)/2) / P_zz behind the front
  double slipped_share = 0.0;       ///< fraction of the atoms behind the front, see `slipped_share`
  double sample_density = 0.0;      ///< kg/m^3, behind the front, from the number of atoms
  std::string transcript;

  /// Returns whether the crystal was compressed without slip. The state is then not hydrostatic and not a datum for
  /// an equation of state.
  [[nodiscard]] bool elastic() const;
};

/// Measures a shock along [001] of a perfect crystal that impacts a momentum mirror (Holian, Lomdahl, Science 280
/// (1998) 2085), with periodic lateral boundaries.
PistonResult measure_piston(const Potential& potential, const ReferenceState& reference,
                            double reference_temperature, double particle_velocity, const PistonPlan& section,
                            std::int64_t seed);

/// Returns the fraction of the listed atoms displaced transversely to the shock by more than half the shortest slip of
/// an fcc crystal, a/sqrt(6). Uniaxial compression causes no transverse displacement; slip displaces whole regions.
double slipped_share(std::span<const double> before, std::span<const double> after,
                     std::span<const std::size_t> atoms, double period, double lattice_constant);

/// Returns the position of a front, in layers, in a profile of layer velocities that are -velocity ahead of it and
/// about 0 behind it: the outermost crossing of -velocity/2; negative if there is none.
double front_position(std::span<const double> layer_velocity, double velocity);

/// Returns the slope of y(x) over the last two thirds, with the error of the mean of the slopes of five equal parts.
Estimate late_slope(std::span<const double> x, std::span<const double> y);

}  // namespace whipple::md
