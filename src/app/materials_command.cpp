// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/materials_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "src/app/completion_command.hpp"
#include "src/app/eos_audit.hpp"
#include "src/app/materials_table.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/json.hpp"
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
  log::info("{} materials; a bare file name is searched in the folder of the case, then in:",
            materials.size());
  for (const std::filesystem::path& folder : library_folders()) log::info("  {}", folder.string());
}

/// Prints the library for programs.
void print_materials_as_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const LibraryMaterial& material : library_materials()) {
    list.push_back({{"key", material.file.stem().string()},
                    {"name", material.name},
                    {"group", material.group},
                    {"note", material.note},
                    {"file", material.file.string()}});
  }
  fmt::print("{}\n", json_text(list, 1));
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Lists the materials with all words in their names, groups or notes, then those with the words only in their sources,
/// models or comments.
void search_materials(const std::vector<std::string>& words) {
  const auto holds = [&](const std::string& text) {
    return std::ranges::all_of(words,
                               [&](const std::string& word) { return text.find(lower(word)) != text.npos; });
  };
  std::vector<LibraryMaterial> named, cited;
  std::size_t width = 0;
  for (const LibraryMaterial& material : library_materials()) {
    const std::string stem = material.file.stem().string();
    std::vector<LibraryMaterial>* list = nullptr;
    if (holds(lower(fmt::format("{}\n{}\n{}\n{}", stem, material.name, material.group, material.note)))) {
      list = &named;
    } else if (holds(lower(stem + "\n" + read_text(material.file)))) {
      list = &cited;
    }
    if (list == nullptr) continue;
    list->push_back(material);
    width = std::max(width, stem.size());
  }
  if (named.empty() && cited.empty()) throw InputError("no material of the library holds all of these words");
  const auto print = [&](const std::vector<LibraryMaterial>& list) {
    for (const LibraryMaterial& material : list)
      fmt::print("{:<{}}  {}\n", material.file.stem().string(), width, material.note);
  };
  print(named);
  if (!named.empty() && !cited.empty()) fmt::print("\nin sources, models or comments only:\n");
  print(cited);
}

/// Prints the file, which contains constants and sources, and the range of validity of its equation of state.
void show_material(const std::string& name) {
  const Material material = read_material(name);
  fmt::print("# {}\n{}\n", material.file.string(), read_text(material.file));
  print_audit(material, eos::AuditDepth::brief);
}

}  // namespace

void add_materials_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("materials", "List the material library, search it, show a material");
  command->footer(
      "Examples:\n  whipple materials\n  whipple materials search steinberg copper\n  whipple materials show "
      "copper");
  const auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* search = command->add_subcommand(
      "search", "List the materials whose names, notes, models or sources hold all words, in any case");
  search->add_option("words", *words, "e.g. steinberg aluminium")->required();
  search->callback([words] { search_materials(*words); });
  const auto name = std::make_shared<std::string>();
  CLI::App* show = command->add_subcommand(
      "show",
      "Print a material file with its constants and sources, what follows from them, and where it is valid");
  offer_materials(show->add_option("material", *name, "Material file, or name of the library")->required());
  show->callback([name] { show_material(*name); });
  const auto markdown = std::make_shared<bool>(false);
  command->add_flag(
      "--markdown", *markdown,
      "Tables of values computed from the equations of state (docs/manual/materials.md), in Markdown");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "The list for programs")->excludes("--markdown");
  command->callback([command, markdown, json] {
    if (!command->get_subcommands().empty()) return;
    if (*json) {
      print_materials_as_json();
    } else if (*markdown) {
      fmt::print("{}", library_as_markdown());
    } else {
      print_materials();
    }
  });
}

}  // namespace whipple::app
