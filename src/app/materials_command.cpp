// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/materials_command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/base/log.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

void print_materials() {
  std::size_t width = 4;
  const std::vector<LibraryMaterial> materials = library_materials();
  for (const LibraryMaterial& material : materials) {
    width = std::max(width, material.file.filename().string().size());
  }
  for (const LibraryMaterial& material : materials) {
    fmt::print("{:<{}}  {}{}{}\n", material.file.filename().string(), width, material.name,
               material.note.empty() ? "" : ": ", material.note);
  }
  log::info("{} materials; a bare file name is looked up beside the case, then in:", materials.size());
  for (const std::filesystem::path& folder : library_folders()) log::info("  {}", folder.string());
}

}  // namespace

void add_materials_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("materials", "List the material library");
  command->footer("Example:\n  whipple materials");
  command->callback(print_materials);
}

}  // namespace whipple::app
