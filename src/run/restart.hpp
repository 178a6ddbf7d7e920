// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "src/case/case.hpp"
#include "src/io/checkpoint.hpp"
#include "src/solver/simulation.hpp"

/// Checks that a checkpoint belongs to a case: it holds the input that it was written with, and only numbers that
/// a state can have. Its seal detects damage, but neither a checkpoint of another run nor a forged one.
namespace whipple::run {

/// Returns whether a key of a case, "domain.cell_size", determines what a checkpoint holds: a restart cannot change it.
bool is_fixed(std::string_view key);

/// Adds the case to the values of a checkpoint: every key, and digests of the material and mesh files.
void remember_input(const cases::Case& setup, io::CheckpointValues& values);

/// Compares a case with the input that a checkpoint was written with. Grid, bodies, their files and the gauges
/// must be the same.
/// @returns the other keys that differ, "contact.method = \"none\", was \"multi_field\""; empty if none does
/// @throws InputError naming what differs and the way out
std::string require_same_input(const cases::Case& setup, const io::CheckpointValues& values);

/// Checks that all numbers of this rank are ones that a state can have: finite, masses positive, fractions below
/// one, indices of bodies and nodes in range. Collective.
/// @throws InputError naming file, field, row, value and what is admissible
void require_admissible(const cases::Case& setup, const io::Checkpoint& checkpoint, MPI_Comm communicator);

/// Builds the simulation at a checkpoint that passes both checks, and logs which keys have changed. Moves
/// particles, meshes and bars out of the checkpoint. Collective.
/// @throws InputError naming these keys if the case needs what the checkpoint does not hold
solver::Simulation resume(const cases::Case& setup, io::Checkpoint& checkpoint, MPI_Comm communicator);

}  // namespace whipple::run
