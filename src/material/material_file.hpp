// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "src/material/material.hpp"

namespace whipple {

/// Groups of the library, in the order in which it is listed.
inline constexpr std::array<const char*, 7> material_groups = {
    "metals",         "explosives",        "polymers",    "concretes and ceramics",
    "rocks and ices", "liquids and gases", "verification"};

/// Reads a material file (TOML: name, source, note, group, [eos], [strength] and [[failure]] or [constitutive],
/// [measured]; the tables [provenance], [covariance], [defaults], [default_errors] and [potential_spread] are ignored).
/// `base` names a material whose tables apply where the file does not specify otherwise.
/// @param path    a path, or a bare file name ("copper.toml", "copper") that is searched in `beside`, then in the
/// library folders
/// @param beside  folder of the case; empty: the current folder
/// @throws InputError with all errors of the file at once, or the list of searched folders and the nearest name
Material read_material(const std::filesystem::path& path, const std::filesystem::path& beside = {});

/// Returns the file that `read_material` would read.
std::filesystem::path find_material(const std::filesystem::path& path,
                                    const std::filesystem::path& beside = {});

/// Returns the text of a self-contained material file: that of the file, or with the tables of its base included.
std::string material_text(const std::filesystem::path& file);

/// Returns the existing folders of the library in the order of search: $WHIPPLE_MATERIALS, share/whipple/materials next
/// to the installed executable, eos/materials of the source tree.
std::vector<std::filesystem::path> library_folders();

/// Requires that the brief audit of the equation of state (eos/audit.hpp) succeeds before a material is used;
/// reservations are reported to the user.
/// @throws InputError with the numbers and their limits if the equation of state is not usable
void require_usable(const Material& material);

struct LibraryMaterial {
  std::string name;  ///< of the material
  std::filesystem::path file;
  std::string note;   ///< one line
  std::string group;  ///< one of `material_groups`, or empty
};
/// Lists all materials of the library by file name; a file in an earlier folder hides one of the same name. Their
/// tables are checked, their models not built; a file that cannot be read is listed with the reason as its note.
std::vector<LibraryMaterial> library_materials();

}  // namespace whipple
