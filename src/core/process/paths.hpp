// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

/// Locations of the other executables and the data of the project: in the build tree, or in an installation.
namespace whipple::process {

/// Returns the path of the running executable.
std::filesystem::path own_executable();

/// Returns the path of an executable of the project ("whipple-md") in the folder of the running one.
/// @throws InputError if it does not exist
std::filesystem::path find_executable(const std::string& name);

/// Returns the path of a data file or folder given by its path in the source tree ("scripts/plot_fit.py", "report"):
/// searches share/whipple next to the installed executables first, then the source tree from which this executable was
/// built.
/// @throws InputError naming both locations if it is in neither
std::filesystem::path find_data(const std::filesystem::path& relative);

/// Returns the path that find_data returns, none if there is nothing in either location.
std::optional<std::filesystem::path> data_if_there(const std::filesystem::path& relative);

/// Finds a table of measurements: a path, or a bare file name of those that come with the program (eos/data).
/// @throws InputError if there is no such file
std::filesystem::path find_experiment(const std::string& name);

}  // namespace whipple::process
