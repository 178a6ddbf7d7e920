// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/verification/exact/gas_solutions.hpp"
#include "tests/verification/exact/result.hpp"

/// Problems of an ideal gas in units of 1 m, 1 kg/m^3, 1 m/s, each run with the default scheme.
namespace whipple::verification::exact {

/// Sod's shock tube (Sod, J. Comput. Phys. 27 (1978) 1) at 0.2 s; a column of one cell's width between mirror
/// planes. Errors per 1 m of the tube.
/// @param cells  along the tube of 1 m
Result sod(int cells);

/// Noh's problem in a column at a mirror plane, 1 m of gas with 5/3 at 0.6 s. Cells of the profiles are those
/// of the gas at the start, counted from the wall.
Result noh_planar(int cells);

/// Noh's problem in an octant between mirror planes, sphere of 1 m, gas with 5/3 at 0.6 s.
Result noh_spherical(int cells);

/// Sedov's blast in an octant between mirror planes, gas with 1.4, at 1 s, when the shock is 1 m from the
/// centre; the energy starts in the material within two cells of it.
/// @param cells  along the edge of 1.2 m
Result sedov(int cells);

}  // namespace whipple::verification::exact
