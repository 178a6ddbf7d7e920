// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace whipple::app {

/// The library as Markdown tables, one per group: what each material's equation of state says about rest,
/// melting, boiling, shocks and release, beside the measured melting and boiling points of its file.
/// @throws InputError if a file of the library cannot be read
std::string library_as_markdown();

}  // namespace whipple::app
