// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/words.hpp"

/// Provides the constants of each element that molecular dynamics of nuclei does not determine, each with its name
/// and source. The fit takes numbers that are not in the database from here only.
namespace whipple::elements {

/// Specifies the basis of a constant that is not fitted.
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
  std::string error_source;  ///< source of the error
};

struct ElementDefaults {
  std::string element;                         ///< chemical symbol
  std::string metal;                           ///< English name
  std::optional<std::string> template_name{};  ///< library material with strength and failure
  std::vector<NamedDefault> constants{};       ///< several for one parameter: the first is the default

  /// Returns the default of a parameter, if there is one.
  [[nodiscard]] const NamedDefault* find(std::string_view parameter) const;
  /// Returns the default of a parameter. @throws InputError naming the missing constant and the remedy
  [[nodiscard]] const NamedDefault& at(std::string_view parameter) const;
  /// Returns all choices of a parameter, the default first.
  [[nodiscard]] std::vector<const NamedDefault*> choices(std::string_view parameter) const;
};

/// Reads the constants of an element and those common to all metals from the program's table
/// (eos/data/elements.toml); rows for a parameter in the user's file replace those of the table. An element absent
/// from both has the common constants only.
/// @throws InputError with file and line
ElementDefaults element_defaults(std::string_view element,
                                 const std::optional<std::filesystem::path>& file_of_user = {});

/// Returns the symbols in the program's table.
std::vector<std::string> known_elements();

/// Describes which constants an element lacks, with the remedies.
std::string missing_text(std::string_view element, const std::vector<std::string>& parameters);

/// Describes, for each constant that a fit lacks, how to supply it.
std::string remedies(const std::vector<std::string>& parameters);

/// Describes the files of `whipple fit --defaults`.
std::string describe_elements();

}  // namespace whipple::elements
