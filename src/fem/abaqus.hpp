// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/fem/mesh_file.hpp"

namespace whipple::fem {

/// Returns whether the first non-blank line of a file begins like a keyword or comment of Abaqus.
bool is_abaqus(const std::filesystem::path& path);

/// Reads nodes, elements and element sets of an Abaqus input file: *NODE, in Cartesian or cylindrical coordinates,
/// *ELEMENT, *ELSET. Ignores materials, sections, loads, contact, steps and output. Sets become groups with the same
/// names; sets that refer to other sets contain their elements.
/// @throws InputError naming file and line: damaged file, element of unknown type, undefined node or element, parts and
/// assemblies, *INCLUDE, keywords that create or move nodes or are unknown, unsupported parameters of *NODE, *ELEMENT
/// and *ELSET
MeshData read_abaqus(const std::filesystem::path& path, double length_unit);

}  // namespace whipple::fem
