// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/cite_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "src/app/build_info.hpp"
#include "src/app/completion_command.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text_table.hpp"
#include "src/core/input/document.hpp"
#include "src/material/material_file.hpp"

namespace whipple::app {
namespace {

using Lines = std::vector<std::vector<std::string>>;

/// Adds the sources of a table, of its subtables, and of the lists in material files.
void add_sources(Lines& lines, input::Table table, const std::string& name) {
  struct Remarks {
    std::string source;
  };
  Remarks remarks;
  table.read(
      ParameterTable<Remarks>{text("source", &Remarks::source, "where the constants come from").optional()},
      remarks);
  if (!remarks.source.empty()) lines.push_back({"  " + name, remarks.source});
  for (const std::string& inner : table.table_names()) {
    if (auto inside = table.optional_table(inner)) add_sources(lines, *inside, inner);
  }
  for (const char* list : {"modifier", "failure"}) {
    if (!table.has(list)) continue;
    for (const input::Table& entry : table.list(list)) add_sources(lines, entry, list);
  }
}

/// Returns the materials of a run, or the single material of this name.
std::vector<std::filesystem::path> materials_of(const std::filesystem::path& name) {
  if (!std::filesystem::exists(name / "run.toml")) return {find_material(name)};
  input::Document document =
      input::Document::from_text(read_text(name / "run.toml"), (name / "run.toml").string());
  struct Named {
    std::string material;
  };
  std::vector<std::filesystem::path> files;
  for (input::Table body : document.root().list("body")) {
    Named named;
    body.read(ParameterTable<Named>{text("material", &Named::material, "material of the body")}, named);
    const std::filesystem::path file = find_material(named.material, name);
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  }
  document.finish_partly_read();
  return files;
}

std::string sources_of(const std::filesystem::path& file) {
  input::Document document = input::Document::from_text(material_text(file), file.string());
  Lines lines;
  add_sources(lines, document.root(), "material");
  document.finish_partly_read();
  if (lines.empty())
    throw InputError(fmt::format("{}: error: names no source: is no material", file.string()));
  return fmt::format("\n{}\n{}", file.string(), text_table(lines, "l"));
}

/// Prints the entries of CITATION.cff.
void print_program() {
  constexpr const char* title =
      "whipple: equations of state from molecular dynamics, and the material point method for hypervelocity "
      "impact";
  constexpr const char* authors = "The whipple authors";
  const BuildInfo& info = build_info();
  fmt::print("{}. {}, version {} (revision {}). BSD-3-Clause.\n\n", title, authors, info.version,
             info.revision);
  fmt::print(
      "@software{{whipple,\n  title = {{{}}},\n  author = {{{{{}}}}},\n  version = {{{}}},\n  license = "
      "{{BSD-3-Clause}}\n}}\n",
      title, authors, info.version);
}

}  // namespace

void add_cite_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("cite", "How to cite the program, and the sources of materials");
  const auto names = std::make_shared<std::vector<std::string>>();
  offer_materials(
      command->add_option("materials", *names, "Material files, names of the library, or run directories"));
  command->footer("Example:\n  whipple cite copper aluminium");
  command->callback([names] {
    std::string sources;
    for (const std::string& name : *names) {
      for (const std::filesystem::path& file : materials_of(name)) sources += sources_of(file);
    }
    print_program();
    fmt::print("{}", sources);
  });
}

}  // namespace whipple::app
