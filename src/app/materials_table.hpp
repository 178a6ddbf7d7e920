// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace whipple::app {

/// Returns the library as Markdown tables, one per group: state at rest, melting, boiling, shocks and release by the
/// equation of state of each material, compared with the measured melting and boiling points of its file.
/// @throws InputError if a file of the library cannot be read
std::string library_as_markdown();

}  // namespace whipple::app
