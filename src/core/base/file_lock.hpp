// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
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
  /// Acquires the lock if no other process holds it.
  /// @returns nothing if one does
  /// @throws InputError if the file cannot be created
  static std::unique_ptr<const FileLock> if_free(const std::filesystem::path& path, const std::string& what);
  /// Returns who acquired a lock last, "process 12 on node3", for messages about locks that are held.
  static std::string last_holder(const std::filesystem::path& path);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

 private:
  FileLock() = default;
  /// @returns whether it was acquired
  bool acquire(const std::filesystem::path& path, const std::string& what, IfHeld if_held);

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace whipple
