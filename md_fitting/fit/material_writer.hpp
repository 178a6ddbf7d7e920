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

/// Where the points of a fit come from: the [provenance] table. Neither times nor paths, so that the same
/// store gives the same bytes.
struct StoreOrigin {
  std::string name;                           ///< file name of the store
  std::string sha256;                         ///< of the file
  std::map<std::string, int> finished;        ///< per protocol
  std::map<std::string, int> failed;          ///< per protocol
  std::map<std::string, std::string> common;  ///< provenance entries that all finished points share
};
StoreOrigin store_origin(const std::filesystem::path& store, std::span<const md::PointRecord> points);

/// The tables [strength] and [[failure]] of a material file, as they stand there, comments included; those of its base,
/// without comments, where it has one.
/// @throws InputError if the file, or its base, cannot be read
std::string strength_and_failure(const std::filesystem::path& material);

/// Returns whether a material file, with its base, has a model of strength.
/// @throws InputError as `strength_and_failure`
bool has_strength(const std::filesystem::path& material);

/// The material file that strength and failure of an element are taken from by default: that of its table, in the
/// folders of the library. Elements whose table names none have materials without strength.
/// @throws InputError if the file that the table names is missing
std::optional<std::filesystem::path> default_template(const elements::ElementDefaults& table);

/// Text of the complete material file: [eos] with every constant in practical units, its error or the name of
/// its default beside it; [covariance] with the correlations; [provenance]; [defaults]; [strength] and
/// [[failure]] of the template.
/// @param spread  over the potentials of the element: the table [potential_spread]
std::string material_text(const Fit& fit, const StoreOrigin& origin,
                          const std::optional<std::filesystem::path>& template_file,
                          const std::optional<PotentialSpread>& spread = std::nullopt);

/// Writes a file as a whole (temporary name, then renamed).
/// @throws InputError if it is there already and `force` is false, or if it cannot be written
void write_file(const std::filesystem::path& path, const std::string& text, bool force);

}  // namespace whipple::fit
