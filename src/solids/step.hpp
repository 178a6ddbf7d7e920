// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

namespace whipple::solids {

/// Triangulates the faces of a STEP file, with edges of a length (m), and writes them as an STL file in m.
/// @throws InputError naming the file if it cannot
using StepMesher =
    std::function<void(const std::filesystem::path& step, double edge, const std::filesystem::path& stl)>;

/// Registers the mesher of STEP files for the whole process. This library starts no other program: one that can does so
/// once, before it reads cases.
void set_step_mesher(StepMesher mesher);

/// Returns whether a file begins as STEP files do (ISO 10303-21).
bool is_step(const std::filesystem::path& path);

/// Triangulates a STEP file by the registered mesher.
/// @throws InputError naming the file: it states no unit of length, no mesher is registered, or as the mesher does
void triangulate_step(const std::filesystem::path& step, double edge, const std::filesystem::path& stl);

}  // namespace whipple::solids
