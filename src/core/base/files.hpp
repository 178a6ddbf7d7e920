// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace whipple {

/// Checks that a path can be read as a regular file and returns it: devices may be unbounded, and pipes may block.
/// Missing files pass; opening them reports the error.
/// @param most maximum size in bytes
/// @throws InputError if it is a folder, a device, a pipe, or larger
const std::filesystem::path& regular_file(const std::filesystem::path& path,
                                          std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

/// Reads a whole file. Read errors are never mistaken for the end of the file.
/// @param most maximum size in bytes
/// @throws InputError stating the file, the call and the system error; and as `regular_file`
std::string read_text(const std::filesystem::path& path,
                      std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

/// Returns whether a path is inside a folder after resolving all links; false if it cannot be determined.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Checks that no file is overwritten unless requested. An empty path (no file) passes.
/// @throws InputError if the file exists and `force` is not set
void require_new_file(const std::filesystem::path& path, bool force);

/// Checks that a figure can be written, as `require_new_file`, and that its extension is png, pdf or svg.
void require_new_figure(const std::filesystem::path& path, bool force);

/// Checks that a folder exists. @throws InputError naming it if it does not
void require_folder(const std::filesystem::path& path);

/// Checks that the path of a results folder is a folder or does not exist.
/// @throws InputError naming it
void require_no_file(const std::filesystem::path& path);

/// Creates a folder and its parents; an existing folder is left unchanged.
/// @throws InputError naming it and the system error
void make_folder(const std::filesystem::path& path);

/// Holds a file under construction. It is located in the folder of its target under a unique name,
/// NAME.XXXXXXXX.partial, and renamed to the target when complete: readers see the old file or the new one. Links and
/// existing files are neither followed nor overwritten, and abandoned files are removed.
class PartialFile {
 public:
  /// Creates the partial file. @throws InputError naming the target and the system error
  explicit PartialFile(std::filesystem::path target);
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Renames the file to its target. `durable`: content and name are forced to disk, so that a power failure leaves the
  /// old or the new file.
  /// @throws InputError naming the target
  void publish(bool durable = false);

 private:
  std::filesystem::path target_, path_;
  bool published_ = false;
};

/// Replaces a file atomically and forces it to disk: neither a kill nor a power failure leaves a partial file.
/// @param copy  temporary file in the same folder; an existing file of this name is removed, so only one writer at a
/// time is allowed
/// @throws InputError naming the file and the system error
void replace_durably(const std::filesystem::path& path, const std::filesystem::path& copy,
                     std::string_view bytes);

/// Appends lines to a text file, which is created if it does not exist.
/// @throws InputError naming the file and the system error
void append_text(const std::filesystem::path& path, std::string_view text);

/// Replaces a text file atomically. Writes directly to targets that are not files (/dev/stdout, a pipe).
/// @throws InputError naming the file and the system error
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace whipple
