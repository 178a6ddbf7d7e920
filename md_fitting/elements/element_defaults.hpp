// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/words.hpp"

/// Constants that molecular dynamics of nuclei does not determine, per element, each with its name and source: the only
/// place from which the fit takes a number that is not in the store.
namespace whipple::elements {

/// What a constant that is not fitted rests on.
enum class Evidence { chosen, measured };
constexpr std::array<Word<Evidence>, 2> words(Evidence) {
  return {{{Evidence::chosen, "chosen"}, {Evidence::measured, "measured"}}};
}

struct NamedDefault {
  std::string parameter;  ///< key of the model's parameter table
  std::string name;       ///< name of the choice
  double value = 0.0;     ///< SI
  std::string source;
  Evidence evidence = Evidence::chosen;
  double error = 0.0;        ///< SI, one standard deviation; 0: the source gives none
  std::string error_source;  ///< of the error
};

struct ElementDefaults {
  std::string element;  ///< chemical symbol
  std::string metal;    ///< English name
  std::optional<std::string>
      template_name{};                    ///< material of the library with its strength and failure, if any
  std::vector<NamedDefault> constants{};  ///< of several of one parameter the first is the default

  /// The default of a parameter, if there is one.
  [[nodiscard]] const NamedDefault* find(std::string_view parameter) const;
  /// @throws InputError that names the missing constant and the remedy
  [[nodiscard]] const NamedDefault& at(std::string_view parameter) const;
  /// All choices of a parameter, the default first.
  [[nodiscard]] std::vector<const NamedDefault*> choices(std::string_view parameter) const;
};

/// Reads the constants of an element, and those of all metals: from the table of the program
/// (eos/data/elements.toml), or where a file of the user has rows of a parameter from that. An element that neither
/// knows has the common constants only.
/// @throws InputError with file and line
ElementDefaults element_defaults(std::string_view element,
                                 const std::optional<std::filesystem::path>& file_of_user = {});

/// Symbols of the program's table.
std::vector<std::string> known_elements();

/// Says which constants an element lacks, and the remedies.
std::string missing_text(std::string_view element, const std::vector<std::string>& parameters);

/// Says for each constant that a fit lacks how to give it.
std::string remedies(const std::vector<std::string>& parameters);

/// Describes the files of `whipple fit --defaults`.
std::string describe_elements();

}  // namespace whipple::elements
