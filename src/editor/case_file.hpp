// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace whipple::editor {

/// Represents the file that is edited, which other programs may change at any time.
class CaseFile {
 public:
  explicit CaseFile(std::filesystem::path path) : path_(std::move(path)) {}

  /// Holds the content at some time. Files that differ have different digests; that of a missing file is empty.
  struct Content {
    std::string text, digest;
  };
  /// @throws InputError if there is a file that cannot be read
  [[nodiscard]] Content read() const;

  /// Replaces the content atomically. Permissions stay, and a link still leads to the file.
  /// @param digest  of the content that the text was made from
  /// @returns the digest of the new content; nothing is written, and it is empty, if the file is another one meanwhile
  /// @throws InputError if the file cannot be written
  [[nodiscard]] std::string write(const std::string& text, const std::string& digest) const;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Returns the digest that `CaseFile` gives a text.
std::string digest_of(const std::string& text);

}  // namespace whipple::editor
