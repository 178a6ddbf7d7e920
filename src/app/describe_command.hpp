// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple describe`: every key of the inputs with unit, range, default and meaning.
void add_describe_command(CLI::App& app);

}  // namespace whipple::app
