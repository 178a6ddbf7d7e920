// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/base/text.hpp"

/// Catalogues of the models that a file can select, one line per model: equations of state, strength, failure.
namespace whipple {

/// Reads the bound constants of a model (from a material file, a fit, a test). May leave a constant unchanged and
/// report the fault separately: the model is built later.
using ParameterReader = std::function<void(std::span<const BoundParameter>)>;

/// Describes a model whose constants have been read and which has not been built yet.
template <class Interface, class... Arguments>
struct DeclaredModel {
  /// Builds the model; throws InputError for contradictory constants.
  std::function<std::unique_ptr<Interface>(Arguments...)> build;
  std::vector<std::filesystem::path> companions = {};  ///< files that it reads, as named by the constants
};

/// Describes one model of a catalogue.
/// @tparam Arguments  arguments of its builder in addition to the constants
template <class Interface, class... Arguments>
struct CatalogueEntry {
  using Declared = DeclaredModel<Interface, Arguments...>;
  std::string name;                       ///< the word after `model =`
  std::string summary;                    ///< one line
  std::function<std::string()> describe;  ///< equations, source and table of constants
  /// Reads the constants through the reader and returns a builder for later use, so that a document reports all of its
  /// errors before any model is built.
  std::function<Declared(const ParameterReader&)> declare;
};

/// Creates the entry of a model from the table of its constants.
/// @param theory      equations and source, a paragraph before the table; may be empty
/// @param build       builds the model from the constants and the arguments of the builder of the entry
/// @param companions  returns the files that the model reads, from the constants
template <class Entry, class Constants, class Build>
Entry catalogue_entry(
    std::string_view name, std::string_view summary, std::string_view theory,
    ParameterTable<Constants> (*parameters)(), Build build,
    std::function<std::vector<std::filesystem::path>(const std::type_identity_t<Constants>&)> companions =
        nullptr) {
  Entry entry;
  entry.name = name;
  entry.summary = summary;
  entry.describe = [theory = std::string(theory), parameters] {
    return (theory.empty() ? "" : theory + "\n") + describe_table(parameters());
  };
  entry.declare = [parameters, build, companions](const ParameterReader& read) -> typename Entry::Declared {
    Constants constants;
    read(whipple::bind(parameters(), constants));
    return {[constants, build](auto... arguments) { return build(constants, std::move(arguments)...); },
            companions ? companions(constants) : std::vector<std::filesystem::path>()};
  };
  return entry;
}

/// Holds all entries of one kind, in the order in which they are listed.
template <class Entry>
class Catalogue {
 public:
  /// Creates a catalogue.
  /// @param kind  of the entries, for messages: "equation of state"
  Catalogue(std::string kind, std::vector<Entry> entries)
      : kind_(std::move(kind)), entries_(std::move(entries)) {}

  [[nodiscard]] auto begin() const { return entries_.begin(); }
  [[nodiscard]] auto end() const { return entries_.end(); }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_) names.push_back(entry.name);
    return names;
  }

  /// Returns the entry with a name; null if there is none.
  [[nodiscard]] const Entry* find(std::string_view name) const {
    const auto found = std::ranges::find(entries_, name, &Entry::name);
    return found == entries_.end() ? nullptr : &*found;
  }

  /// Returns the entry with a name.
  /// @throws InputError with the nearest and all known names
  [[nodiscard]] const Entry& at(std::string_view name) const {
    if (const Entry* entry = find(name)) return *entry;
    const std::vector<std::string> known = names();
    throw InputError(fmt::format("unknown {} {}{}; known: {}", kind_, toml_string(name),
                                 did_you_mean(name, known), fmt::join(known, ", ")));
  }

  /// Returns the text of `whipple describe KIND [NAME]`: the summaries of all entries, or the full description of one.
  /// @throws InputError for an unknown name
  [[nodiscard]] std::string describe(std::string_view name = {}) const {
    if (!name.empty()) {
      const Entry& entry = at(name);
      return fmt::format("{}: {}\n{}", entry.name, entry.summary, entry.describe());
    }
    std::string text;
    for (const Entry& entry : entries_) text += fmt::format("{:<18}  {}\n", entry.name, entry.summary);
    return text;
  }

 private:
  std::string kind_;
  std::vector<Entry> entries_;
};

}  // namespace whipple
