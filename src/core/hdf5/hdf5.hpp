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

/// Thin ownership over the C interface of HDF5. Every failure is an InputError with the name of the file,
/// what was attempted and HDF5's own innermost message; HDF5 prints nothing by itself.
namespace whipple::hdf5 {

/// An identifier that is closed with its owner.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }

  [[nodiscard]] hid_t get() const { return id_; }
  /// Closes now; returns false if HDF5 reports a failure (a full disk shows here).
  bool reset() noexcept;

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// The rows of a distributed array that this process holds: [first, first + count) of `total`.
struct Slab {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  std::uint64_t total = 0;
  /// All of an array in one process.
  static Slab whole(std::uint64_t n) { return {0, n, n}; }
};

/// How an array is stored. `columns` 0 means a one-dimensional array. Arrays without rows are stored without
/// filters.
struct Storage {
  std::uint64_t columns = 0;
  int deflate = -1;         ///< level of shuffle + deflate, -1: none
  bool fletcher32 = false;  ///< checksum of every chunk
  std::uint64_t chunk_rows = 65536;
};

enum class Characters { ascii, utf8 };

/// In which order a group lists its members. One that shall list them as they were added must be created so.
enum class Order { name, creation };

/// A group or a data set: something with a name and attributes. Valid while its file is open. What was created with a
/// communicator is written collectively.
class Object {
 public:
  void set_attribute(const std::string& name, std::int64_t value) const;
  void set_attribute(const std::string& name, double value) const;
  void set_attribute(const std::string& name, std::span<const std::int64_t> values) const;
  /// UTF-8 of variable length, for other programs alone: h5py shows it as a text, `text_attribute` refuses it.
  void set_attribute(const std::string& name, std::string_view text) const;
  /// Text of exactly its length, stored in the attribute itself (at least one byte; `Type` of VTKHDF).
  void set_fixed_attribute(const std::string& name, std::string_view text,
                           Characters characters = Characters::utf8) const;

  [[nodiscard]] bool has_attribute(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> attribute_names() const;
  [[nodiscard]] std::int64_t integer_attribute(const std::string& name) const;
  [[nodiscard]] double real_attribute(const std::string& name) const;
  /// A text of fixed length. Those of variable length are refused: libhdf5 follows a damaged reference to one
  /// into nowhere.
  [[nodiscard]] std::string text_attribute(const std::string& name) const;

  [[nodiscard]] hid_t id() const { return handle_.get(); }
  /// "file.h5:/group/name" for messages.
  [[nodiscard]] const std::string& name() const { return name_; }

 protected:
  Object(Handle handle, std::string name, std::optional<MPI_Comm> writers)
      : handle_(std::move(handle)), name_(std::move(name)), writers_(writers) {}
  Handle handle_;
  std::string name_;
  std::optional<MPI_Comm> writers_;  ///< ranks that write the file together; none: this process alone
};

class Dataset : public Object {
 public:
  /// Lengths of the dimensions.
  [[nodiscard]] std::vector<std::uint64_t> shape() const;

  struct Shape {
    std::uint64_t rows, columns;
  };
  /// Shape of a list (one column) or table, to be asked before room is made for it.
  /// @throws InputError if it has more dimensions, or the file is too small to hold what it declares
  [[nodiscard]] Shape stored_shape() const;
  /// @throws InputError naming both shapes, as `stored_shape`
  void require_shape(const Shape& expected) const;

  /// Returns whether the numbers in the file are of the class and width of T, so that they can be read as such.
  template <class T>
  [[nodiscard]] bool stores() const {
    return has_type(NumberType<T>::memory());
  }
  /// Reads rows [slab.first, slab.first + slab.count), all columns, row by row.
  /// @throws InputError also if the type is of another class or width than T, or the array has other columns.
  template <class T>
  void read_rows(std::span<T> values, const Slab& slab, std::uint64_t columns) const {
    read_bytes(values.data(), NumberType<T>::memory(), values.size(), slab, columns);
  }
  /// The whole array, by this process alone.
  template <class T>
  [[nodiscard]] std::vector<T> read_all() const {
    return read_all<T>(stored_shape());
  }
  /// Reads the whole array of a known shape, by this process alone.
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
  /// Returns whether there is a link of this name (one level).
  [[nodiscard]] bool has(const std::string& name) const;
  /// Names of the links of this group.
  [[nodiscard]] std::vector<std::string> names(Order order = Order::name) const;
  /// Removes a link; the room of the object is not given back.
  void remove(const std::string& name) const;

  /// Creates a data set of slab.total rows and writes the rows of this process (`values` row by row).
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

/// An open file and its root group.
///
/// A file that is created with a communicator holds the rows of all its ranks, and all calls are collective. The first
/// rank alone has it open: the others send their rows, and do all else to a file in memory. An error of the disk meets
/// that rank as it meets a single process, never inside of a call in which ranks wait for one another (as in the parallel
/// part of HDF5 1.10, which waits for ever then).
struct File {
  enum class Compatibility {
    compact,     ///< H5F_LIBVER_V18 ... V110: small groups and attributes are stored compactly
    vtk,         ///< H5F_LIBVER_EARLIEST ... V110: what every ParaView since 5.10 reads
    checksummed  ///< H5F_LIBVER_V110 for all objects: metadata carry checksums
  };

  enum class Access { read, modify };

  /// Takes an open file into ownership. @param writers  of `create`
  static File of(Handle file, const std::string& name, std::unique_ptr<MemoryFile> memory,
                 std::optional<MPI_Comm> writers = {});
  /// Creates or replaces a file.
  /// @param user_block bytes left free at the beginning of the file (0, or a power of two from 512)
  static File create(const std::filesystem::path& path, Compatibility compatibility,
                     std::uint64_t user_block = 0, std::optional<MPI_Comm> communicator = {});
  static File open(const std::filesystem::path& path, Access access = Access::read);
  /// Makes a file in memory alone: a disk that fails meets the functions of src/core/base/files, never HDF5.
  /// @param name  for messages
  static File create_in_memory(const std::filesystem::path& name, Compatibility compatibility);
  /// Opens a copy of the bytes of a file, in memory alone. @param name  for messages
  static File open_bytes(const std::filesystem::path& name, std::string bytes, Access access = Access::read);

  File(Handle of_file, Group of_root, std::string at, std::unique_ptr<MemoryFile> in)
      : memory(std::move(in)), handle(std::move(of_file)), root(std::move(of_root)), path(std::move(at)) {}
  File(File&&) = default;
  ~File();

  /// Closes; reports what could not be written.
  void close();
  /// Closes a file in memory. @returns its bytes
  std::string close_as_bytes();

  std::unique_ptr<MemoryFile> memory;  ///< none: on a disk
  Handle handle;
  Group root;
  std::string path;
};

}  // namespace whipple::hdf5
