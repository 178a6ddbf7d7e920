// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace whipple::process {

/// Runs one of the project's Python scripts ("scripts/plot_fit.py") or packages ("report"). The interpreter is
/// $WHIPPLE_PYTHON, else /usr/bin/python3 (Debian's, which has numpy, h5py and matplotlib), else python3 of the
/// path.
/// @returns its exit code
int run_script(const std::string& script, const std::vector<std::string>& arguments);

/// Runs a script that draws a figure.
/// @throws InputError if it fails
void draw_with(const std::string& script, const std::vector<std::string>& arguments);

/// Draws JSON text by `SCRIPT DATA.json FIGURE`, the data in a file beside the figure while it is drawn.
/// @throws InputError if the folder cannot be written or the script fails
void draw_json(const std::string& script, const std::string& json, const std::filesystem::path& figure);

}  // namespace whipple::process
