// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple shield`: critical diameters of a shield by equations, cases of shots, and outcomes of runs.
void add_shield_command(CLI::App& app);

}  // namespace whipple::app
