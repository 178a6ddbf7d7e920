// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/particles/material_points.hpp"

namespace whipple::solver {

/// Holds the masses by phase and the mass of failed material.
struct PhaseMasses {
  std::array<double, 4> mass{};  ///< solid, melting, liquid, vapour, kg
  double failed = 0.0;           ///< kg
  PhaseMasses& operator+=(const PhaseMasses& other);
};
/// Sums the masses (kg) by phase over the material points [first, first + count); bitwise independent of the
/// number of threads.
PhaseMasses phase_masses(const MaterialPoints& points, std::size_t first, std::size_t count);
/// Sums the masses of each body over all ranks. Collective.
void sum_over_ranks(MPI_Comm communicator, std::vector<PhaseMasses>& by_body);

}  // namespace whipple::solver
