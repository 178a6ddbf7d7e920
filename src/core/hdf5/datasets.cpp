// SPDX-License-Identifier: BSD-3-Clause
// Arrays: shapes, reading and writing.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/hdf5/calls.hpp"
#include "src/core/hdf5/chunks.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::hdf5 {
std::vector<std::uint64_t> Dataset::shape() const {
  const Handle space = checked(H5Dget_space(id()), H5Sclose, name_, "read the shape");
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> lengths(static_cast<std::size_t>(std::max(dimensions, 0)));
  check(H5Sget_simple_extent_dims(space.get(), lengths.data(), nullptr), name_, "read the shape");
  return {lengths.begin(), lengths.end()};
}

Dataset::Shape Dataset::stored_shape() const {
  // libhdf5 1.10 reads beyond the memory of compact arrays that are shorter than declared.
  const Handle creation = checked(H5Dget_create_plist(id()), H5Pclose, name_, "read the layout");
  const std::uint64_t greatest_compression =
      H5Pget_layout(creation.get()) == H5D_CHUNKED ? most_compressed : 1;
  const std::vector<std::uint64_t> lengths = shape();
  if (lengths.size() > 2) throw InputError(fmt::format("{}: has {} dimensions", name_, lengths.size()));
  const Shape shape{lengths.empty() ? 1 : lengths[0], lengths.size() < 2 ? 1 : lengths[1]};
  const std::uint64_t stored = H5Dget_storage_size(id());
  if (stored == 0 && H5Eget_num(H5E_DEFAULT) > 0) fail(name_, "read the size");
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
                         std::uint64_t columns) const {
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
  const Chunks chunks(*this, space.get());
  if (chunks.are_deflated(memory_type)) {
    chunks.read(static_cast<std::byte*>(values), slab);
    return;
  }
  chunks.require_whole();
  const Handle memory = select(space.get(), slab, columns, dimensions == 1, name_);
  check(H5Dread(id(), memory_type, memory.get(), space.get(), H5P_DEFAULT, values), name_, "read");
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
                  where, writers_);
  if (slab.total == 0) return dataset;
  const auto write_rows = [&](std::uint64_t first, std::uint64_t count, const void* rows) {
    const Handle memory = select(space.get(), {first, count, slab.total}, columns, one_dimensional, where);
    check(H5Dwrite(dataset.id(), memory_type, memory.get(), space.get(), H5P_DEFAULT, rows), where, "write");
  };
  if (writers_) {
    const std::size_t row_size = columns * H5Tget_size(memory_type);
    const std::span own(static_cast<const std::byte*>(values), slab.count * row_size);
    parallel::gather_rows(*writers_, {own, slab.first, row_size}, storage.chunk_rows,
                          [&](std::size_t first, std::span<const std::byte> rows) {
                            write_rows(first, rows.size() / row_size, rows.data());
                          });
    return dataset;
  }
  if (slab.count == slab.total && storage.deflate >= 0 && !storage.fletcher32 &&
      H5Tequal(memory_type, file_type) > 0) {
    write_deflated(dataset,
                   {static_cast<const std::byte*>(values), H5Tget_size(memory_type), columns, slab.count},
                   std::min<std::size_t>(slab.total, storage.chunk_rows), storage.deflate);
    return dataset;
  }
  write_rows(slab.first, slab.count, values);
  return dataset;
}

}  // namespace whipple::hdf5
