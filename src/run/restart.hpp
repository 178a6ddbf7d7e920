// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "src/io/checkpoint.hpp"
#include "src/setup/case.hpp"
#include "src/solver/simulation.hpp"

/// What makes a checkpoint one of a case: the input that it was written with, and numbers that a state can
/// have. A seal shows damage; it does not show a checkpoint of another run, or a forged one.
namespace whipple::run {

/// Adds the case to the values: every key, and the digests of the files of materials and meshes.
void remember_input(const setup::Case& setup, io::CheckpointValues& values);

/// Compares the case with what the checkpoint remembers. Grid, bodies, their files and the gauges must be the
/// same.
/// @returns the other keys that differ, "contact.method = \"none\", was \"multi_field\""; empty if none does
/// @throws InputError naming what differs and the way out
std::string require_same_input(const setup::Case& setup, const io::CheckpointValues& values);

/// Are all numbers of this rank's share within what a state can have: finite, masses positive, fractions
/// below one, bodies and nodes that are there? Collective.
/// @throws InputError naming file, field, row, value and what is admissible
void require_admissible(const setup::Case& setup, const io::Checkpoint& checkpoint, MPI_Comm communicator);

/// The simulation at the checkpoint, if it passes both; says which keys have changed. Takes particles, meshes and
/// bars out of the checkpoint. Collective.
/// @throws InputError naming these keys if the case needs what the checkpoint does not hold
solver::Simulation resume(const setup::Case& setup, io::Checkpoint& checkpoint, MPI_Comm communicator);

}  // namespace whipple::run
