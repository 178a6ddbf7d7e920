// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple import`: converts the input deck of another code to a case with its materials.
void add_import_command(CLI::App& app);

}  // namespace whipple::app
