// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "src/core/hdf5/hdf5.hpp"

/// Chunks of compressed arrays, filtered by zlib on all threads in place of libhdf5 on one: for this folder alone.
namespace whipple::hdf5 {

/// Numbers as they lie in memory.
struct Rows {
  const std::byte* bytes;
  std::size_t width;    ///< of a number
  std::size_t columns;  ///< of numbers
  std::size_t count;
};

/// Writes an array in chunks with shuffle and deflate, as H5Dwrite does.
void write_deflated(const Dataset& dataset, const Rows& rows, std::size_t chunk_rows, int level);

/// No filter of this program shrinks more than deflate can (1032 : 1).
inline constexpr std::uint64_t most_compressed = 1100;

/// What this program's files pass their chunks through.
struct Filters {
  bool shuffle = false, deflate = false, checksum = false;
};

/// The chunks of an array that is to be read. Those of which not as much is stored as a chunk has are refused:
/// libhdf5 1.10 reads beyond the memory of one that skips a filter, or unfolds to less than the declared size.
class Chunks {
 public:
  /// @param space  of the array; must outlive this
  /// @throws InputError for filters that this program does not write
  Chunks(const Dataset& dataset, hid_t space);

  /// Returns whether `read` can: deflated rows of numbers as in memory, without checksums, all of them stored.
  [[nodiscard]] bool are_deflated(hid_t memory_type) const;

  /// Reads the rows of a slab.
  /// @throws InputError for a damaged chunk
  void read(std::byte* values, const Slab& slab) const;

  /// @throws InputError for a damaged chunk
  void require_whole() const;

 private:
  /// Takes the first row of a chunk and its bytes before the filters.
  using Use = std::function<void(std::uint64_t first_row, std::span<const unsigned char> bytes)>;
  void for_each(const Use& use) const;
  /// Returns a chunk before the filters; empty: it is damaged.
  [[nodiscard]] std::vector<unsigned char> unfolded(std::span<const unsigned char> deflated) const;

  const Dataset& dataset_;
  hid_t space_;
  Filters filters_;
  hsize_t lengths_[2] = {1, 1};  ///< rows and columns of a chunk
  hsize_t count_ = 0;
  std::size_t width_ = 0;  ///< of a number
};

}  // namespace whipple::hdf5
