// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"
#include "src/solver/ledger.hpp"

namespace whipple::solver {

/// Sums over the elements of a mesh and their nodes; bitwise independent of the number of threads.
/// @param affine_inertia  inertia per mass of the affine field, m^2 (`transfer::affine_inertia`)
Totals totals_of(const fem::Mesh& mesh, double affine_inertia);
/// Sums over bars and their nodes; bitwise independent of the number of threads.
Totals totals_of(const fem::Bars& bars, double affine_inertia);

}  // namespace whipple::solver
