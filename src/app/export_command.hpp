// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// `whipple export`: snapshots of a run as files of VTK or CSV.
void add_export_command(CLI::App& app);

}  // namespace whipple::app
