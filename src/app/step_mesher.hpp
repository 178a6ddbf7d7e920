// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace whipple::app {

/// Triangulates a STEP file by the program gmsh (a `solids::StepMesher`). Edges are at most as long as asked for, 36 go
/// around a circle, but none is shorter than an eighth. Coordinates are converted from the unit that the file states.
/// @throws InputError naming the file: gmsh is not installed, or it does not read the file
void triangulate_by_gmsh(const std::filesystem::path& step, double edge, const std::filesystem::path& stl);

}  // namespace whipple::app
