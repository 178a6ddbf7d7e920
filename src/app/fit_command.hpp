// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple fit`: starts whipple-fit, the executable that links GSL.
void add_fit_command(CLI::App& app);

}  // namespace whipple::app
