// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"

namespace whipple {
namespace {

std::string this_process() {
  std::array<char, 256> machine{};
  gethostname(machine.data(), machine.size() - 1);
  return fmt::format("process {} on {}", getpid(), machine.data());
}

std::string holder_in(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : "another process";
}

/// Returns whether the locked file still exists; the previous holder may have removed it between opening and locking.
bool is_still_there(int descriptor, const std::filesystem::path& path) {
  struct stat held = {}, named = {};
  return fstat(descriptor, &held) == 0 && lstat(path.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

/// Returns whether the file system does not support flock(2).
bool is_unsupported(int error) { return error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP; }

}  // namespace

FileLock::FileLock(std::filesystem::path path, const std::string& what, IfHeld if_held) {
  if (acquire(path, what, if_held)) return;
  throw InputError(fmt::format("{} is being written by {}: wait for its end or end it (lock {})", what,
                               last_holder(path), path.string()));
}

std::unique_ptr<const FileLock> FileLock::if_free(const std::filesystem::path& path,
                                                  const std::string& what) {
  std::unique_ptr<FileLock> lock(new FileLock());
  if (!lock->acquire(path, what, IfHeld::refuse)) return nullptr;
  return lock;
}

std::string FileLock::last_holder(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  const std::string holder = holder_in(file);
  if (file >= 0) ::close(file);
  return holder;
}

bool FileLock::acquire(const std::filesystem::path& path, const std::string& what, IfHeld if_held) {
  path_ = path;
  const auto fail = [&](const std::string& reason) {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    throw InputError(reason);
  };
  for (;;) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
      fail(fmt::format("{}: cannot make the lock: {}", path_.string(), std::strerror(errno)));
    int status = 0;
    do {
      status = ::flock(descriptor_, if_held == IfHeld::wait ? LOCK_EX : LOCK_EX | LOCK_NB);
    } while (status != 0 && errno == EINTR);
    if (status != 0 && errno == EWOULDBLOCK) {
      ::close(std::exchange(descriptor_, -1));
      return false;
    }
    if (status != 0 && !is_unsupported(errno)) {
      fail(fmt::format("{}: cannot lock: {}", path_.string(), std::strerror(errno)));
    }
    if (status != 0)
      log::warning("{}: the file system has no locks; nothing keeps a second writer out", what);
    if (is_still_there(descriptor_, path_)) break;
    ::close(descriptor_);
  }
  const std::string holder = this_process();
  // The name is informative only; on a full disk the lock is valid without it.
  if (::ftruncate(descriptor_, 0) == 0) (void)!::pwrite(descriptor_, holder.data(), holder.size(), 0);
  return true;
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace whipple
