// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"
#include "src/transfer/shape_kind.hpp"

namespace whipple::transfer {

/// Coefficients of the heat conduction of a body within shocks.
struct ShockConductivity {
  double heat_capacity = 0.0;        ///< J/(kg K); 0: it does not conduct
  double linear_viscosity = 0.0;     ///< c1 of the artificial viscosity
  double quadratic_viscosity = 0.0;  ///< c2
};

/// Amount of conduction within shocks, for all bodies (docs/theory/dissipation.md, eq. 8).
struct ShockConduction {
  double scale = 1.0;  ///< diffusivity of heat over that of the artificial viscosity
  double onset = 0.0;  ///< closing speed over a cell, per sound speed, where it begins
  double rise = 1.0;   ///< further closing speed over which it grows to the full one
  std::span<const ShockConductivity> of_body;
};

/// Moves internal energy from hot to cold particles inside shocks, as the artificial viscosity moves momentum
/// (eq. 8, 9): without it the layers where a shock was born stay too hot, since viscosity alone leaves the
/// energy that the width of the shock lacks where it began. The sum over the particles of a velocity field is
/// exact, no temperature leaves the range of those around, and the entropy grows. Only blocks around shocks
/// take part. Needs the closing rates of the particles; changes the nodes. Collective.
/// @returns J, energy that this rank's particles took up
double conduct_in_shocks(ShapeFunction shape, Particles& particles, grid::BlockGrid& grid, double dt,
                         const ShockConduction& conduction);

}  // namespace whipple::transfer
