// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple md`: starts whipple-md, the executable that links LAMMPS, on several ranks.
void add_md_command(CLI::App& app);

}  // namespace whipple::app
