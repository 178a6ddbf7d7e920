// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple measure`: measures of a run that need names of gauges or bodies and parameters.
void add_measure_command(CLI::App& app);

}  // namespace whipple::app
