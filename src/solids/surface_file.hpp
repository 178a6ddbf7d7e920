// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "src/solids/surface.hpp"

namespace whipple::solids {

/// Reads the triangles of an STL (binary or text), OBJ or PLY file; the content determines the format, not the name.
/// Polygons are divided into triangles about their first corner; everything but corners and faces is ignored.
/// @param unit  m per unit of its coordinates
/// @throws InputError naming the file, and the line or number of the fault: another format, damaged, a corner that does
/// not exist, a coordinate that is not finite
std::vector<Triangle> read_surface(const std::filesystem::path& path, double unit);

/// Reads the bytes of a PLY file. @throws InputError as `read_surface`
std::vector<Triangle> read_ply(std::string_view bytes, const std::string& file);

}  // namespace whipple::solids
