// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple edit`: changes values in the text of a case file.
void add_edit_command(CLI::App& app);

}  // namespace whipple::app
