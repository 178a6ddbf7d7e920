// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <string>

namespace whipple::hdf5 {

/// A file that has no other place than memory. HDF5 hands its content over when it closes it.
struct MemoryFile {
  std::size_t wanted = 0;  ///< bytes to be handed over
  std::string bytes = {};
};

/// Lets an access property list mean a file in memory, which must outlive the open file. @returns whether HDF5 could
bool place_in_memory(hid_t access, MemoryFile& file);

}  // namespace whipple::hdf5
