// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// `whipple import`: a case with its materials from the input deck of another code.
void add_import_command(CLI::App& app);

}  // namespace whipple::app
