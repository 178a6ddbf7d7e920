// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <span>

#include "src/particles/particles.hpp"

namespace whipple {

/// Sends every particle to its destination rank, with all of its fields. Particles are sorted by body, before and
/// after; within a body, arriving particles and the last ones fill the gaps. Collective.
/// @returns whether any particle changed its rank
bool migrate(Particles& particles, std::span<const int> destination, MPI_Comm communicator);

}  // namespace whipple
