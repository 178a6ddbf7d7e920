// SPDX-License-Identifier: BSD-3-Clause
#include "src/editor/case_file.hpp"

#include <fmt/format.h>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/hash.hpp"

namespace whipple::editor {

namespace fs = std::filesystem;

std::string digest_of(const std::string& text) { return sha256(text); }

CaseFile::Content CaseFile::read() const {
  constexpr std::uintmax_t most_bytes = 16'000'000;  // as every input
  if (!fs::exists(path_)) return {};
  const std::string text = read_text(path_, most_bytes);
  return {text, digest_of(text)};
}

std::string CaseFile::write(const std::string& text, const std::string& digest) const {
  if (read().digest != digest) return {};
  if (fs::exists(path_)) {
    const fs::path file = fs::canonical(path_);
    const fs::perms permissions = fs::status(file).permissions();
    write_text_atomically(file, text);
    fs::permissions(file, permissions);
  } else if (fs::is_symlink(path_)) {
    throw InputError(fmt::format("{}: is a link that leads to no file", path_.string()));
  } else {
    write_text_atomically(path_, text);
  }
  return digest_of(text);
}

}  // namespace whipple::editor
