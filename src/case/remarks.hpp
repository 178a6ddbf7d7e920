// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/case/case.hpp"

namespace whipple::cases {

/// Names what a case allows but its user hardly wants: gaps narrower than a cell, a body that meets nothing
/// until the end, speeds beyond the shocks for which an equation of state is audited, explosives that are
/// products from the start, bodies that move or turn against the symmetry plane that they touch, meshes whose
/// parts are not joined. One sentence each; empty if there is nothing to say. Bodies are compared by their
/// bounding boxes.
std::vector<std::string> remarks(const Case& setup);

}  // namespace whipple::cases
