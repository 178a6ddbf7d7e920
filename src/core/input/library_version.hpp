// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace whipple::input {

/// Returns the version of toml++, which this module alone includes.
std::string toml_library_version();

}  // namespace whipple::input
