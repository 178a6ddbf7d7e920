// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "src/grid/block_grid.hpp"
#include "src/particles/particles.hpp"

namespace whipple::transfer {

/// Constants of conduction of one body.
struct ThermalConstants {
  double conductivity = 0.0;   ///< W/(m K)
  double heat_capacity = 0.0;  ///< J/(kg K), weights the contribution of a particle to the heat of a node
};

/// Predicate: two fields of a contact slot, by their numbers there, touch at a node. Empty: wherever both are
/// present.
using TouchAtNode =
    std::function<bool(std::size_t contact_slot, std::size_t node, std::size_t first, std::size_t second)>;

/// One explicit step of the heat conduction between particles through the grid, with quadratic B-splines
/// (docs/theory/conduction.md): temperatures to the nodes, Fourier's flux at the particles and what each gives
/// to the material around it in its cell, heat to the nodes and back into the specific internal energies. The
/// sum of the heat is zero to round-off; mirror planes and free surfaces are adiabatic. Particles must be binned; node contents are lost. Collective;
/// bitwise independent of the number of threads.
/// @param of_body  constants of every body of the case
/// @param touch    bodies with velocity fields of their own exchange heat where they touch
void conduct_heat(Particles& particles, grid::BlockGrid& grid, double dt,
                  std::span<const ThermalConstants> of_body, const TouchAtNode& touch = {});

}  // namespace whipple::transfer
