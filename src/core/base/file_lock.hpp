// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace whipple {

/// Exclusive lock (flock) on a file, held while the object lives; it ends with the process, however that
/// ends. The file names its holder and is removed with the lock.
class FileLock {
 public:
  enum class IfHeld { wait, refuse };

  /// @param path the file of the lock, made if it is not there
  /// @param what that it guards, for messages: "the run directory run/disk"
  /// @throws InputError if another process holds the lock and `refuse` is asked for (naming its process and
  /// machine), or if the file cannot be made
  FileLock(std::filesystem::path path, const std::string& what, IfHeld if_held);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace whipple
