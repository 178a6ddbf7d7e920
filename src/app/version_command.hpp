// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace whipple::app {

/// Adds `whipple version`: prints version, revision, compiler and the libraries with their versions.
void add_version_command(CLI::App& app);

}  // namespace whipple::app
