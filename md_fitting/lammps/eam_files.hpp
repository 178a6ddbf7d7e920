// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "md_fitting/lammps/eam_tables.hpp"

/// Reads embedded-atom potential files: funcfl (.eam), setfl (.eam.alloy), Finnis-Sinclair setfl (.eam.fs) and
/// angular-dependent setfl (.adp), as defined in the LAMMPS documentation of pair_style eam and pair_style adp.
namespace whipple::md {

enum class EamFormat { funcfl, setfl, finnis_sinclair, angular_dependent };

/// Returns the format from the file name extension.
/// @throws InputError listing the known extensions.
EamFormat eam_format(const std::filesystem::path& path);

/// Returns the elements in a file. @throws InputError if it cannot be read.
std::vector<std::string> elements_in(const std::filesystem::path& path);

/// Reads the tables of one element.
/// @throws InputError if the file is missing or damaged, if it does not contain the element (naming those that it
/// contains), or if an angular-dependent potential has nonzero dipole or quadrupole functions for this element.
EamTables read_eam(const std::filesystem::path& path, const std::string& element);

/// Writes the tables as text in the setfl format with one element; numbers keep all digits.
std::string to_setfl(const EamTables& tables, const std::string& comment);

}  // namespace whipple::md
