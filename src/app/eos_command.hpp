// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// `whipple eos state|hugoniot|isotherm|isentrope|release|melt|dome|audit MATERIAL`: states and curves of a
/// material's equation of state, as a table with units, CSV or figure.
void add_eos_command(CLI::App& app);

}  // namespace whipple::app
