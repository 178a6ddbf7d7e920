// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/case/case.hpp"

namespace whipple::run {

/// Returns the path of the material file of every body in the run directory, "materials/copper.toml". With these copies
/// a restart does not depend on files elsewhere.
std::vector<std::string> material_copies(const cases::Case& setup);

}  // namespace whipple::run
