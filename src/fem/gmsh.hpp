// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/fem/mesh_file.hpp"

namespace whipple::fem {

/// Reads a Gmsh file, format 2.2 or 4.1, ASCII. @throws InputError naming file and line
MeshData read_gmsh(const std::filesystem::path& path, double length_unit);

}  // namespace whipple::fem
