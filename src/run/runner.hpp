// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/io/checkpoint.hpp"
#include "src/io/ranks.hpp"
#include "src/io/run_directory.hpp"
#include "src/run/run.hpp"

namespace whipple::run {

/// The steps of a new run and everything that it writes into its folder. Collective.
/// @returns the exit code of `run`
int run_steps(const setup::Case& setup, const io::RunDirectory& directory, const RunOptions& options,
              const io::Ranks& ranks);

/// The same from a checkpoint on.
/// @param changed_input  replaces run.toml once the case has taken the state over; empty: it stays
/// @throws InputError if the checkpoint is not one of this case, or rows of the tables before it are missing
int run_steps(const setup::Case& setup, const io::RunDirectory& directory, io::Checkpoint checkpoint,
              const std::string& changed_input, const RunOptions& options, const io::Ranks& ranks);

}  // namespace whipple::run
