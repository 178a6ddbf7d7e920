// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/material_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <system_error>

#include "eos/audit.hpp"
#include "eos/files/models.hpp"
#include "eos/models/simulated_crystal.hpp"
#include "src/core/base/catalogue.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/core/input/document.hpp"
#include "src/material/constitutive_catalogue.hpp"
#include "src/material/failure/catalogue.hpp"
#include "src/material/material_samples.hpp"
#include "src/material/material_tables.hpp"
#include "src/material/reaction/catalogue.hpp"
#include "src/material/strength/catalogue.hpp"

namespace whipple {
namespace {

namespace fs = std::filesystem;
using namespace material_tables;

/// Reads `model`, remarks and constants of one table.
/// @returns a function that builds the model, or nothing if `model` is invalid
template <class Entry>
typename Entry::Declared declare(const Catalogue<Entry>& catalogue, input::Table table) {
  const std::string model = table.choice("model", catalogue.names());
  Remarks remarks;
  table.read(Remarks::parameters(), remarks);
  const Entry* entry = catalogue.find(model);
  if (entry == nullptr) return {};
  return entry->declare([&table](std::span<const BoundParameter> parameters) { table.read(parameters); });
}

/// Builds one part; a contradiction among its constants becomes an error with file and line.
template <class Builder>
auto build(const Builder& builder, const std::string& where, const std::string& table) {
  try {
    return builder();
  } catch (const InputError& fault) {
    throw InputError(fmt::format("{}: error: [{}] {}", where, table, fault.what()));
  }
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// Returns the path, or the path with the extension .toml; empty if neither is a file.
fs::path with_ending(const fs::path& path) {
  if (is_file(path)) return path;
  fs::path longer = path;
  longer += ".toml";
  return is_file(longer) ? longer : fs::path();
}

std::map<std::string, fs::path> library_files() {
  std::map<std::string, fs::path> files;
  for (const fs::path& folder : library_folders()) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".toml") files.try_emplace(entry.path().stem().string(), entry.path());
    }
  }
  return files;
}

/// Keys that a material does not inherit, since they describe its base.
constexpr std::array<std::string_view, 9> not_inherited = {"name",           "source",           "note",
                                                           "provenance",     "covariance",       "defaults",
                                                           "default_errors", "potential_spread", "coverage"};
/// Keys that describe the constants of a table.
constexpr std::array<std::string_view, 2> of_constants = {"source", "note"};
constexpr int most_bases = 8;

/// Adds the tables of the material on which a document is based, and those of the base's base.
void inherit_from_base(input::Document& document, int depth = 0) {
  input::Table root = document.root();
  Base of_file;
  if (!root.read(Base::parameters(), of_file) || of_file.base.empty()) return;
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}: error: 'base' {}", root.where("base"), why));
  };
  fs::path base;
  try {
    base = find_material(of_file.base, document.path().parent_path());
  } catch (const InputError& fault) {
    refuse(fault.what());
  }
  if (depth == most_bases) refuse("goes on to more than 8 further materials: is one of them its own?");
  input::Document inherited = input::Document::from_file(base);
  inherit_from_base(inherited, depth + 1);
  document.inherit(std::move(inherited), "base", not_inherited, of_constants);
}

/// Holds a material file whose tables are read and checked, but whose parts are not built yet.
struct Declared {
  Head head;
  MeasuredTable measured;
  ThermalTable thermal;
  eos::ModelEntry::Declared eos, unreacted;
  strength::ModelEntry::Declared strength;
  std::vector<failure::CriterionEntry::Declared> failure;
  reaction::ReactionEntry::Declared reaction;
  material::ConstitutiveEntry::Declared constitutive;
  std::string eos_line, unreacted_line, reaction_line, strength_line, constitutive_line;
  /// Modifiers of the equation of state, each with its location in the file.
  std::vector<std::pair<eos::ModifierEntry::Declared, std::string>> modifiers;
};

Declared declare_file(const fs::path& file,
                      std::span<const std::pair<std::string, std::string>> changes = {}) {
  input::Document document = input::Document::from_file(file);
  inherit_from_base(document);
  for (const auto& [key, value] : changes) document.set(key, value);
  input::Table root = document.root();
  Declared declared;
  root.read(Head::parameters(), declared.head);
  for (const char* free : free_keys) root.accept(free);
  if (auto table = root.required_table("eos")) {
    declared.eos = declare(eos::all_models(table->folder()), *table);
    declared.eos_line = table->where();
    if (!declared.eos.companions.empty() && table->folder() != file.parent_path()) {
      table->error("reads files beside it: a material that is based on it must stand in the same folder");
    }
    if (auto unreacted = table->optional_table("unreacted")) {
      declared.unreacted = declare(eos::all_models(unreacted->folder()), *unreacted);
      declared.unreacted_line = unreacted->where();
    }
    for (input::Table& modifier : table->list("modifier")) {
      declared.modifiers.emplace_back(declare(eos::modifier_catalogue(), modifier), modifier.where());
    }
  }
  if (auto table = root.optional_table("reaction")) {
    declared.reaction = declare(reaction::catalogue(), *table);
    declared.reaction_line = table->where();
    if (!declared.unreacted.build) {
      table->error("a rate law takes the equation of state of the unreacted explosive: [eos.unreacted]");
    }
  }
  if (auto table = root.optional_table("strength")) {
    declared.strength = declare(strength::catalogue(), *table);
    declared.strength_line = table->where();
  }
  for (input::Table& table : root.list("failure"))
    declared.failure.push_back(declare(failure::catalogue(), table));
  if (auto table = root.optional_table("constitutive")) {
    declared.constitutive = declare(material::catalogue(), *table);
    declared.constitutive_line = table->where();
    if (declared.strength.build || !declared.failure.empty()) {
      table->error("takes the place of [strength] and [[failure]]: leave them out");
    }
  }
  if (auto table = root.optional_table("measured"))
    table->read(MeasuredTable::parameters(), declared.measured);
  if (auto table = root.optional_table("thermal")) table->read(ThermalTable::parameters(), declared.thermal);
  document.finish();
  return declared;
}

/// Returns ", did you mean ...?" with the name closest to a misspelt one, or with those that have most words in common:
/// "Al 6061-T6" is near aluminium_6061_t6.
std::string near_names(const std::string& wanted, const std::vector<std::string>& known) {
  const std::string misspelt = did_you_mean(wanted, known);
  if (!misspelt.empty()) return misspelt;
  std::vector<std::string> words(1);
  for (const char c : wanted) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  std::erase_if(words, [](const std::string& word) { return word.size() < 2; });
  const auto shared = [&](const std::string& name) {
    return std::ranges::count_if(words,
                                 [&](const std::string& word) { return name.find(word) != name.npos; });
  };
  std::ptrdiff_t most = 0;
  for (const std::string& name : known) most = std::max(most, shared(name));
  if (most == 0) return "";
  std::vector<std::string> found;
  for (const std::string& name : known) {
    if (shared(name) == most && found.size() < 4) found.push_back('"' + name + '"');
  }
  return fmt::format(", did you mean {}?", fmt::join(found, " or "));
}

}  // namespace

fs::path find_material(const fs::path& path, const fs::path& beside) {
  const fs::path local = with_ending(path.is_absolute() ? path : beside / path);
  if (!local.empty()) return local;
  if (path.has_parent_path()) {
    const fs::path file = beside / path;  // an absolute path is unchanged
    throw InputError(fmt::format("material file '{}' {}", file.string(),
                                 fs::is_directory(file) ? "is a folder" : "does not exist"));
  }
  std::vector<std::string> searched = {beside.empty() ? std::string(".") : beside.string()};
  for (const fs::path& folder : library_folders()) {
    const fs::path file = with_ending(folder / path);
    if (!file.empty()) return file;
    searched.push_back(folder.string());
  }
  std::vector<std::string> known;
  for (const auto& [stem, file] : library_files()) known.push_back(stem);
  throw InputError(fmt::format(
      "no material file '{}'{}; searched: {}; 'whipple materials' lists the {} of the library", path.string(),
      near_names(path.stem().string(), known), fmt::join(searched, ", "), known.size()));
}

Material read_material(const fs::path& path, const fs::path& beside) {
  return read_changed_material(find_material(path, beside), {});
}

Material read_changed_material(const fs::path& file,
                               std::span<const std::pair<std::string, std::string>> changes) {
  const Declared declared = declare_file(file, changes);
  std::shared_ptr<const eos::EquationOfState> eos = build(declared.eos.build, declared.eos_line, "eos");
  for (const auto& [modifier, line] : declared.modifiers) {
    eos = build([&] { return modifier.build(eos); }, line, "eos.modifier");
  }
  std::shared_ptr<const Explosive> explosive;
  if (declared.unreacted.build) {
    std::shared_ptr<const reaction::Reaction> reaction;
    if (declared.reaction.build)
      reaction = build(declared.reaction.build, declared.reaction_line, "reaction");
    explosive = build([&] { return make_explosive(eos, declared.unreacted.build(), std::move(reaction)); },
                      declared.unreacted_line, "eos.unreacted");
  } else if (eos->detonates()) {
    explosive = build([&] { return make_explosive(eos, nullptr); }, declared.eos_line, "eos");
  }
  std::shared_ptr<const strength::Strength> strength;
  if (declared.strength.build) strength = build(declared.strength.build, declared.strength_line, "strength");
  std::vector<std::shared_ptr<const failure::Criterion>> failure;
  for (const auto& criterion : declared.failure) failure.push_back(criterion.build());
  try {
    Material material =
        declared.constitutive.build
            ? make_material(declared.head.name, std::move(eos),
                            build(declared.constitutive.build, declared.constitutive_line, "constitutive"))
            : make_material(declared.head.name, std::move(eos), std::move(strength), std::move(failure));
    material.file = file;
    material.explosive = std::move(explosive);
    material.companions = declared.eos.companions;
    material.source = declared.head.source;
    material.note = declared.head.note;
    material.group = declared.head.group;
    material.measured = declared.measured;
    material.conductivity = declared.thermal.conductivity;
    set_taylor_quinney(material, declared.thermal.taylor_quinney);
    return material;
  } catch (const InputError& fault) {
    throw InputError(fmt::format("{}: error: {}", file.string(), fault.what()));
  }
}

void require_usable(const Material& material) {
  // An audit would simulate every state of its range; only the states that a run reaches should be simulated.
  if (material.eos->model() == eos::SimulatedCrystal::name) return;
  const eos::Audit audit = eos::audit(*material.eos, eos::AuditDepth::brief);
  switch (audit.verdict()) {
    case eos::Verdict::not_usable:
      throw InputError(
          fmt::format("{}: error: [eos] {}: {}", material.file.string(), audit.model, audit.summary()));
    case eos::Verdict::reservations:
      log::info("{}: equation of state {}", material.name, audit.summary());
      break;
    case eos::Verdict::sound:
      break;
  }
  log::detail("{}: equation of state valid for {}", material.name, audit.range_text());
  if (material.explosive == nullptr || material.explosive->estimated) return;
  const eos::Audit of_unreacted = eos::audit(*material.explosive->unreacted, eos::AuditDepth::brief);
  if (of_unreacted.verdict() == eos::Verdict::not_usable) {
    throw InputError(fmt::format("{}: error: [eos.unreacted] {}: {}", material.file.string(),
                                 of_unreacted.model, of_unreacted.summary()));
  }
}

std::string material_text(const fs::path& file) {
  input::Document document = input::Document::from_file(file);
  if (!document.root().has("base")) return read_text(file);
  inherit_from_base(document);
  return document.text();
}

std::vector<LibraryMaterial> library_materials() {
  std::vector<LibraryMaterial> materials;
  for (const auto& [stem, file] : library_files()) {
    try {
      const Head head = declare_file(file).head;
      materials.push_back({head.name, file, head.note, head.group});
    } catch (const InputError& fault) {
      materials.push_back({stem, file, fmt::format("cannot be read: {}", fault.what()), ""});
    }
  }
  return materials;
}

}  // namespace whipple
