// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <span>

#include "src/particles/particles.hpp"

namespace whipple {

/// Sends every particle to the rank that is named for it, with all of its fields. Afterwards the particles
/// stand by body; within a body those that stayed first, in their order, then the newcomers by rank and
/// order. Collective.
/// @returns whether any particle changed its rank or its place on this rank
bool migrate(Particles& particles, std::span<const int> destination, MPI_Comm communicator);

}  // namespace whipple
