// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/hdf5/memory_file.hpp"

namespace whipple::hdf5 {
namespace {

herr_t take(void* image, H5FD_file_image_op_t operation, void* memory_file) {
  MemoryFile& file = *static_cast<MemoryFile*>(memory_file);
  if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
    file.bytes.assign(static_cast<const char*>(image), file.wanted);
  return H5free_memory(image);
}

/// Implements copying of property lists; all copies refer to the same file, which they do not own.
void* same(void* memory_file) { return memory_file; }
herr_t leave(void*) { return 0; }

}  // namespace

bool place_in_memory(hid_t access, MemoryFile& file) {
  constexpr std::size_t growth = 4096;  // bytes; the file size is a multiple of this
  H5FD_file_image_callbacks_t callbacks = {nullptr, nullptr, nullptr, take, same, leave, &file};
  return H5Pset_fapl_core(access, growth, /*backing_store=*/0) >= 0 &&
         H5Pset_file_image_callbacks(access, &callbacks) >= 0;
}

}  // namespace whipple::hdf5
