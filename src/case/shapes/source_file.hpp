// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "src/case/shapes/shape.hpp"

namespace whipple::cases {

/// Returns the name, relative to the folder of a run, under which a run keeps a copy of a file.
std::filesystem::path kept_name(const std::string& digest, const std::filesystem::path& path);

/// Returns the absolute path of a file as a case names it, wherever it is read from: it is what a run writes.
std::filesystem::path named_file(const std::string& file, const std::filesystem::path& folder);

/// Finds the file of a shape. With a digest, a copy that a run keeps beside its case file comes first, so that a run
/// continues where the file has been moved or changed.
/// @param companion  returns the further file that it names, relative to it; empty: none
/// @throws InputError if there is no such file, or its digest is another one
SourceFile find_source(const std::string& file, const std::string& digest,
                       const std::filesystem::path& folder,
                       std::filesystem::path (*companion)(const std::filesystem::path&) = nullptr);

/// Copies the files of all shapes of a body into the folder of a run.
void keep_sources(const Shape& shape, const std::filesystem::path& folder);

}  // namespace whipple::cases
