// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple materials`: lists, searches and prints the files of the material library.
void add_materials_command(CLI::App& app);

}  // namespace whipple::app
