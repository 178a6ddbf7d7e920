// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/source_file.hpp"

#include <fmt/format.h>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/text.hpp"

namespace whipple::cases {

namespace fs = std::filesystem;

fs::path kept_name(const std::string& digest, const fs::path& path) {
  constexpr std::size_t distinct = 12;  // digits, for files of one name
  return fs::path("files") / digest.substr(0, distinct) / path.filename();
}

fs::path named_file(const std::string& file, const fs::path& folder) {
  return fs::absolute(folder / file).lexically_normal();
}

SourceFile find_source(const std::string& file, const std::string& digest, const fs::path& folder,
                       fs::path (*companion)(const fs::path&)) {
  if (file.empty()) throw InputError("'file' is empty");
  SourceFile source{.path = named_file(file, folder), .digest = {}, .companions = {}};
  if (utf8(source.path.string()) !=
      source.path.string()) {  // run.toml contains the path, and TOML texts are UTF-8
    throw InputError(fmt::format("{}: a run could not name this file again: rename what is not UTF-8",
                                 utf8(source.path.string())));
  }
  if (!digest.empty()) {
    constexpr std::size_t digits = 64;
    if (digest.size() != digits || digest.find_first_not_of("0123456789abcdef") != std::string::npos) {
      throw InputError("'digest' has 64 digits, 0 to 9 and a to f: a SHA-256");
    }
    const fs::path kept = fs::absolute(folder / kept_name(digest, source.path));
    std::error_code none;
    if (fs::is_regular_file(kept, none)) source.path = kept;
  }
  std::error_code fault;
  if (!fs::exists(source.path, fault)) {
    throw InputError(fmt::format("{}: {}", source.path.string(), fault ? fault.message() : "no such file"));
  }
  source.digest = sha256_of_file(regular_file(source.path));
  const fs::path further = companion != nullptr ? companion(source.path) : fs::path();
  if (!further.empty()) {
    source.companions.push_back(source.path.parent_path() / further);
    source.digest = sha256(source.digest + sha256_of_file(regular_file(source.companions.back())));
  }
  if (!digest.empty() && source.digest != digest) {
    throw InputError(fmt::format("{}: the file has changed: its digest is {}, expected {}",
                                 source.path.string(), source.digest, digest));
  }
  return source;
}

void keep_sources(const Shape& shape, const fs::path& folder) {
  shape.visit([&](const Shape& part) {
    const std::optional<SourceFile> source = part.source();
    if (!source) return;
    const fs::path copy = folder / kept_name(source->digest, source->path);
    make_folder(copy.parent_path());
    write_text_atomically(copy, read_text(source->path));
    for (const fs::path& companion : source->companions) {
      write_text_atomically(copy.parent_path() / companion.filename(), read_text(companion));
    }
  });
}

}  // namespace whipple::cases
