// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/fem/mesh_file.hpp"

namespace whipple::fem {

/// Returns whether a file begins as one of VTK: in XML, or legacy.
bool is_vtk(const std::filesystem::path& path);

/// Reads points and cells of an unstructured grid of VTK: XML (.vtu: in ASCII, in base 64, appended; packed by zlib or
/// not), or legacy ASCII (.vtk). Cells that share the value of an array of integers are a group, "ARRAY VALUE"; if there is
/// no such array, all cells are the group "all".
/// @throws InputError naming the file: damaged, another data set, several pieces, packed otherwise, a cell of an unknown
/// type, a point that is not there
MeshData read_vtk(const std::filesystem::path& path, double length_unit);

}  // namespace whipple::fem
