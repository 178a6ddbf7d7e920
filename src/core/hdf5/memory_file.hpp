// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <string>

namespace whipple::hdf5 {

/// Holds the content of a file that exists in memory only. HDF5 returns it when the file is closed.
struct MemoryFile {
  std::size_t wanted = 0;  ///< bytes to be returned
  std::string bytes = {};
};

/// Configures an access property list for a file in memory, which must outlive the open file. @returns whether it
/// succeeded
bool place_in_memory(hid_t access, MemoryFile& file);

}  // namespace whipple::hdf5
