// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/materials_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "src/app/materials_table.hpp"
#include "src/core/base/log.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

void print_materials() {
  const std::vector<LibraryMaterial> materials = library_materials();
  std::size_t width = 4;
  for (const LibraryMaterial& material : materials) {
    width = std::max(width, material.file.stem().string().size());
  }
  const auto print_group = [&](std::string_view group, std::string_view title) {
    bool first = true;
    for (const LibraryMaterial& material : materials) {
      if (material.group != group) continue;
      if (first) fmt::print("{}\n", title);
      first = false;
      fmt::print("  {:<{}}  {}\n", material.file.stem().string(), width,
                 material.note.empty() ? material.name : material.note);
    }
  };
  for (const char* group : material_groups) print_group(group, group);
  print_group("", "other");
  log::info("{} materials; a bare file name is searched in the folder of the case, then in:", materials.size());
  for (const std::filesystem::path& folder : library_folders()) log::info("  {}", folder.string());
}

}  // namespace

void add_materials_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("materials", "List the material library");
  command->footer("Example:\n  whipple materials\n  whipple materials --markdown");
  const auto markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown,
                    "Tables of values computed from the equations of state (docs/manual/materials.md), in Markdown");
  command->callback([markdown] {
    if (*markdown) {
      fmt::print("{}", library_as_markdown());
    } else {
      print_materials();
    }
  });
}

}  // namespace whipple::app
