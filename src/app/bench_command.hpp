// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// whipple bench: nanoseconds per particle and step, by stage, beside the machine's memory bandwidth.
void add_bench_command(CLI::App& app);

}  // namespace whipple::app
