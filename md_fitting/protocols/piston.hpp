// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/piston.hpp"
#include "md_fitting/protocols/hugoniot.hpp"

namespace whipple::md {

struct PistonResult : PistonPoint {
  std::string transcript;
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
