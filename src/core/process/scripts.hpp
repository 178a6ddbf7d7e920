// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace whipple::process {

/// Runs a Python script ("scripts/plot_fit.py") or package ("report") of the project. The interpreter is
/// $WHIPPLE_PYTHON, else /usr/bin/python3 (that of Debian, which has numpy, h5py and matplotlib), else python3 from the
/// path.
/// $WHIPPLE_PROGRAM of the script is the program whipple beside this one.
/// @returns its exit code
int run_script(const std::string& script, const std::vector<std::string>& arguments);

/// Runs a script that draws a figure.
/// @throws InputError if it fails
void draw_with(const std::string& script, const std::vector<std::string>& arguments);

/// Draws JSON text by `SCRIPT DATA.json FIGURE`, with the data in a temporary file in the folder of the figure.
/// @throws InputError if the folder cannot be written or the script fails
void draw_json(const std::string& script, const std::string& json, const std::filesystem::path& figure);

}  // namespace whipple::process
