// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple export`: exports snapshots of a run as VTK or CSV files.
void add_export_command(CLI::App& app);

}  // namespace whipple::app
