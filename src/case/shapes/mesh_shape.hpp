// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "src/case/discretization.hpp"
#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// The shape that the hexahedra of a Gmsh file fill (keys mesh, group and mesh_unit of a discretization).
/// Reports errors in the document and returns null then.
std::unique_ptr<Shape> read_mesh_shape(const Discretization& control, input::Table& table);

}  // namespace whipple::cases
