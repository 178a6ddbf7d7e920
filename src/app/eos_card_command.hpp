// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

namespace whipple::app {

/// Adds `whipple eos card MATERIAL --format ls-dyna`: the equation of state as a card of another program.
void add_eos_card(CLI::App& eos_command);

}  // namespace whipple::app
