// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple view`: writes a run in three dimensions as one page for the browser.
void add_view_command(CLI::App& app);

}  // namespace whipple::app
