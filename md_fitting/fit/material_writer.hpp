// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/potential_spread.hpp"

namespace whipple::fit {

/// Describes the origin of the points of a fit for the [provenance] table. Contains neither times nor paths, so
/// that the same database gives the same bytes.
struct StoreOrigin {
  std::string name;                           ///< file name of the database
  std::string sha256;                         ///< SHA-256 of the file
  std::map<std::string, int> finished;        ///< per protocol
  std::map<std::string, int> failed;          ///< per protocol
  std::map<std::string, std::string> common;  ///< provenance entries common to all finished points
};
StoreOrigin store_origin(const std::filesystem::path& store, std::span<const md::PointRecord> points);

/// Returns the tables [strength] and [[failure]] of a material file verbatim, including comments; those of its base
/// file, if they come from there, without comments.
/// @throws InputError if the file, or its base, cannot be read
std::string strength_and_failure(const std::filesystem::path& material);

/// Returns whether a material file, including its base, has a strength model.
/// @throws InputError as `strength_and_failure`
bool has_strength(const std::filesystem::path& material);

/// Returns the material file from which strength and failure of an element are taken by default: the one named in
/// its table, searched in the library folders. Elements without such an entry give materials without strength.
/// @throws InputError if the file named in the table is missing
std::optional<std::filesystem::path> default_template(const elements::ElementDefaults& table);

/// Returns the text of the complete material file: [eos] with every constant in practical units, followed by its
/// error or the name of its default; [covariance] with the correlations; [provenance]; [defaults]; [strength] and
/// [[failure]] of the template.
/// @param spread  over the potentials of the element: the table [potential_spread]
std::string material_text(const Fit& fit, const StoreOrigin& origin,
                          const std::optional<std::filesystem::path>& template_file,
                          const std::optional<PotentialSpread>& spread = std::nullopt);

/// Writes a file atomically (temporary name, then rename).
/// @throws InputError if it already exists and `force` is false, or if it cannot be written
void write_file(const std::filesystem::path& path, const std::string& text, bool force);

}  // namespace whipple::fit
