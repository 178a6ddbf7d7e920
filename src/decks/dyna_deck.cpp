// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "src/decks/deck_text.hpp"
#include "src/decks/dyna_parameters.hpp"

namespace whipple::decks::dyna {
namespace {

constexpr int deepest_include = 20;

/// Lists typographic dashes and minus signs, which occur in copied cards, in UTF-8.
constexpr std::array dashes = {"\xE2\x80\x90", "\xE2\x80\x91", "\xE2\x80\x92", "\xE2\x80\x93",
                               "\xE2\x88\x92"};

std::string with_plain_minus(std::string text) {
  for (const std::string_view dash : dashes) {
    for (std::size_t at = text.find(dash); at != std::string::npos; at = text.find(dash, at))
      text.replace(at, dash.size(), "-");
  }
  return text;
}

/// Inserts the missing exponent letter in "1.5-3", and replaces d by e.
std::string with_exponent(std::string text) {
  for (char& c : text) {
    if (c == 'd' || c == 'D' || c == 'E') c = 'e';
  }
  if (text.find('e') == std::string::npos && text.find('.') != std::string::npos) {
    const std::size_t sign = text.find_first_of("+-", 1);
    if (sign != std::string::npos) text.insert(sign, "e");
  }
  if (text.starts_with('+')) text.erase(0, 1);
  const std::size_t plus = text.find("e+");
  if (plus != std::string::npos) text.erase(plus + 1, 1);
  return text;
}

/// Reads the lines of a deck and of the files that it includes.
class BlockReader {
 public:
  BlockReader(Deck& deck, const IncludeLimits& limits) : deck_(deck), limits_(limits) {}

  void read(const std::filesystem::path& file, std::string_view text, int depth) {
    Block block;
    bool ended = false, title_expected = false;
    unsigned line = 0;
    while (!text.empty() && !ended) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string content(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      ++line;
      while (!content.empty() && content.back() == '\r') content.pop_back();
      if (content.starts_with('$')) continue;
      if (content.starts_with('*')) {
        close(block, depth);
        block.file = file.string();
        block.is_included = depth > 0;
        block.line = line;
        title_expected = begin(block, std::string_view(content).substr(1));
        ended = block.keyword == "END";
      } else if (title_expected) {
        block.title = trimmed(content);
        title_expected = false;
      } else if (!block.keyword.empty()) {
        block.cards.push_back({line, with_plain_minus(std::move(content))});
      } else if (depth > 0 && !trimmed(content).empty()) {
        block.keyword = "INCLUDE";
        block.file = file.string();
        fail(block, line, "an included file begins with a keyword, such as *NODE");
      }
    }
    close(block, depth);
  }

 private:
  /// Reads a keyword with the sign of its layout; returns whether a title line follows.
  bool begin(Block& block, std::string_view line) {
    const std::string words = capitals(trimmed(line));
    const std::size_t end = std::min(words.find_first_of(" \t"), words.size());
    block.keyword = words.substr(0, end);
    block.behind = trimmed(std::string_view(words).substr(end));
    block.layout = usual_;
    const auto take_sign = [&](char sign) {
      if (sign == '+') block.layout = Layout::wide;
      if (sign == '-') block.layout = Layout::standard;
      if (sign == '%') block.layout = Layout::long_ids;
      return sign == '+' || sign == '-' || sign == '%';
    };
    while (!block.keyword.empty() && take_sign(block.keyword.back())) block.keyword.pop_back();
    while (!block.behind.empty() && take_sign(block.behind.front()))
      block.behind = trimmed(std::string_view(block.behind).substr(1));
    if (block.behind.starts_with('$')) block.behind.clear();
    if (block.keyword.starts_with("KEYWORD")) {
      if (block.behind.find("I10=Y") != std::string::npos) usual_ = Layout::long_ids;
      if (block.behind.find("LONG=Y") != std::string::npos) usual_ = Layout::wide;
    }
    constexpr std::string_view titled = "_TITLE";
    const bool title = block.keyword.ends_with(titled);
    if (title) block.keyword.resize(block.keyword.size() - titled.size());
    return title;
  }

  void close(Block& block, int depth) {
    if (block.keyword.starts_with("INCLUDE")) {
      include(block, depth);
    } else {
      read_parameters(deck_, block);
    }
    if (!block.keyword.empty()) deck_.blocks.push_back(std::move(block));
    block = {};
  }

  void include(const Block& block, int depth) {
    if (block.keyword != "INCLUDE")
      fail(block, "of the keywords *INCLUDE_... none is read: put its file into the deck");
    if (depth >= deepest_include) fail(block, "files include one another too deeply");
    for (const Card& card : block.cards) {
      const std::string name = trimmed(card.text);
      if (name.empty()) continue;
      if (++included_ > limits_.files)
        fail(block, fmt::format("more than {} files are included", limits_.files));
      const std::filesystem::path path = std::filesystem::path(block.file).parent_path() / name;
      const std::string text = included_text(block, card, path);
      included_bytes_ += text.size();
      if (included_bytes_ > limits_.bytes)
        fail(block, fmt::format("files of more than {} bytes are included", limits_.bytes));
      read(path, text, depth + 1);
    }
  }

  /// Reads an included file; its faults are attributed to the card that names it.
  static std::string included_text(const Block& block, const Card& card, const std::filesystem::path& path) {
    try {
      return deck_text(path);
    } catch (const InputError& error) {
      std::string reason = error.what();
      constexpr std::string_view mark = ": error: ";
      if (const std::size_t at = reason.find(mark); at != std::string::npos)
        reason.replace(at, mark.size(), ": ");
      fail(block, card.line, reason);
    }
  }

  Deck& deck_;
  const IncludeLimits& limits_;
  Layout usual_ = Layout::standard;  ///< of keywords without a sign
  std::size_t included_ = 0, included_bytes_ = 0;
};

}  // namespace

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1));
}

std::string capitals(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::optional<double> number_of(const std::string& text) {
  const std::string plain = with_exponent(text);
  double value = 0.0;
  const auto [end, code] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (code != std::errc{} || end != plain.data() + plain.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Place place_of(const Block& block) { return place_of(block, block.line); }
Place place_of(const Block& block, unsigned line) {
  return {line, block.is_included ? block.file : std::string()};
}

void fail(const Block& block, std::string text) { fail(block, block.line, std::move(text)); }
void fail(const Block& block, unsigned line, std::string text) {
  throw InputError(std::vector<InputFault>{
      {.file = block.file, .line = line, .column = 1, .text = fmt::format("*{}: {}", block.keyword, text)}});
}

Fields::Fields(const Deck& deck, const Block& block, const Card& card, std::span<const int> widths)
    : deck_(deck), block_(block), line_(card.line) {
  std::vector<std::size_t> lengths;
  std::size_t columns = 0;
  for (const int width : widths) {
    const auto usual = static_cast<std::size_t>(width);
    lengths.push_back(block.layout == Layout::wide                     ? 20
                      : block.layout == Layout::long_ids && usual == 8 ? 10
                                                                       : usual);
    columns += lengths.back();
  }
  std::string_view text = card.text;
  // Remarks may follow the columns of the fields, and may contain commas.
  const bool between_commas = text.substr(0, columns).find(',') != std::string_view::npos;
  std::size_t at = 0;
  if (between_commas) {
    while (at <= text.size()) {
      const std::size_t end = std::min(text.find(',', at), text.size());
      texts_.push_back(trimmed(text.substr(at, end - at)));
      columns_.push_back(static_cast<unsigned>(at + 1));
      at = end + 1;
    }
    return;
  }
  text = text.substr(0, columns);
  const std::size_t tab = text.substr(0, text.find_last_not_of(" \t\r") + 1).find('\t');
  if (tab != std::string_view::npos) {
    columns_.push_back(static_cast<unsigned>(tab + 1));
    fail(0, "a tab in a card whose fields are columns: write blanks instead");
  }
  for (const std::size_t length : lengths) {
    texts_.push_back(at < text.size() ? trimmed(text.substr(at, length)) : "");
    columns_.push_back(static_cast<unsigned>(at + 1));
    at += length;
  }
}

void Fields::fail(std::size_t field, std::string text) const {
  throw InputError(std::vector<InputFault>{{.file = block_.file,
                                            .line = line_,
                                            .column = field < columns_.size() ? columns_[field] : 1,
                                            .text = fmt::format("*{}: {}", block_.keyword, text)}});
}

std::optional<double> Fields::number(std::size_t field) const {
  if (field >= texts_.size() || texts_[field].empty()) return std::nullopt;
  const std::string& text = texts_[field];
  const std::size_t name = text.find('&');
  if (name != std::string::npos && name <= 1) {
    const std::optional<double> found = parameter(deck_, block_.file, text.substr(name + 1));
    if (!found) fail(field, fmt::format("'{}' is no parameter that the deck has given before", text));
    return text[0] == '-' ? -*found : *found;
  }
  const std::optional<double> value = number_of(text);
  if (!value) fail(field, fmt::format("'{}' in field {} is no number", text, field + 1));
  return value;
}

double Fields::required(std::size_t field, std::string_view what) const {
  const std::optional<double> value = number(field);
  if (!value) fail(field, fmt::format("field {}, {}, is blank", field + 1, what));
  return *value;
}

std::int64_t Fields::id(std::size_t field) const {
  const double value = real(field);
  if (std::abs(value) > 1e15) fail(field, fmt::format("field {} is no number of an entity", field + 1));
  return static_cast<std::int64_t>(value);
}

bool recognise(std::string_view text) {
  constexpr std::array starts = {"*KEYWORD", "*TITLE",    "*CONTROL_",  "*PART",     "*MAT_",
                                 "*EOS_",    "*SECTION_", "*DATABASE_", "*PARAMETER"};
  const std::string all = capitals(std::string(text.substr(0, std::size_t{1} << 16)));
  for (std::size_t at = 0; at < all.size();) {
    const std::string_view rest = std::string_view(all).substr(at);
    // Abaqus also has *PART, followed by a comma and a name.
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line.starts_with('*') && line.find(',') != std::string_view::npos) return false;
    if (std::ranges::any_of(starts, [&](const char* start) { return line.starts_with(start); })) return true;
    const std::size_t end = all.find('\n', at);
    if (end == std::string::npos) return false;
    at = end + 1;
  }
  return false;
}

Deck parse(const std::filesystem::path& file, std::string_view text, const IncludeLimits& limits) {
  Deck deck;
  deck.file = file;
  BlockReader(deck, limits).read(file, text, 0);
  return deck;
}

}  // namespace whipple::decks::dyna
