// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/hdf5/hdf5.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::hdf5 {
namespace {

/// HDF5's own printing goes to standard error in twenty lines; the innermost of them is what a user can use.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

herr_t keep_innermost(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr && error->desc[0] != '\0') *static_cast<std::string*>(text) = error->desc;
  return 0;
}

[[noreturn]] void fail(const std::string& where, const std::string& action) {
  std::string innermost;
  // Walking downward begins with the function that was called and ends with the one that failed.
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &innermost);
  H5Eclear2(H5E_DEFAULT);
  // "file write failed: time = ..., errno = 28, error message = 'No space left on device', buf = ...": the
  // reason that the system gave is what can be used.
  constexpr std::string_view key = "error message = '";
  if (const std::size_t at = innermost.find(key); at != std::string::npos) {
    const std::size_t begin = at + key.size();
    innermost = innermost.substr(begin, innermost.find('\'', begin) - begin);
  }
  throw InputError(fmt::format("{}: cannot {}{}", where, action, innermost.empty() ? "" : ": " + innermost));
}

Handle checked(hid_t id, Handle::Close close, const std::string& where, const std::string& action) {
  if (id < 0) fail(where, action);
  return {id, close};
}

void check(herr_t status, const std::string& where, const std::string& action) {
  if (status < 0) fail(where, action);
}

/// Properties for a new object. No time stamps: equal content shall give equal files.
Handle creation_properties(hid_t kind, const std::string& where) {
  Handle properties = checked(H5Pcreate(kind), H5Pclose, where, "prepare an object");
  check(H5Pset_obj_track_times(properties.get(), false), where, "prepare an object");
  return properties;
}

Handle transfer_properties(bool collective, const std::string& where) {
  Handle properties = checked(H5Pcreate(H5P_DATASET_XFER), H5Pclose, where, "prepare a transfer");
  if (collective) {
    check(H5Pset_dxpl_mpio(properties.get(), H5FD_MPIO_COLLECTIVE), where, "prepare a collective transfer");
  }
  return properties;
}

/// Selects the rows of a slab in a file space; returns the space of the memory.
Handle select(hid_t space, const Slab& slab, std::uint64_t columns, bool one_dimensional,
              const std::string& where) {
  const hsize_t start[2] = {slab.first, 0};
  const hsize_t count[2] = {slab.count, one_dimensional ? 1 : columns};
  const int dimensions = one_dimensional ? 1 : 2;
  Handle memory = checked(H5Screate_simple(dimensions, count, nullptr), H5Sclose, where, "describe memory");
  if (slab.count == 0) {
    check(H5Sselect_none(space), where, "select nothing");
    check(H5Sselect_none(memory.get()), where, "select nothing");
  } else {
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr), where,
          fmt::format("select rows {} to {}", slab.first, slab.first + slab.count));
  }
  return memory;
}

void write_attribute(const Object& object, const std::string& name, hid_t type, hid_t memory_type,
                     hid_t space, const void* value) {
  const std::string action = "write attribute " + name;
  const Handle attribute =
      checked(H5Acreate2(object.id(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
              object.name(), action);
  check(H5Awrite(attribute.get(), memory_type, value), object.name(), action);
}

Handle open_attribute(const Object& object, const std::string& name) {
  return checked(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose, object.name(),
                 "read attribute " + name);
}

/// Bytes of the file that an object lies in.
std::uint64_t file_size(const Object& object) {
  const Handle file = checked(H5Iget_file_id(object.id()), H5Fclose, object.name(), "find the file");
  hsize_t size = 0;
  check(H5Fget_filesize(file.get(), &size), object.name(), "ask for the size of the file");
  return size;
}

void read_number(const Object& object, const std::string& name, H5T_class_t expected, hid_t memory_type,
                 void* value) {
  const Handle attribute = open_attribute(object, name);
  const std::string action = "read attribute " + name;
  const Handle type = checked(H5Aget_type(attribute.get()), H5Tclose, object.name(), action);
  const Handle space = checked(H5Aget_space(attribute.get()), H5Sclose, object.name(), action);
  if (H5Tget_class(type.get()) != expected || H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw InputError(
        fmt::format("{}: attribute {} is not a single number of the expected kind", object.name(), name));
  }
  check(H5Aread(attribute.get(), memory_type, value), object.name(), action);
}

}  // namespace

Handle::Handle(Handle&& other) noexcept
    : id_(std::exchange(other.id_, -1)), close_(std::exchange(other.close_, nullptr)) {}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, -1);
    close_ = std::exchange(other.close_, nullptr);
  }
  return *this;
}

bool Handle::reset() noexcept {
  const hid_t id = std::exchange(id_, -1);
  return id < 0 || close_ == nullptr || close_(id) >= 0;
}

// ---- attributes ----

void Object::set_attribute(const std::string& name, std::int64_t value) const {
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a number");
  write_attribute(*this, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space.get(), &value);
}

void Object::set_attribute(const std::string& name, double value) const {
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a number");
  write_attribute(*this, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space.get(), &value);
}

void Object::set_attribute(const std::string& name, std::span<const std::int64_t> values) const {
  const hsize_t size = values.size();
  const Handle space = checked(H5Screate_simple(1, &size, nullptr), H5Sclose, name_, "describe numbers");
  write_attribute(*this, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space.get(), values.data());
}

void Object::set_attribute(const std::string& name, std::string_view text) const {
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, name_, "describe a text");
  check(H5Tset_size(type.get(), H5T_VARIABLE), name_, "describe a text");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), name_, "describe a text");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a text");
  const std::string terminated(text);
  const char* pointer = terminated.c_str();
  write_attribute(*this, name, type.get(), type.get(), space.get(), &pointer);
}

void Object::set_fixed_attribute(const std::string& name, std::string_view text,
                                 Characters characters) const {
  const std::string bytes = text.empty() ? std::string(1, '\0') : std::string(text);
  const Handle type = checked(H5Tcopy(H5T_C_S1), H5Tclose, name_, "describe a text");
  check(H5Tset_size(type.get(), bytes.size()), name_, "describe a text");
  check(H5Tset_cset(type.get(), characters == Characters::utf8 ? H5T_CSET_UTF8 : H5T_CSET_ASCII), name_,
        "describe a text");
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), name_, "describe a text");
  const Handle space = checked(H5Screate(H5S_SCALAR), H5Sclose, name_, "describe a text");
  write_attribute(*this, name, type.get(), type.get(), space.get(), bytes.data());
}

bool Object::has_attribute(const std::string& name) const {
  const htri_t found = H5Aexists(id(), name.c_str());
  if (found < 0) fail(name_, "look for attribute " + name);
  return found > 0;
}

std::vector<std::string> Object::attribute_names() const {
  std::vector<std::string> names;
  hsize_t index = 0;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Aiterate2(id(), H5_INDEX_NAME, H5_ITER_NATIVE, &index, add, &names), name_, "list the attributes");
  std::ranges::sort(names);
  return names;
}

std::int64_t Object::integer_attribute(const std::string& name) const {
  std::int64_t value = 0;
  read_number(*this, name, H5T_INTEGER, H5T_NATIVE_INT64, &value);
  return value;
}

double Object::real_attribute(const std::string& name) const {
  double value = 0.0;
  read_number(*this, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::string Object::text_attribute(const std::string& name) const {
  const Handle attribute = open_attribute(*this, name);
  const std::string action = "read attribute " + name;
  const Handle type = checked(H5Aget_type(attribute.get()), H5Tclose, name_, action);
  if (H5Tget_class(type.get()) != H5T_STRING) {
    throw InputError(fmt::format("{}: attribute {} is not a text", name_, name));
  }
  if (H5Tis_variable_str(type.get()) != 0) {
    throw InputError(fmt::format(
        "{}: attribute {} is a text of variable length, as earlier versions wrote it; expected one of fixed length",
        name_, name));
  }
  const std::size_t size = H5Tget_size(type.get());
  const Handle space = checked(H5Aget_space(attribute.get()), H5Sclose, name_, action);
  if (size > file_size(*this) || H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw InputError(fmt::format("{}: attribute {} is not a single text that the file could hold", name_, name));
  }
  std::string text(size, '\0');
  check(H5Aread(attribute.get(), type.get(), text.data()), name_, action);
  return text.substr(0, text.find('\0'));
}

// ---- data sets ----

std::vector<std::uint64_t> Dataset::shape() const {
  const Handle space = checked(H5Dget_space(id()), H5Sclose, name_, "read the shape");
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> lengths(static_cast<std::size_t>(std::max(dimensions, 0)));
  check(H5Sget_simple_extent_dims(space.get(), lengths.data(), nullptr), name_, "read the shape");
  return {lengths.begin(), lengths.end()};
}

Dataset::Shape Dataset::stored_shape() const {
  // No filter of this program shrinks more than deflate can (1032 : 1).
  constexpr std::uint64_t greatest_compression = 1100;
  const std::vector<std::uint64_t> lengths = shape();
  if (lengths.size() > 2) throw InputError(fmt::format("{}: has {} dimensions", name_, lengths.size()));
  const Shape shape{lengths.empty() ? 1 : lengths[0], lengths.size() < 2 ? 1 : lengths[1]};
  const std::uint64_t stored = H5Dget_storage_size(id());
  const Handle type = checked(H5Dget_type(id()), H5Tclose, name_, "read the type");
  const double declared = static_cast<double>(shape.rows) * static_cast<double>(shape.columns) *
                          static_cast<double>(H5Tget_size(type.get()));
  if (stored > file_size(*this) || declared > static_cast<double>(greatest_compression * stored)) {
    throw InputError(fmt::format("{}: is declared to have {} rows of {} numbers, which the file does not hold",
                                 name_, shape.rows, shape.columns));
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
  const Handle memory = select(space.get(), slab, columns, dimensions == 1, name_);
  const Handle transfer = transfer_properties(collective, name_);
  check(H5Dread(id(), memory_type, memory.get(), space.get(), transfer.get(), values), name_, "read");
}

// ---- groups ----

Group Group::create_group(const std::string& name, Order order) const {
  const std::string action = "create group " + name;
  const Handle creation = creation_properties(H5P_GROUP_CREATE, name_);
  if (order == Order::creation) {
    check(H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), name_,
          action);
    // Many short attributes without an index.
    check(H5Pset_attr_phase_change(creation.get(), 256, 128), name_, action);
  }
  return {checked(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose, name_,
                  action),
          name_ + name + "/", collective_};
}

Group Group::open_group(const std::string& name) const {
  return {checked(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose, name_, "open group " + name),
          name_ + name + "/", collective_};
}

Dataset Group::open_dataset(const std::string& name) const {
  return {checked(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose, name_, "open data set " + name),
          name_ + name, collective_};
}

bool Group::has(const std::string& name) const { return H5Lexists(id(), name.c_str(), H5P_DEFAULT) > 0; }

std::vector<std::string> Group::names(Order order) const {
  std::vector<std::string> names;
  hsize_t index = 0;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  // HDF5 1.10 sorts in a table of its own, which it frees unfilled, and dies, where the group is damaged.
  const bool by_creation = order == Order::creation;
  check(H5Literate(id(), by_creation ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME,
                   by_creation ? H5_ITER_INC : H5_ITER_NATIVE, &index, add, &names),
        name_, "list the group");
  if (!by_creation) std::ranges::sort(names);
  return names;
}

void Group::remove(const std::string& name) const {
  check(H5Ldelete(id(), name.c_str(), H5P_DEFAULT), name_, "remove " + name);
}

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

}  // namespace

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

// ---- files ----

namespace {

Handle access_properties(std::optional<MPI_Comm> communicator, const std::string& path) {
  Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "prepare the file");
  if (communicator) {
    check(H5Pset_fapl_mpio(access.get(), *communicator, MPI_INFO_NULL), path, "prepare parallel access");
  }
  // An object that somebody forgot to close would otherwise keep the file open, and unflushed, in silence.
  check(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), path, "prepare the file");
  return access;
}

/// Finds out whether there is memory to open a file: HDF5 1.10 crashes where it gets none for its cache (0.7 MB).
/// @throws std::bad_alloc if there is none
void require_memory() {
  constexpr std::size_t needed = 8 << 20;  // bytes
  void* const room = ::mmap(nullptr, needed, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  ::munmap(room, needed);
}

Handle root_group(const Handle& file, const std::string& path) {
  return checked(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose, path, "open the root group");
}

H5F_libver_t oldest_format(File::Compatibility compatibility) {
  switch (compatibility) {
    case File::Compatibility::compact:
      return H5F_LIBVER_V18;
    case File::Compatibility::vtk:
      return H5F_LIBVER_EARLIEST;
    default:
      return H5F_LIBVER_V110;
  }
}

}  // namespace

File File::create(const std::filesystem::path& path, Compatibility compatibility, std::uint64_t user_block,
                  std::optional<MPI_Comm> communicator) {
  require_memory();
  silence();
  const std::string text = path.string();
  const Handle access = access_properties(communicator, text);
  check(H5Pset_libver_bounds(access.get(), oldest_format(compatibility), H5F_LIBVER_V110), text,
        "choose the format version");
  const Handle creation = creation_properties(H5P_FILE_CREATE, text);
  check(H5Pset_userblock(creation.get(), user_block), text, "reserve the user block");
  Handle file = checked(H5Fcreate(text.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose, text,
                        "create the file");
  Group root(root_group(file, text), text + ":/", communicator.has_value());
  return {std::move(file), std::move(root), text, communicator.has_value()};
}

File File::open(const std::filesystem::path& path, Access access, std::optional<MPI_Comm> communicator) {
  require_memory();
  silence();
  const std::string text = path.string();
  const Handle properties = access_properties(communicator, text);
  Handle file = checked(
      H5Fopen(text.c_str(), access == Access::modify ? H5F_ACC_RDWR : H5F_ACC_RDONLY, properties.get()),
      H5Fclose, text, "open the file");
  Group root(root_group(file, text), text + ":/", communicator.has_value());
  return {std::move(file), std::move(root), text, false};
}

namespace {

/// HDF5 closes at exit what is still open. Of a file that it could not complete it makes a segmentation
/// fault, and ranks would wait for one another: after the first such file the process ends without that.
void end_without_closing() {
  static const int registered = on_exit(
      [](int status, void*) {
        std::fflush(nullptr);
        std::_Exit(status);
      },
      nullptr);
  (void)registered;
}

/// Takes the room that a file needs on the disk before ranks close it together: when one of them cannot write there,
/// HDF5 1.10 lets each wait for each for ever.
void reserve_room(const Handle& file, const std::string& path) {
  std::size_t tables = 0;  // bytes that are not written yet, at most
  check(H5Fget_mdc_size(file.get(), nullptr, nullptr, &tables, nullptr), path, "find the size of the file");
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  struct stat written = {};
  ::fstat(descriptor, &written);
  constexpr std::size_t blocks = 1 << 16;  // HDF5 takes room in blocks
  const int status =
      ::fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, written.st_size + static_cast<off_t>(tables + blocks));
  const int reason = errno;
  ::close(descriptor);
  // Some file systems cannot reserve; they are no worse off than before.
  if (status != 0 && (reason == ENOSPC || reason == EDQUOT || reason == EFBIG)) {
    throw InputError(fmt::format("{}: cannot close the file: {}", path, std::strerror(reason)));
  }
}

/// Gives back what was taken beyond the end of a file that is closed.
void release_room(const std::string& path) {
  struct stat closed = {};
  if (::stat(path.c_str(), &closed) == 0) static_cast<void>(!::truncate(path.c_str(), closed.st_size));
}

}  // namespace

File::~File() {
  if (together && std::uncaught_exceptions() > 0) {
    root.handle_.abandon();
    handle.abandon();
    end_without_closing();
  } else if (!root.handle_.reset() || !handle.reset()) {
    end_without_closing();
  }
}

void File::close() {
  if (together) reserve_room(handle, path);
  if (root.handle_.reset() && handle.reset()) {
    if (together) release_room(path);
    return;
  }
  end_without_closing();
  fail(path, "close the file");
}

}  // namespace whipple::hdf5
