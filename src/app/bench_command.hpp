// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple bench`: nanoseconds per particle and step, by stage, compared with the machine's memory bandwidth.
void add_bench_command(CLI::App& app);

}  // namespace whipple::app
