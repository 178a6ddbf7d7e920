// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "src/setup/discretization.hpp"
#include "src/setup/shapes/shape.hpp"

namespace whipple::setup {

/// The shape that the hexahedra of a Gmsh file fill (keys mesh, group and mesh_unit of a discretization).
/// Reports errors in the document and returns null then.
std::unique_ptr<Shape> read_mesh_shape(const Discretization& control, input::Table& table);

}  // namespace whipple::setup
