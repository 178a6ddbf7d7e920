// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "src/core/base/error_tier.hpp"
#include "src/material/material.hpp"

namespace whipple {

/// Holds materials with constants drawn from the covariance of a fitted material.
struct MaterialSamples {
  std::vector<Material> materials;
  /// Keys and values of each, "eos.gruneisen".
  std::vector<std::vector<std::pair<std::string, std::string>>> changes;
  std::vector<std::string> names;     ///< of the drawn constants
  std::vector<std::string> defaults;  ///< drawn constants that are defaults with the errors of their sources
  std::vector<std::string> unknown;   ///< defaults without a known error, equal in all samples
  int refused = 0;                    ///< draws that define no valid material; each was drawn again
};

/// Returns whether a material is fitted: its file has a table [covariance].
bool has_covariance(const Material& material);

/// Reads the tables [covariance], [default_errors] and [potential_spread] of a material file (names, units, and a row
/// of the matrix for each name; [default_errors] holds an error for each name) and draws its constants from the normal
/// distribution about their values in [eos]. Equal warnings of several draws are combined in one warning with their
/// number.
/// @param tier             errors to include: of the fit (with those of the defaults), over the potentials, or both
/// @param path, beside     as in read_material
/// @param is_asked_to_end  called between two draws; the samples end where it returns true
/// @throws InputError if the file lacks a table that the tier requires, a table is invalid, or four of five draws are
/// refused
MaterialSamples sample_material(
    const std::filesystem::path& path, int count, std::uint64_t seed, ErrorTier tier = ErrorTier::fit,
    const std::filesystem::path& beside = {},
    const std::function<bool()>& is_asked_to_end = [] { return false; });

/// Reads a material file with some keys changed, such as ("eos.gruneisen", "1.9").
/// @throws InputError as read_material
Material read_changed_material(const std::filesystem::path& file,
                               std::span<const std::pair<std::string, std::string>> changes);

}  // namespace whipple
