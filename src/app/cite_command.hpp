// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple cite`: how to cite the program, and the sources of material constants.
void add_cite_command(CLI::App& app);

}  // namespace whipple::app
