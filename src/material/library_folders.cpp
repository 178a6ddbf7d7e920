// SPDX-License-Identifier: BSD-3-Clause
// Where the library of materials lies: of its own, since the source folder is compiled into it.
#include <cstdlib>

#include "src/material/material_file.hpp"

namespace whipple {

namespace fs = std::filesystem;

std::vector<fs::path> library_folders() {
  std::vector<fs::path> candidates;
  if (const char* folder = std::getenv("WHIPPLE_MATERIALS")) candidates.emplace_back(folder);
  std::error_code failed;
  const fs::path executable = fs::read_symlink("/proc/self/exe", failed);
  if (!failed)
    candidates.push_back(executable.parent_path().parent_path() / "share" / "whipple" / "materials");
  candidates.emplace_back(WHIPPLE_MATERIAL_SOURCE_FOLDER);
  std::erase_if(candidates, [](const fs::path& folder) {
    std::error_code ignored;
    return !fs::is_directory(folder, ignored);
  });
  return candidates;
}

}  // namespace whipple
