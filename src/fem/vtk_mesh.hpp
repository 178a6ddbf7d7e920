// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/fem/mesh_file.hpp"

namespace whipple::fem {

/// Returns whether a file begins like a VTK file, XML or legacy.
bool is_vtk(const std::filesystem::path& path);

/// Reads points and cells of an unstructured VTK grid: XML (.vtu: ASCII, base64 or appended; optionally compressed by
/// zlib), or legacy ASCII (.vtk). Cells with the same value of an integer array form a group, "ARRAY VALUE"; without
/// such an array, all cells form the group "all".
/// @throws InputError naming the file: damaged, another dataset type, several pieces, another compression, a cell of an
/// unknown type, a point that does not exist
MeshData read_vtk(const std::filesystem::path& path, double length_unit);

}  // namespace whipple::fem
