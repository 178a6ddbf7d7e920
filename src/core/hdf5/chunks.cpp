// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/hdf5/chunks.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/hdf5/calls.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::hdf5 {
namespace {

constexpr std::size_t together = 32;  ///< number of chunks in memory at a time

/// Returns a chunk as filtered by HDF5: the first bytes of all numbers, then the second ones and so on, deflated.
/// Chunks are stored completely, padded with 0 beyond the last row.
/// @returns nothing if zlib fails
std::vector<Bytef> deflated(const Rows& rows, std::size_t first, std::size_t chunk_rows, int level) {
  const std::size_t numbers = chunk_rows * rows.columns;
  const std::size_t present = std::min(chunk_rows, rows.count - first) * rows.columns;
  std::vector<Bytef> shuffled(numbers * rows.width);
  const std::byte* from = rows.bytes + first * rows.columns * rows.width;
  for (std::size_t b = 0; b < rows.width; ++b) {
    for (std::size_t i = 0; i < present; ++i) {
      shuffled[b * numbers + i] = static_cast<Bytef>(from[i * rows.width + b]);
    }
  }
  uLongf size = compressBound(shuffled.size());
  std::vector<Bytef> chunk(size);
  if (compress2(chunk.data(), &size, shuffled.data(), shuffled.size(), level) != Z_OK) return {};
  chunk.resize(size);
  return chunk;
}

/// Returns the filters of an array. @throws InputError if there are others, or they are in another order
Filters filters_of(hid_t creation, const std::string& name) {
  Filters filters;
  const int count = H5Pget_nfilters(creation);
  H5Z_filter_t last = H5Z_FILTER_NONE;
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, nullptr);
    const bool known =
        filter == H5Z_FILTER_SHUFFLE || filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_FLETCHER32;
    const bool in_order = last == H5Z_FILTER_NONE || (last == H5Z_FILTER_SHUFFLE && filter != last) ||
                          (last == H5Z_FILTER_DEFLATE && filter == H5Z_FILTER_FLETCHER32);
    if (!known || !in_order)
      throw InputError(fmt::format("{}: filter {} is none that this program writes", name, filter));
    filters.shuffle = filters.shuffle || filter == H5Z_FILTER_SHUFFLE;
    filters.deflate = filters.deflate || filter == H5Z_FILTER_DEFLATE;
    filters.checksum = filter == H5Z_FILTER_FLETCHER32;
    last = filter;
  }
  return filters;
}

}  // namespace

void write_deflated(const Dataset& dataset, const Rows& rows, std::size_t chunk_rows, int level) {
  const std::size_t chunks = (rows.count + chunk_rows - 1) / chunk_rows;
  for (std::size_t first = 0; first < chunks; first += together) {
    std::vector<std::vector<Bytef>> part(std::min(together, chunks - first));
    parallel::for_each_uneven(part.size(), [&](std::size_t c) {
      part[c] = deflated(rows, (first + c) * chunk_rows, chunk_rows, level);
    });
    for (std::size_t c = 0; c < part.size(); ++c) {
      const hsize_t offset[2] = {(first + c) * chunk_rows, 0};
      if (part[c].empty()) throw std::bad_alloc();  // the only possible zlib error
      check(H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, offset, part[c].size(), part[c].data()),
            dataset.name(), "write");
    }
  }
}

Chunks::Chunks(const Dataset& dataset, hid_t space) : dataset_(dataset), space_(space) {
  const std::string& name = dataset.name();
  const Handle creation = checked(H5Dget_create_plist(dataset.id()), H5Pclose, name, "read the layout");
  if (H5Pget_layout(creation.get()) != H5D_CHUNKED) return;
  filters_ = filters_of(creation.get(), name);
  const Handle type = checked(H5Dget_type(dataset.id()), H5Tclose, name, "read the type");
  width_ = H5Tget_size(type.get());
  constexpr double most_bytes = 4294967295.0;  // limit of HDF5 for a chunk
  if (H5Pget_chunk(creation.get(), 2, lengths_) < 1 || lengths_[0] == 0 || lengths_[1] == 0 ||
      static_cast<double>(lengths_[0]) * static_cast<double>(lengths_[1]) * static_cast<double>(width_) >
          most_bytes) {
    throw InputError(name + ": has chunks of no possible size");
  }
  check(H5Dget_num_chunks(dataset.id(), space, &count_), name, "count the chunks");
}

bool Chunks::are_deflated(hid_t memory_type) const {
  if (!filters_.deflate || filters_.checksum) return false;
  const Handle type = checked(H5Dget_type(dataset_.id()), H5Tclose, dataset_.name(), "read the type");
  const std::vector<std::uint64_t> shape = dataset_.shape();
  const std::uint64_t columns = shape.size() < 2 ? 1 : shape[1];
  return H5Tequal(type.get(), memory_type) > 0 && lengths_[1] == columns &&
         count_ == (shape[0] + lengths_[0] - 1) / lengths_[0];
}

void Chunks::read(std::byte* values, const Slab& slab) const {
  const std::size_t in_row = lengths_[1], numbers = lengths_[0] * in_row;
  for_each([&](std::uint64_t first_row, std::span<const unsigned char> bytes) {
    const std::uint64_t begin = std::max(first_row, slab.first),
                        end = std::min<std::uint64_t>(first_row + lengths_[0], slab.first + slab.count);
    if (begin >= end) return;
    const std::size_t from = (begin - first_row) * in_row, n = (end - begin) * in_row;
    std::byte* const to = values + (begin - slab.first) * in_row * width_;
    if (!filters_.shuffle) {
      std::memcpy(to, bytes.data() + from * width_, n * width_);
      return;
    }
    for (std::size_t b = 0; b < width_; ++b) {
      for (std::size_t i = 0; i < n; ++i) to[i * width_ + b] = std::byte{bytes[b * numbers + from + i]};
    }
  });
}

void Chunks::require_whole() const {
  for_each([](std::uint64_t, std::span<const unsigned char>) {});
}

std::vector<unsigned char> Chunks::unfolded(std::span<const unsigned char> deflated) const {
  const std::size_t size = lengths_[0] * lengths_[1] * width_;
  if (size > most_compressed * deflated.size()) return {};
  std::vector<unsigned char> chunk(size);
  uLongf inflated = size;
  if (uncompress(chunk.data(), &inflated, deflated.data(), deflated.size()) != Z_OK || inflated != size)
    return {};
  return chunk;
}

void Chunks::for_each(const Use& use) const {
  const std::string& name = dataset_.name();
  const std::uint64_t of_file = file_size(dataset_), size = lengths_[0] * lengths_[1] * width_;
  const hsize_t sum = filters_.checksum ? 4 : 0;
  std::set<std::pair<hsize_t, hsize_t>> begun;  // rows and columns where chunks begin, without duplicates
  for (hsize_t first = 0; first < count_; first += together) {
    std::vector<std::vector<unsigned char>> part(std::min<hsize_t>(together, count_ - first));
    std::vector<std::uint64_t> first_row(part.size());
    std::vector<std::uint8_t> whole(part.size());
    for (std::size_t c = 0; c < part.size(); ++c) {
      hsize_t offset[2] = {0, 0}, stored = 0;
      unsigned skipped = 0;
      haddr_t address = 0;
      check(H5Dget_chunk_info(dataset_.id(), space_, first + c, offset, &skipped, &address, &stored), name,
            "find a chunk");
      first_row[c] = offset[0];
      const bool once = begun.emplace(offset[0], offset[1]).second && offset[0] % lengths_[0] == 0;
      if (!once || skipped != 0 || stored < sum || stored > of_file) continue;
      whole[c] = filters_.deflate || stored - sum == size ? 1 : 0;
      if (!filters_.deflate) continue;
      part[c].resize(stored);
      check(H5Dread_chunk(dataset_.id(), H5P_DEFAULT, offset, &skipped, part[c].data()), name,
            "read a chunk");
      part[c].resize(stored - sum);
    }
    parallel::for_each_uneven(part.size(), [&](std::size_t c) {
      if (!filters_.deflate || whole[c] == 0) return;
      const std::vector<unsigned char> bytes = unfolded(part[c]);
      whole[c] = bytes.empty() ? 0 : 1;
      if (whole[c] != 0) use(first_row[c], bytes);
    });
    const auto damaged = std::ranges::find(whole, 0);
    if (damaged == whole.end()) continue;
    throw InputError(fmt::format("{}: chunk {} is no whole chunk of {} bytes: the file is damaged", name,
                                 first + static_cast<hsize_t>(damaged - whole.begin()), size));
  }
}

}  // namespace whipple::hdf5
