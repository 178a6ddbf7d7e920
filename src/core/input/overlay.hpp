// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace whipple::input {

/// Lets `Document::from_file` read a text in place of the content of a file, which need not exist: editors have texts
/// checked that are not saved yet. Paths in the text refer to the folder of the file. Lasts as long as the object, of
/// which there is one at a time.
class Overlay {
 public:
  Overlay(std::filesystem::path file, std::string text);
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
  ~Overlay();

  /// Returns the text to read in place of a file; null: its own.
  static const std::string* text_of(const std::filesystem::path& file);
};

}  // namespace whipple::input
