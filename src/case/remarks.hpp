// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "src/case/case.hpp"

namespace whipple::cases {

/// Describes valid but probably unintended settings: gaps narrower than a cell, a body that meets nothing until the
/// end, speeds beyond the shocks for which an equation of state is audited, explosives that are products from the
/// start, bodies that move or rotate against a symmetry plane that they touch, meshes with unconnected parts. Returns
/// one sentence for each, none if there are no such settings. Bodies are compared by their bounding boxes.
std::vector<std::string> remarks(const Case& setup);

}  // namespace whipple::cases
