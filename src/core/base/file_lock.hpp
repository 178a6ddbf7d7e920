// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace whipple {

/// Holds an exclusive lock (flock) on a file during its lifetime; the lock ends with the process, even if the process
/// is killed. The file contains the name of the holder and is removed with the lock.
class FileLock {
 public:
  enum class IfHeld { wait, refuse };

  /// Acquires the lock.
  /// @param path lock file, created if it does not exist
  /// @param what the protected resource, for messages: "the run directory run/disk"
  /// @throws InputError if another process holds the lock and `refuse` is selected (stating its process and machine),
  /// or if the file cannot be created
  FileLock(std::filesystem::path path, const std::string& what, IfHeld if_held);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace whipple
