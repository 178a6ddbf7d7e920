// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/fem/mesh_file.hpp"

namespace whipple::fem {

/// Returns whether the first line of a file that is not blank begins as a keyword or comment of Abaqus.
bool is_abaqus(const std::filesystem::path& path);

/// Reads nodes, elements and element sets of an input of Abaqus: *NODE, in Cartesian or cylindrical coordinates,
/// *ELEMENT, *ELSET. Materials, sections, loads, contact, steps and output are of no concern to a mesh. Sets are groups,
/// by their names; those that hold other sets hold their elements.
/// @throws InputError naming file and line: damaged, an element of an unknown type, a node or element that is not
/// defined, parts and assemblies, *INCLUDE, keywords that make or move nodes or are not known, parameters of *NODE,
/// *ELEMENT and *ELSET that are not read
MeshData read_abaqus(const std::filesystem::path& path, double length_unit);

}  // namespace whipple::fem
