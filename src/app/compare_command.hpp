// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// `whipple compare MATERIAL.toml... --with FILE.csv...`: measured Hugoniots and isotherms against materials.
void add_compare_command(CLI::App& app);

}  // namespace whipple::app
