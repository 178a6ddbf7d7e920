// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "src/case/discretization.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// Returns the shape filled by the hexahedra of a mesh file (keys mesh, group and mesh_unit of a discretization).
/// @throws InputError if the file cannot be used
std::unique_ptr<Shape> shape_of_mesh(const Discretization& control);

}  // namespace whipple::cases
