// SPDX-License-Identifier: BSD-3-Clause
// Arrays: their shapes, reading, and writing with compression on all threads.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/hdf5/calls.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::hdf5 {
namespace {

/// Numbers as they lie in memory.
struct Rows {
  const std::byte* bytes;
  std::size_t width;    ///< of a number
  std::size_t columns;  ///< of numbers
  std::size_t count;
};

/// A chunk as HDF5's filters leave it: the first bytes of all numbers, then the second ones and so on,
/// deflated. Chunks are stored as a whole: 0 is what lies beyond the last row.
/// @returns nothing if zlib refuses
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

/// Writes an array in chunks with shuffle and deflate on all threads, as H5Dwrite does on one.
void write_deflated(const Dataset& dataset, const Rows& rows, std::size_t chunk_rows, int level) {
  constexpr std::size_t together = 32;  // chunks in memory
  const std::size_t chunks = (rows.count + chunk_rows - 1) / chunk_rows;
  for (std::size_t first = 0; first < chunks; first += together) {
    std::vector<std::vector<Bytef>> part(std::min(together, chunks - first));
    parallel::for_each_uneven(part.size(), [&](std::size_t c) {
      part[c] = deflated(rows, (first + c) * chunk_rows, chunk_rows, level);
    });
    for (std::size_t c = 0; c < part.size(); ++c) {
      const hsize_t offset[2] = {(first + c) * chunk_rows, 0};
      if (part[c].empty()) throw std::bad_alloc();  // zlib knows no other reason
      check(H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, offset, part[c].size(), part[c].data()),
            dataset.name(), "write");
    }
  }
}

/// No filter of this program shrinks more than deflate can (1032 : 1).
constexpr std::uint64_t most_compressed = 1100;

/// What this program's files pass their chunks through.
struct Filters {
  bool deflate = false, checksum = false;
};

/// @throws InputError if there are others, or these in another order
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
    filters.deflate = filters.deflate || filter == H5Z_FILTER_DEFLATE;
    filters.checksum = filter == H5Z_FILTER_FLETCHER32;
    last = filter;
  }
  return filters;
}

/// Returns whether deflated bytes are a chunk of this size.
bool inflates_to(std::size_t size, std::span<const Bytef> deflated) {
  if (size > most_compressed * deflated.size()) return false;
  std::vector<Bytef> chunk(size);
  uLongf inflated = size;
  return uncompress(chunk.data(), &inflated, deflated.data(), deflated.size()) == Z_OK && inflated == size;
}

/// Refuses chunks of which not as much is stored as a chunk has: libhdf5 1.10 reads beyond the memory of one
/// that skips a filter, or unfolds to less than the declared size.
void require_whole_chunks(const Dataset& dataset, hid_t space) {
  const std::string& name = dataset.name();
  const Handle creation = checked(H5Dget_create_plist(dataset.id()), H5Pclose, name, "read the layout");
  if (H5Pget_layout(creation.get()) != H5D_CHUNKED) return;
  const Filters filters = filters_of(creation.get(), name);
  const Handle type = checked(H5Dget_type(dataset.id()), H5Tclose, name, "read the type");
  hsize_t lengths[2] = {1, 1}, chunks = 0;
  if (H5Pget_chunk(creation.get(), 2, lengths) < 1) throw InputError(name + ": has chunks without a size");
  const hsize_t size = lengths[0] * lengths[1] * H5Tget_size(type.get());
  check(H5Dget_num_chunks(dataset.id(), space, &chunks), name, "count the chunks");
  const std::uint64_t of_file = file_size(dataset);
  constexpr hsize_t together = 32;  // chunks in memory
  for (hsize_t first = 0; first < chunks; first += together) {
    std::vector<std::vector<Bytef>> part(std::min(together, chunks - first));
    std::vector<std::uint8_t> whole(part.size());
    for (std::size_t c = 0; c < part.size(); ++c) {
      hsize_t offset[2] = {0, 0}, stored = 0;
      unsigned skipped = 0;
      haddr_t address = 0;
      check(H5Dget_chunk_info(dataset.id(), space, first + c, offset, &skipped, &address, &stored), name,
            "find a chunk");
      const hsize_t sum = filters.checksum ? 4 : 0;
      if (skipped != 0 || stored < sum || stored > of_file) continue;
      whole[c] = filters.deflate || stored - sum == size ? 1 : 0;
      if (!filters.deflate) continue;
      part[c].resize(stored);
      check(H5Dread_chunk(dataset.id(), H5P_DEFAULT, offset, &skipped, part[c].data()), name, "read a chunk");
      part[c].resize(stored - sum);
    }
    parallel::for_each_uneven(part.size(), [&](std::size_t c) {
      if (filters.deflate && whole[c] != 0) whole[c] = inflates_to(size, part[c]) ? 1 : 0;
    });
    const auto damaged = std::ranges::find(whole, 0);
    if (damaged == whole.end()) continue;
    throw InputError(fmt::format("{}: chunk {} is no whole chunk of {} bytes: the file is damaged", name,
                                 first + static_cast<hsize_t>(damaged - whole.begin()), size));
  }
}

}  // namespace

std::vector<std::uint64_t> Dataset::shape() const {
  const Handle space = checked(H5Dget_space(id()), H5Sclose, name_, "read the shape");
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> lengths(static_cast<std::size_t>(std::max(dimensions, 0)));
  check(H5Sget_simple_extent_dims(space.get(), lengths.data(), nullptr), name_, "read the shape");
  return {lengths.begin(), lengths.end()};
}

Dataset::Shape Dataset::stored_shape() const {
  // libhdf5 1.10 reads beyond the memory of compact arrays that are shorter than they declare.
  const Handle creation = checked(H5Dget_create_plist(id()), H5Pclose, name_, "read the layout");
  const std::uint64_t greatest_compression =
      H5Pget_layout(creation.get()) == H5D_CHUNKED ? most_compressed : 1;
  const std::vector<std::uint64_t> lengths = shape();
  if (lengths.size() > 2) throw InputError(fmt::format("{}: has {} dimensions", name_, lengths.size()));
  const Shape shape{lengths.empty() ? 1 : lengths[0], lengths.size() < 2 ? 1 : lengths[1]};
  const std::uint64_t stored = H5Dget_storage_size(id());
  const Handle type = checked(H5Dget_type(id()), H5Tclose, name_, "read the type");
  const double declared = static_cast<double>(shape.rows) * static_cast<double>(shape.columns) *
                          static_cast<double>(H5Tget_size(type.get()));
  if (stored > file_size(*this) || declared > static_cast<double>(greatest_compression * stored)) {
    throw InputError(
        fmt::format("{}: is declared to have {} rows of {} numbers, which the file does not hold", name_,
                    shape.rows, shape.columns));
  }
  return shape;
}

bool Dataset::has_type(hid_t memory_type) const {
  const Handle type = checked(H5Dget_type(id()), H5Tclose, name_, "read the type");
  return H5Tget_class(type.get()) == H5Tget_class(memory_type) &&
         H5Tget_size(type.get()) == H5Tget_size(memory_type);
}

void Dataset::require_shape(const Shape& expected) const {
  const Shape found = stored_shape();
  if (found.rows == expected.rows && (found.rows == 0 || found.columns == expected.columns)) return;
  throw InputError(fmt::format("{}: has {} rows of {} numbers, expected {} rows of {}", name_, found.rows,
                               found.columns, expected.rows, expected.columns));
}

void Dataset::read_bytes(void* values, hid_t memory_type, std::uint64_t size, const Slab& slab,
                         std::uint64_t columns, bool collective) const {
  require_shape({slab.total, columns});
  if (size != slab.count * columns) throw InternalError(name_ + ": the room for the rows has another size");
  if (!has_type(memory_type)) {
    throw InputError(fmt::format("{}: has numbers of another type than expected", name_));
  }
  if (slab.total == 0) return;
  const Handle space = checked(H5Dget_space(id()), H5Sclose, name_, "read the shape");
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  if (dimensions == 0) {
    check(H5Dread(id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name_, "read");
    return;
  }
  require_whole_chunks(*this, space.get());
  const Handle memory = select(space.get(), slab, columns, dimensions == 1, name_);
  const Handle transfer = transfer_properties(collective, name_);
  check(H5Dread(id(), memory_type, memory.get(), space.get(), transfer.get(), values), name_, "read");
}

Dataset Group::write_bytes(const std::string& name, const void* values, hid_t memory_type, hid_t file_type,
                           std::uint64_t size, const Slab& slab, const Storage& storage) const {
  const std::string where = name_ + name;
  const bool one_dimensional = storage.columns == 0;
  const std::uint64_t columns = one_dimensional ? 1 : storage.columns;
  if (size != slab.count * columns)
    throw InternalError(where + ": the number of values is not rows times columns");

  const hsize_t lengths[2] = {slab.total, columns};
  const int dimensions = one_dimensional ? 1 : 2;
  const Handle space =
      checked(H5Screate_simple(dimensions, lengths, nullptr), H5Sclose, where, "describe the array");
  const Handle creation = creation_properties(H5P_DATASET_CREATE, where);
  if (slab.total > 0 && (storage.deflate >= 0 || storage.fletcher32)) {
    const hsize_t chunk[2] = {std::min<hsize_t>(slab.total, storage.chunk_rows), columns};
    check(H5Pset_chunk(creation.get(), dimensions, chunk), where, "prepare chunks");
    if (storage.deflate >= 0) {
      check(H5Pset_shuffle(creation.get()), where, "prepare compression");
      check(H5Pset_deflate(creation.get(), static_cast<unsigned>(storage.deflate)), where,
            "prepare compression");
    }
    if (storage.fletcher32) check(H5Pset_fletcher32(creation.get()), where, "prepare checksums");
  }
  Dataset dataset(checked(H5Dcreate2(id(), name.c_str(), file_type, space.get(), H5P_DEFAULT, creation.get(),
                                     H5P_DEFAULT),
                          H5Dclose, where, "create the array"),
                  where, collective_);
  if (slab.total == 0)
    return dataset;  // nothing has an address: a collective transfer of it fails in HDF5 1.10
  const bool here = !collective_ && slab.count == slab.total;
  if (here && storage.deflate >= 0 && !storage.fletcher32 && H5Tequal(memory_type, file_type) > 0) {
    write_deflated(dataset,
                   {static_cast<const std::byte*>(values), H5Tget_size(memory_type), columns, slab.count},
                   std::min<std::size_t>(slab.total, storage.chunk_rows), storage.deflate);
    return dataset;
  }
  const Handle memory = select(space.get(), slab, columns, one_dimensional, where);
  const Handle transfer = transfer_properties(collective_, where);
  check(H5Dwrite(dataset.id(), memory_type, memory.get(), space.get(), transfer.get(), values), where,
        "write");
  return dataset;
}

}  // namespace whipple::hdf5
