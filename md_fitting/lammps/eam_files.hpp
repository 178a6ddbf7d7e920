// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "md_fitting/lammps/eam_tables.hpp"

/// Embedded-atom potential files: funcfl (.eam), setfl (.eam.alloy), Finnis-Sinclair setfl (.eam.fs) and
/// angular-dependent setfl (.adp), as LAMMPS defines them in its pages on pair_style eam and pair_style adp.
namespace whipple::md {

enum class EamFormat { funcfl, setfl, finnis_sinclair, angular_dependent };

/// The format by the ending of the file name.
/// @throws InputError with the endings that are known.
EamFormat eam_format(const std::filesystem::path& path);

/// The elements of a file. @throws InputError if it cannot be read.
std::vector<std::string> elements_in(const std::filesystem::path& path);

/// The tables of one element.
/// @throws InputError if the file is missing or damaged, if the element is not in it (naming those that are),
/// or if an angular-dependent potential has dipole or quadrupole functions other than zero for this element.
EamTables read_eam(const std::filesystem::path& path, const std::string& element);

/// The tables as text in the setfl format with one element; numbers keep all their digits.
std::string to_setfl(const EamTables& tables, const std::string& comment);

}  // namespace whipple::md
