// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace whipple {

/// The path again, to be opened: devices need not have an end, and pipes not even a beginning. Of a file that is
/// missing, opening it says so.
/// @param most bytes
/// @throws InputError if it is a folder, a device, a pipe, or larger
const std::filesystem::path& regular_file(const std::filesystem::path& path,
                                          std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

/// Reads a whole file. An error of the device is never taken for the end of the file.
/// @param most bytes
/// @throws InputError naming the file, the call and the reason of the system; for what `regular_file` refuses
std::string read_text(const std::filesystem::path& path,
                      std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());

/// Tells whether a path lies in a folder when all links are followed; what cannot be found out does not.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Nothing is overwritten unless asked for. An empty path (no file wanted) passes.
/// @throws InputError if the file exists and `force` is not set
void require_new_file(const std::filesystem::path& path, bool force);

/// Checks that a figure can be written as `require_new_file` does, and that its ending is one of png, pdf, svg.
void require_new_figure(const std::filesystem::path& path, bool force);

/// @throws InputError naming it if there is no such folder
void require_folder(const std::filesystem::path& path);

/// A folder for results may be missing, but nothing else may have its name.
/// @throws InputError naming it
void require_no_file(const std::filesystem::path& path);

/// Makes a folder and those above it; one that exists stays as it is.
/// @throws InputError naming it and the reason of the system
void make_folder(const std::filesystem::path& path);

/// A file in the making. It lies beside its target under a name of its own, NAME.XXXXXXXX.partial, and takes
/// the target's name when it is complete: readers see the old file or the new one. Neither links nor files
/// of others are followed or overwritten, and what is given up is removed.
class PartialFile {
 public:
  /// @throws InputError naming the target and the reason of the system
  explicit PartialFile(std::filesystem::path target);
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  ~PartialFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Gives the file its name. `durable`: content and name are forced to disk, so that a power failure leaves
  /// the old or the new file.
  /// @throws InputError naming the target
  void publish(bool durable = false);

 private:
  std::filesystem::path target_, path_;
  bool published_ = false;
};

/// Replaces a file as a whole and forces it to disk: neither a kill nor a power failure leaves half of it.
/// @param copy  name of the file in the making, beside it; what has this name is removed: one writer at a time
/// @throws InputError naming the file and the reason of the system
void replace_durably(const std::filesystem::path& path, const std::filesystem::path& copy,
                     std::string_view bytes);

/// Adds lines to a text file, which need not exist.
/// @throws InputError naming the file and the reason of the system
void append_text(const std::filesystem::path& path, std::string_view text);

/// Replaces a text file as a whole. Into what is no file (/dev/stdout, a pipe) the text is written as it is.
/// @throws InputError naming the file and the reason of the system
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace whipple
