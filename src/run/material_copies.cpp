// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/material_copies.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "src/core/base/text.hpp"

namespace whipple::run {

std::vector<std::string> material_copies(const cases::Case& setup) {
  std::vector<std::string> names;
  std::map<std::string, std::filesystem::path> taken;
  for (const auto& material : setup.materials) {
    std::string name = utf8(material->file.filename().string(), "_");
    for (int i = 2; taken.contains(name) && taken[name] != material->file; ++i) {
      name = fmt::format("{}_{}.toml", utf8(material->file.stem().string(), "_"), i);
    }
    taken[name] = material->file;
    names.push_back("materials/" + name);
  }
  return names;
}

}  // namespace whipple::run
