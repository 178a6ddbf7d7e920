// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "src/core/hdf5/memory_file.hpp"
#include "src/core/hdf5/number_type.hpp"

/// Thin RAII layer over the C interface of HDF5. Every failure is an InputError with the name of the file, the
/// attempted action and the innermost HDF5 message; HDF5 itself prints nothing.
namespace whipple::hdf5 {

/// Owns an identifier and closes it on destruction.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }

  [[nodiscard]] hid_t get() const { return id_; }
  /// Closes the identifier; returns false if HDF5 reports a failure (such as a full disk).
  bool reset() noexcept;

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Describes the rows of a distributed array held by this process: [first, first + count) of `total`.
struct Slab {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  std::uint64_t total = 0;
  /// Returns the slab of a complete array in one process.
  static Slab whole(std::uint64_t n) { return {0, n, n}; }
};

/// Describes how an array is stored. `columns` 0 means a one-dimensional array. Arrays without rows are stored without
/// filters.
struct Storage {
  std::uint64_t columns = 0;
  int deflate = -1;         ///< level of shuffle + deflate, -1: none
  bool fletcher32 = false;  ///< checksum of every chunk
  std::uint64_t chunk_rows = 65536;
};

enum class Characters { ascii, utf8 };

/// Selects the order in which a group lists its members. Creation order must be enabled when the group is created.
enum class Order { name, creation };

/// Represents a group or a dataset: an object with a name and attributes. Valid while its file is open. Objects created
/// with a communicator are written collectively.
class Object {
 public:
  void set_attribute(const std::string& name, std::int64_t value) const;
  void set_attribute(const std::string& name, double value) const;
  void set_attribute(const std::string& name, std::span<const std::int64_t> values) const;
  /// Writes variable-length UTF-8, for other programs only: h5py returns it as text, `text_attribute` rejects it.
  void set_attribute(const std::string& name, std::string_view text) const;
  /// Writes a fixed-length text, stored in the attribute (at least one byte; `Type` of VTKHDF).
  void set_fixed_attribute(const std::string& name, std::string_view text,
                           Characters characters = Characters::utf8) const;

  [[nodiscard]] bool has_attribute(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> attribute_names() const;
  [[nodiscard]] std::int64_t integer_attribute(const std::string& name) const;
  [[nodiscard]] double real_attribute(const std::string& name) const;
  /// Reads a fixed-length text. Variable-length ones are rejected: libhdf5 follows damaged references to them into
  /// invalid memory.
  [[nodiscard]] std::string text_attribute(const std::string& name) const;

  [[nodiscard]] hid_t id() const { return handle_.get(); }
  /// Returns "file.h5:/group/name" for messages.
  [[nodiscard]] const std::string& name() const { return name_; }

 protected:
  Object(Handle handle, std::string name, std::optional<MPI_Comm> writers)
      : handle_(std::move(handle)), name_(std::move(name)), writers_(writers) {}
  Handle handle_;
  std::string name_;
  std::optional<MPI_Comm> writers_;  ///< ranks that write the file together; none: this process only
};

class Dataset : public Object {
 public:
  /// Returns the lengths of the dimensions.
  [[nodiscard]] std::vector<std::uint64_t> shape() const;

  struct Shape {
    std::uint64_t rows, columns;
  };
  /// Returns the shape of a list (one column) or table, to be checked before memory is allocated.
  /// @throws InputError if it has more dimensions, or the file is too small for the declared size
  [[nodiscard]] Shape stored_shape() const;
  /// Checks the shape. @throws InputError stating both shapes, and as `stored_shape`
  void require_shape(const Shape& expected) const;

  /// Returns whether the numbers in the file have the class and width of T, so that they can be read as T.
  template <class T>
  [[nodiscard]] bool stores() const {
    return has_type(NumberType<T>::memory());
  }
  /// Reads rows [slab.first, slab.first + slab.count), all columns, row by row.
  /// @throws InputError also if the type has another class or width than T, or the array has another number of columns.
  template <class T>
  void read_rows(std::span<T> values, const Slab& slab, std::uint64_t columns) const {
    read_bytes(values.data(), NumberType<T>::memory(), values.size(), slab, columns);
  }
  /// Reads the whole array in this process.
  template <class T>
  [[nodiscard]] std::vector<T> read_all() const {
    return read_all<T>(stored_shape());
  }
  /// Reads the whole array of a known shape in this process.
  /// @throws InputError if the array has another shape or type
  template <class T>
  [[nodiscard]] std::vector<T> read_all(const Shape& expected) const {
    require_shape(expected);
    std::vector<T> values(expected.rows * expected.columns);
    read_bytes(values.data(), NumberType<T>::memory(), values.size(), Slab::whole(expected.rows),
               expected.columns);
    return values;
  }

 private:
  friend class Group;
  using Object::Object;
  [[nodiscard]] bool has_type(hid_t memory_type) const;
  void read_bytes(void* values, hid_t memory_type, std::uint64_t size, const Slab& slab,
                  std::uint64_t columns) const;
};

class Group : public Object {
 public:
  Group create_group(const std::string& name, Order order = Order::name) const;
  [[nodiscard]] Group open_group(const std::string& name) const;
  [[nodiscard]] Dataset open_dataset(const std::string& name) const;
  /// Returns whether there is a link with this name (one level).
  [[nodiscard]] bool has(const std::string& name) const;
  /// Returns the names of the links of this group.
  [[nodiscard]] std::vector<std::string> names(Order order = Order::name) const;
  /// Removes a link; the space of the object is not reclaimed.
  void remove(const std::string& name) const;

  /// Creates a dataset of slab.total rows and writes the rows of this process (`values` row by row).
  template <class T>
  Dataset write(const std::string& name, std::span<const T> values, const Slab& slab,
                const Storage& storage = {}) const {
    return write_bytes(name, values.data(), NumberType<T>::memory(), NumberType<T>::file(), values.size(),
                       slab, storage);
  }

 private:
  friend struct File;
  using Object::Object;
  Dataset write_bytes(const std::string& name, const void* values, hid_t memory_type, hid_t file_type,
                      std::uint64_t size, const Slab& slab, const Storage& storage) const;
};

/// Represents an open file and its root group.
///
/// A file created with a communicator holds the rows of all its ranks, and all calls are collective. Only the first
/// rank has it open: the others send their rows, and perform all other calls on a file in memory. A disk error is thus
/// reported on that rank as in a single process, never inside of a collective call (as in parallel HDF5 1.10, which
/// then blocks forever).
struct File {
  enum class Compatibility {
    compact,     ///< H5F_LIBVER_V18 ... V110: small groups and attributes are stored compactly
    vtk,         ///< H5F_LIBVER_EARLIEST ... V110: readable by every ParaView since 5.10
    checksummed  ///< H5F_LIBVER_V110 for all objects: metadata are checksummed
  };

  enum class Access { read, modify };

  /// Takes ownership of an open file. @param writers  as for `create`
  static File of(Handle file, const std::string& name, std::unique_ptr<MemoryFile> memory,
                 std::optional<MPI_Comm> writers = {});
  /// Creates or replaces a file.
  /// @param user_block bytes reserved at the beginning of the file (0, or a power of two from 512)
  static File create(const std::filesystem::path& path, Compatibility compatibility,
                     std::uint64_t user_block = 0, std::optional<MPI_Comm> communicator = {});
  static File open(const std::filesystem::path& path, Access access = Access::read);
  /// Creates a file in memory: disk errors then occur in the functions of src/core/base/files, never in HDF5.
  /// @param name  for messages
  static File create_in_memory(const std::filesystem::path& name, Compatibility compatibility);
  /// Opens a copy of the bytes of a file in memory. @param name  for messages
  static File open_bytes(const std::filesystem::path& name, std::string bytes, Access access = Access::read);

  File(Handle of_file, Group of_root, std::string at, std::unique_ptr<MemoryFile> in)
      : memory(std::move(in)), handle(std::move(of_file)), root(std::move(of_root)), path(std::move(at)) {}
  File(File&&) = default;
  ~File();

  /// Closes the file; reports write failures.
  void close();
  /// Closes a file in memory. @returns its bytes
  std::string close_as_bytes();

  std::unique_ptr<MemoryFile> memory;  ///< none: on disk
  Handle handle;
  Group root;
  std::string path;
};

}  // namespace whipple::hdf5
