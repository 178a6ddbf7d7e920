// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/analysis/run.hpp"

/// Makes three-dimensional views of a run for the browser, from its folder alone (docs/manual/output.md).
namespace whipple::view {

/// Holds the options of packing a snapshot.
struct CloudOptions {
  std::vector<std::string> fields;  ///< names from `cloud_fields`; empty: all
  std::uint64_t one_of = 1;         ///< level of detail: one of about this many particles is kept; 1: all
  int bits = 16;                    ///< per value of a field, 8 or 16; positions have 16
};

/// Returns the names of the fields of a snapshot in addition to the body and the number of each particle, in the order
/// of the output fields: the magnitude and the components of the velocity, and every scalar field.
std::vector<std::string> cloud_fields(const analysis::Snapshot& snapshot);

/// Packs a snapshot as a `.wpv` file: header in JSON, then positions in 16 bits, fields in 8 or 16. The particles kept
/// at a level of detail depend only on their numbers, so that the same particles are visible at all times.
/// @throws InputError if a field is unknown, or the snapshot has no particles
std::string pack_cloud(const analysis::Run& run, const analysis::Snapshot& snapshot,
                       const CloudOptions& options);

}  // namespace whipple::view
