// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple report`: figures and tables of a run directory (the Python package report).
void add_report_command(CLI::App& app);

}  // namespace whipple::app
