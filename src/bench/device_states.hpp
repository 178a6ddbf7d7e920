// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <filesystem>
#include <string>
#include <vector>

/// States for whipple-device-check (docs/manual/devices.md): what the host's kernels make of small problems.
namespace whipple::bench {

/// Names the problems.
std::vector<std::string> device_state_names();

/// Runs problems with the kernels of the host and writes FOLDER/NAME.state for each: particles after some steps, time
/// steps, and the particles after one further step and after all of them. No block is inactive, and models that a device
/// evaluates from tables are evaluated from them here too.
/// @param names     empty: all
/// @param steps     of each problem
/// @param revision  of the sources, stored in the files
/// @returns one line about each file
/// @throws InputError for an unknown name, and with several ranks
std::vector<std::string> write_device_states(const std::filesystem::path& folder,
                                             const std::vector<std::string>& names, std::size_t steps,
                                             const std::string& revision, MPI_Comm communicator);

}  // namespace whipple::bench
