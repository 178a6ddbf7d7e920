// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tests/verification/exact/result.hpp"

/// A long block of metal in uniform compression that moves through the cells: nothing happens to it, so that all heat
/// is that of the cells that its particles cross.
namespace whipple::verification::exact {

struct AdvectedBlock {
  std::string name;
  std::string material;       ///< file; without strength
  double compression;         ///< 1 - V/V0, along the axis of the motion, isentropic
  double extra_energy = 0.0;  ///< J/kg, above the isentrope
  double speed = 1e3;         ///< m/s
  double courant = 0.5;
  double way = 2e-3;  ///< m
};

/// Mean square of the nodal force of a lattice in uniform pressure, over that pressure times the face of a cell
/// (docs/theory/dissipation.md, 10): the noise of quadratic functions.
/// @param per_cell  particles per cell along the axis
double force_noise(double per_cell, double slope_smoothing);

/// Heat of the core of the block, which the waves from its free ends have not reached, per mass and cell crossed, and
/// that of the law of docs/theory/dissipation.md, 11.
Result run(const AdvectedBlock& block, double cell);

}  // namespace whipple::verification::exact
