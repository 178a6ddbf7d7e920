// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace whipple::fit {

/// Runs a plotting script of the project on JSON data: `python3 scripts/SCRIPT DATA.json FIGURE.png`. Python
/// is $WHIPPLE_PYTHON, else /usr/bin/python3 (Debian's, which has matplotlib), else python3 of the path.
/// @throws InputError if script or Python are missing or the script fails
void draw(const std::string& script, const std::string& data, const std::filesystem::path& figure);

}  // namespace whipple::fit
