// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/decks/report.hpp"

/// Reads keyword decks of LS-DYNA.
namespace whipple::decks::dyna {

inline constexpr const char* grammar = "LS-DYNA keywords";

/// Holds a line of data below a keyword.
struct Card {
  unsigned line = 0;
  std::string text;
};

/// Lists the field widths of cards.
enum class Layout : std::uint8_t {
  standard,
  long_ids,  ///< numbers of nodes and elements have ten characters instead of eight
  wide,      ///< every field has twenty characters
};

/// Holds a keyword with its cards.
struct Block {
  std::string keyword;  ///< upper case, without the asterisk and _TITLE
  std::string behind;   ///< text after the keyword in its line
  std::string file;     ///< the deck or a file that it includes
  bool is_included = false;
  unsigned line = 0;
  std::string title;  ///< of a keyword with _TITLE
  Layout layout = Layout::standard;
  std::vector<Card> cards;
};

using Parameters = std::map<std::string, double>;

struct Deck {
  /// Records an action of the reader on a statement.
  struct Note {
    Place place;
    std::string keyword, text;
  };
  std::filesystem::path file;
  std::vector<Block> blocks;
  Parameters parameters;                      ///< of *PARAMETER, by name in upper case
  std::map<std::string, Parameters> of_file;  ///< of *PARAMETER_LOCAL, by the file in which they are valid
  std::vector<Note> notes;
};

/// Defines the field widths of a card in characters.
inline constexpr int usual_widths[] = {10, 10, 10, 10, 10, 10, 10, 10};
inline constexpr int node_widths[] = {8, 16, 16, 16, 8, 8};
inline constexpr int solid_widths[] = {8, 8, 8, 8, 8, 8, 8, 8, 8, 8};
inline constexpr int sph_widths[] = {8, 8, 16, 8};

/// Splits a card into fields: by columns, or by commas if it contains one. Fields beyond its end are blank; text after
/// the columns of a card is a remark.
class Fields {
 public:
  Fields(const Deck& deck, const Block& block, const Card& card, std::span<const int> widths = usual_widths);

  /// Returns the number in a field; nothing if it is blank. Accepts "1.5-3" for 1.5e-3, typographic minus signs and the
  /// name of a parameter, "&name".
  /// @throws InputError with file, line and column if it is not a number
  [[nodiscard]] std::optional<double> number(std::size_t field) const;
  /// Returns the number in a field that must not be blank.
  /// @throws InputError that names the field by `what`
  [[nodiscard]] double required(std::size_t field, std::string_view what) const;
  /// Returns the number in a field, 0 if it is blank, as in LS-DYNA.
  [[nodiscard]] double real(std::size_t field) const { return number(field).value_or(0.0); }
  /// Returns a field as the number of a node, part, set or similar; 0 if it is blank.
  [[nodiscard]] std::int64_t id(std::size_t field) const;
  /// Returns the text of a field, without surrounding blanks.
  [[nodiscard]] std::string_view text(std::size_t field) const {
    return field < texts_.size() ? std::string_view(texts_[field]) : std::string_view();
  }
  [[nodiscard]] std::size_t size() const { return texts_.size(); }

 private:
  [[noreturn]] void fail(std::size_t field, std::string text) const;

  const Deck& deck_;
  const Block& block_;
  unsigned line_;
  std::vector<std::string> texts_;
  std::vector<unsigned> columns_;
};

/// Parses a number in deck notation: "1.5-3" is 1.5e-3, "1d3" 1e3; returns nothing if it is not a number.
std::optional<double> number_of(const std::string& text);

/// Returns a text without surrounding blanks; `capitals` returns it in capital letters.
std::string trimmed(std::string_view text);

inline bool is_blank(const Card& card) { return trimmed(card.text).empty(); }
std::string capitals(std::string text);

/// Returns whether the first keyword of a text belongs to LS-DYNA.
bool recognise(std::string_view text);

/// Limits the included files, which may include one another recursively.
struct IncludeLimits {
  std::size_t files = 1000;                  ///< two includes per file give 2^19 files at the deepest level
  std::size_t bytes = std::size_t{1} << 30;  ///< total size
};

/// Reads a deck with the files that it includes.
/// @throws InputError with all faults
Deck parse(const std::filesystem::path& file, std::string_view text, const IncludeLimits& limits = {});

/// Returns the place of a keyword, or of one of its lines.
Place place_of(const Block& block);
Place place_of(const Block& block, unsigned line);

/// Throws an InputError at a keyword, or at one of its lines.
[[noreturn]] void fail(const Block& block, std::string text);
[[noreturn]] void fail(const Block& block, unsigned line, std::string text);

}  // namespace whipple::decks::dyna
