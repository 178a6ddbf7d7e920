// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/analysis/run.hpp"

/// Three-dimensional pictures of a run for the browser, made of its folder alone (docs/manual/output.md).
namespace whipple::view {

/// Holds what a packed cloud keeps of a snapshot.
struct CloudOptions {
  std::vector<std::string> fields;  ///< of `cloud_fields`; empty: all
  std::uint64_t one_of = 1;         ///< level of detail: all particles, or about one of so many
  int bits = 16;                    ///< of each value of a field, 8 or 16; positions have 16
};

/// Returns the names of the fields that a snapshot offers beside the body and the number of each particle, in the order
/// of the output fields: the speed and the components of the velocity, and every field of one number.
std::vector<std::string> cloud_fields(const analysis::Snapshot& snapshot);

/// Packs a snapshot as a `.wpv` file: header in JSON, then positions in 16 bits, fields in 8 or 16. Which particles a
/// level of detail keeps depends on their numbers alone, so that one particle is seen through all times.
/// @throws InputError if a field is unknown, or the snapshot has no particles
std::string pack_cloud(const analysis::Run& run, const analysis::Snapshot& snapshot,
                       const CloudOptions& options);

}  // namespace whipple::view
