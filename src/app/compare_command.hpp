// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple compare MATERIAL.toml... --with FILE.csv...`: comparison of materials with measured Hugoniots and
/// isotherms.
void add_compare_command(CLI::App& app);

}  // namespace whipple::app
