// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <span>

#include "src/particles/particles.hpp"

namespace whipple {

/// Sends every particle to the rank that is named for it, with all of its fields. Particles stand by body,
/// before and after; within a body newcomers and the last ones take the places of those that left.
/// Collective.
/// @returns whether any particle changed its rank
bool migrate(Particles& particles, std::span<const int> destination, MPI_Comm communicator);

}  // namespace whipple
