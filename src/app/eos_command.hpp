// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple eos state|hugoniot|isotherm|isentrope|release|melt|dome|cold|match|audit|plot MATERIAL...`: states and
/// curves of equations of state, as tables with units, CSV or figures.
void add_eos_command(CLI::App& app);

}  // namespace whipple::app
