// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/hdf5/hdf5.hpp"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/hdf5/calls.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::hdf5 {

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

// ---- groups ----

Group Group::create_group(const std::string& name, Order order) const {
  const std::string action = "create group " + name;
  const Handle creation = creation_properties(H5P_GROUP_CREATE, name_);
  if (order == Order::creation) {
    check(H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED), name_,
          action);
    // Allows many short attributes without an index.
    check(H5Pset_attr_phase_change(creation.get(), 256, 128), name_, action);
  }
  return {checked(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose, name_,
                  action),
          name_ + name + "/", writers_};
}

Group Group::open_group(const std::string& name) const {
  return {checked(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose, name_, "open group " + name),
          name_ + name + "/", writers_};
}

Dataset Group::open_dataset(const std::string& name) const {
  return {checked(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose, name_, "open data set " + name),
          name_ + name, writers_};
}

bool Group::has(const std::string& name) const {
  const htri_t found = H5Lexists(id(), name.c_str(), H5P_DEFAULT);
  check(found, name_, "look for " + name);
  return found > 0;
}

std::vector<std::string> Group::names(Order order) const {
  std::vector<std::string> names;
  hsize_t index = 0;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  // HDF5 1.10 sorts in an internal table, which it frees uninitialised, and crashes, if the group is damaged.
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

// ---- files ----

namespace {

Handle access_properties(const std::string& path) {
  Handle access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "prepare the file");
  // Otherwise an unclosed object would keep the file open, and unflushed, without notice.
  check(H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG), path, "prepare the file");
  return access;
}

/// Checks that there is enough memory to open a file: HDF5 1.10 crashes if it cannot allocate its cache (0.7 MB).
/// @throws std::bad_alloc if there is not
void require_memory() {
  constexpr std::size_t needed = 8 << 20;  // bytes
  void* const room = ::mmap(nullptr, needed, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  ::munmap(room, needed);
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

/// Creates the access property list of a file on disk, or in memory if `memory` is given.
Handle access_to(MemoryFile* memory, const std::string& name) {
  Handle access = access_properties(name);
  if (memory != nullptr && !place_in_memory(access.get(), *memory)) fail(name, "prepare memory");
  return access;
}

/// Returns the name passed to HDF5: files in memory require the name of a file that does not exist.
std::string place_of(const std::string& name, const MemoryFile* memory) {
  return memory != nullptr ? name + ".memory" : name;
}

/// Creates or replaces a file. @param name  for messages
File created(const std::string& name, File::Compatibility compatibility, std::uint64_t user_block,
             std::optional<MPI_Comm> writers, std::unique_ptr<MemoryFile> memory) {
  require_memory();
  silence();
  const Handle access = access_to(memory.get(), name);
  check(H5Pset_libver_bounds(access.get(), oldest_format(compatibility), H5F_LIBVER_V110), name,
        "choose the format version");
  const Handle creation = creation_properties(H5P_FILE_CREATE, name);
  check(H5Pset_userblock(creation.get(), user_block), name, "reserve the user block");
  Handle file =
      checked(H5Fcreate(place_of(name, memory.get()).c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
              H5Fclose, name, "create the file");
  return File::of(std::move(file), name, std::move(memory), writers);
}

}  // namespace

File File::of(Handle file, const std::string& name, std::unique_ptr<MemoryFile> memory,
              std::optional<MPI_Comm> writers) {
  Handle root = checked(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose, name, "open the root group");
  return {std::move(file), Group(std::move(root), name + ":/", writers), name, std::move(memory)};
}

File File::create(const std::filesystem::path& path, Compatibility compatibility, std::uint64_t user_block,
                  std::optional<MPI_Comm> communicator) {
  const bool sends = communicator && parallel::rank(*communicator) != 0;
  return created(path.string(), compatibility, user_block, communicator,
                 sends ? std::make_unique<MemoryFile>() : nullptr);
}

File File::create_in_memory(const std::filesystem::path& name, Compatibility compatibility) {
  return created(name.string(), compatibility, 0, {}, std::make_unique<MemoryFile>());
}

namespace {

unsigned flags_of(File::Access access) {
  return access == File::Access::modify ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
}

}  // namespace

File File::open(const std::filesystem::path& path, Access access) {
  require_memory();
  silence();
  const std::string name = path.string();
  const Handle properties = access_properties(name);
  return of(
      checked(H5Fopen(name.c_str(), flags_of(access), properties.get()), H5Fclose, name, "open the file"),
      name, nullptr);
}

File File::open_bytes(const std::filesystem::path& path, std::string bytes, Access access) {
  require_memory();
  silence();
  const std::string name = path.string();
  if (bytes.empty()) throw InputError(name + ": cannot open the file: it is empty");
  auto memory = std::make_unique<MemoryFile>();
  const Handle properties = access_to(memory.get(), name);
  check(H5Pset_file_image(properties.get(), bytes.data(), bytes.size()), name, "open the file");
  Handle file = checked(H5Fopen(place_of(name, memory.get()).c_str(), flags_of(access), properties.get()),
                        H5Fclose, name, "open the file");
  return of(std::move(file), name, std::move(memory));
}

namespace {

/// Prevents HDF5 from closing open files at exit: for a file that it could not complete, this causes a segmentation
/// fault. After the first such file the process therefore exits without closing.
void end_without_closing() {
  static const int registered = on_exit(
      [](int status, void*) {
        std::fflush(nullptr);
        std::_Exit(status);
      },
      nullptr);
  (void)registered;
}

}  // namespace

File::~File() {
  if (!root.handle_.reset() || !handle.reset()) end_without_closing();
}

void File::close() {
  if (root.handle_.reset() && handle.reset()) return;
  end_without_closing();
  fail(path, "close the file");
}

std::string File::close_as_bytes() {
  hsize_t size = 0;
  check(H5Fflush(handle.get(), H5F_SCOPE_LOCAL), path, "complete the file");
  check(H5Fget_filesize(handle.get(), &size), path, "complete the file");
  memory->wanted = size;
  close();
  // Space reserved by HDF5 is not part of the file, whose end is stored in its superblock (version 2 or 3).
  constexpr std::size_t version_at = 8, end_at = 28;
  std::string& bytes = memory->bytes;
  std::uint64_t end = 0;
  if (bytes.size() < end_at + sizeof end || bytes[version_at] < 2) return std::move(bytes);
  std::memcpy(&end, bytes.data() + end_at, sizeof end);
  bytes.resize(std::min<std::size_t>(end, bytes.size()));
  return std::move(bytes);
}

}  // namespace whipple::hdf5
