// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/hdf5/hdf5.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

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
#include "src/core/hdf5/calls.hpp"

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
