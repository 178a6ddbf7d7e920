// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "src/case/case.hpp"
#include "src/io/checkpoint.hpp"
#include "src/solver/simulation.hpp"

/// Checks that a checkpoint belongs to a case: that it contains the input with which it was written, and only
/// admissible values. The checksum detects damage, but neither a checkpoint of another run nor a forged one.
namespace whipple::run {

/// Returns whether a key of a case, "domain.cell_size", determines the contents of a checkpoint: a restart cannot
/// change it.
bool is_fixed(std::string_view key);

/// Adds the case to the values of a checkpoint: every key, and digests of the material and mesh files.
void remember_input(const cases::Case& setup, io::CheckpointValues& values);

/// Compares a case with the input with which a checkpoint was written. Grid, bodies, their files and the gauges must be
/// the same.
/// @returns the other keys that differ, "contact.method = \"none\", was \"multi_field\""; empty if none does
/// @throws InputError naming the differences and the remedy
std::string require_same_input(const cases::Case& setup, const io::CheckpointValues& values);

/// Compares the bodies and the grid of a case with those of the run that wrote a checkpoint, whose state becomes the
/// start of another run. Velocities, paths and gauges may differ.
/// @throws InputError naming the differences
void require_same_bodies(const cases::Case& setup, const io::CheckpointValues& values);

/// Checks that all numbers of this rank are admissible: finite, masses positive, fractions at most one, indices of
/// bodies and nodes in range. Collective.
/// @throws InputError naming file, field, row, value and admissible range
void require_admissible(const cases::Case& setup, const io::Checkpoint& checkpoint, MPI_Comm communicator);

/// Builds the simulation at a checkpoint that passes both checks, and logs which keys have changed. Moves particles,
/// meshes and trusses out of the checkpoint. Collective.
/// @throws InputError naming these keys if the case needs data that the checkpoint does not contain
solver::Simulation resume(const cases::Case& setup, io::Checkpoint& checkpoint, MPI_Comm communicator);

/// Builds a simulation that begins at time 0 with the material of a checkpoint, and with the velocities that the case
/// gives to its bodies in addition. Moves particles, meshes and trusses out of the checkpoint. Collective.
/// @throws InputError if the bodies are not those of the case
solver::Simulation start_from(const cases::Case& setup, io::Checkpoint& checkpoint, MPI_Comm communicator);

}  // namespace whipple::run
