// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

/// Where the other executables and the data of the project lie: in the build tree, or in an installation.
namespace whipple::process {

/// The executable that is running.
std::filesystem::path own_executable();

/// An executable of the project ("whipple-md") in the folder of the running one.
/// @throws InputError if it is not there
std::filesystem::path find_executable(const std::string& name);

/// A data file or folder by its path in the source tree ("scripts/plot_fit.py", "report"): share/whipple beside the installed
/// executables first, then the source tree that this executable was built from.
/// @throws InputError naming both places if it is in neither
std::filesystem::path find_data(const std::filesystem::path& relative);

}  // namespace whipple::process
