// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

namespace whipple::app {

/// Adds `whipple eos table MATERIAL -o FILE`: writes a complete model as a table of its entropy, verified against the
/// model.
void add_eos_tabulate(CLI::App& eos_command);

}  // namespace whipple::app
