// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "src/core/hdf5/hdf5.hpp"

/// Chunks of compressed arrays, filtered by zlib on all threads instead of by libhdf5 on one; for use in this folder
/// only.
namespace whipple::hdf5 {

/// Describes rows of numbers in memory.
struct Rows {
  const std::byte* bytes;
  std::size_t width;    ///< bytes of a number
  std::size_t columns;  ///< numbers per row
  std::size_t count;
};

/// Writes an array in chunks with shuffle and deflate, like H5Dwrite.
void write_deflated(const Dataset& dataset, const Rows& rows, std::size_t chunk_rows, int level);

/// Bounds the compression ratio: no filter of this program exceeds that of deflate (1032 : 1).
inline constexpr std::uint64_t most_compressed = 1100;

/// Describes the filters that files of this program use.
struct Filters {
  bool shuffle = false, deflate = false, checksum = false;
};

/// Accesses the chunks of an array to be read. Chunks with less stored data than a complete chunk are rejected: libhdf5
/// 1.10 reads beyond the allocated memory if a chunk skips a filter, or decompresses to less than the declared size.
class Chunks {
 public:
  /// Reads the layout of the chunks.
  /// @param space  of the array; must outlive this object
  /// @throws InputError for filters that this program does not write
  Chunks(const Dataset& dataset, hid_t space);

  /// Returns whether `read` is applicable: deflated rows of numbers in the memory type, without checksums, all stored.
  [[nodiscard]] bool are_deflated(hid_t memory_type) const;

  /// Reads the rows of a slab.
  /// @throws InputError for a damaged chunk
  void read(std::byte* values, const Slab& slab) const;

  /// Checks all chunks. @throws InputError for a damaged chunk
  void require_whole() const;

 private:
  /// Consumes the first row of a chunk and its unfiltered bytes.
  using Use = std::function<void(std::uint64_t first_row, std::span<const unsigned char> bytes)>;
  void for_each(const Use& use) const;
  /// Returns the unfiltered bytes of a chunk; empty if it is damaged.
  [[nodiscard]] std::vector<unsigned char> unfolded(std::span<const unsigned char> deflated) const;

  const Dataset& dataset_;
  hid_t space_;
  Filters filters_;
  hsize_t lengths_[2] = {1, 1};  ///< rows and columns of a chunk
  hsize_t count_ = 0;
  std::size_t width_ = 0;  ///< of a number, bytes
};

}  // namespace whipple::hdf5
