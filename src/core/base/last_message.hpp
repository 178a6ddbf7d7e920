// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace whipple::log {

/// Returns the last message to the user (information, warning or error of log.hpp); empty before the first.
[[nodiscard]] const std::string& last_message();

}  // namespace whipple::log
