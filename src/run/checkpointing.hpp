// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/io/checkpoint.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {

/// Collects the state of a run by name, for a checkpoint.
io::CheckpointValues to_checkpoint(const solver::RunState& state);

/// Restores the state of a run.
/// @throws InputError naming the missing value
solver::RunState from_checkpoint(const io::CheckpointValues& values);

}  // namespace whipple::run
