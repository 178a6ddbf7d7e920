// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "src/core/base/files.hpp"

namespace whipple::decks::dyna {
namespace {

constexpr int deepest_include = 20;

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

/// Typographic dashes and minus signs, which copied cards hold, in UTF-8.
constexpr std::array dashes = {"\xE2\x80\x90", "\xE2\x80\x91", "\xE2\x80\x92", "\xE2\x80\x93",
                               "\xE2\x88\x92"};

std::string with_plain_minus(std::string text) {
  for (const std::string_view dash : dashes) {
    for (std::size_t at = text.find(dash); at != std::string::npos; at = text.find(dash, at))
      text.replace(at, dash.size(), "-");
  }
  return text;
}

/// Puts the missing letter into "1.5-3", and an e for a d.
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

std::optional<double> number_of(const std::string& text) {
  const std::string plain = with_exponent(text);
  double value = 0.0;
  const auto [end, code] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (code != std::errc{} || end != plain.data() + plain.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void read_blocks(Deck& deck, const std::filesystem::path& file, std::string_view text, int depth);

void include(Deck& deck, const Block& block, int depth) {
  if (block.keyword != "INCLUDE")
    fail(block, "of the keywords *INCLUDE_... none is read: put its file into the deck");
  if (depth >= deepest_include) fail(block, "files include one another too deeply");
  for (const Card& card : block.cards) {
    const std::filesystem::path path = std::filesystem::path(block.file).parent_path() / trimmed(card.text);
    std::ifstream stream(regular_file(path, std::uintmax_t{1} << 30), std::ios::binary);
    if (!stream) fail(block, fmt::format("the included file {} cannot be read", path.string()));
    std::ostringstream content;
    content << stream.rdbuf();
    read_blocks(deck, path, content.str(), depth + 1);
  }
}

void parameters(Deck& deck, const Block& block) {
  for (const Card& card : block.cards) {
    const Fields fields(deck, block, card);
    for (std::size_t i = 0; i + 1 < fields.size(); i += 2) {
      std::string name =
          capitals(trimmed(std::string_view(card.text).substr(std::min(card.text.size(), 10 * i), 10)));
      if (const std::size_t comma = card.text.find(','); comma != std::string::npos)
        name = capitals(trimmed(card.text.substr(0, comma)));
      if (name.size() < 2) continue;
      if (name[0] == 'C') continue;  // a text
      if (const auto value = fields.number(i + 1))
        deck.parameters[trimmed(name.substr(1))] = *value;  // without R or I
    }
  }
}

void read_blocks(Deck& deck, const std::filesystem::path& file, std::string_view text, int depth) {
  Block block;
  bool ended = false, title_expected = false;
  const auto close = [&] {
    if (block.keyword.starts_with("INCLUDE")) {
      include(deck, block, depth);
    } else if (block.keyword == "PARAMETER") {
      parameters(deck, block);
    }
    if (!block.keyword.empty()) deck.blocks.push_back(std::move(block));
    block = {};
  };
  unsigned line = 0;
  while (!text.empty() && !ended) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string content(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    while (!content.empty() && content.back() == '\r') content.pop_back();
    if (content.starts_with('$')) continue;
    if (content.starts_with('*')) {
      close();
      block.file = file.string();
      block.line = line;
      block.keyword = capitals(trimmed(std::string_view(content).substr(1)));
      while (!block.keyword.empty() &&
             (block.keyword.back() == '+' || block.keyword.back() == '%' || block.keyword.back() == ' ')) {
        block.wide = block.wide || block.keyword.back() == '+';
        block.keyword.pop_back();
      }
      title_expected = block.keyword.ends_with("_TITLE");
      if (title_expected) block.keyword.resize(block.keyword.size() - 6);
      ended = block.keyword == "END";
    } else if (!block.keyword.empty()) {
      if (title_expected) {
        block.title = trimmed(content);
        title_expected = false;
      } else {
        block.cards.push_back({line, with_plain_minus(std::move(content))});
      }
    }
  }
  close();
}

}  // namespace

void fail(const Block& block, std::string text) {
  throw InputError(std::vector<InputFault>{{.file = block.file,
                                            .line = block.line,
                                            .column = 1,
                                            .text = fmt::format("*{}: {}", block.keyword, text)}});
}

Fields::Fields(const Deck& deck, const Block& block, const Card& card, std::span<const int> widths)
    : deck_(deck), block_(block), line_(card.line) {
  const std::string_view text = card.text;
  std::size_t at = 0;
  if (text.find(',') != std::string_view::npos) {
    while (at <= text.size()) {
      const std::size_t end = std::min(text.find(',', at), text.size());
      texts_.push_back(trimmed(text.substr(at, end - at)));
      columns_.push_back(static_cast<unsigned>(at + 1));
      at = end + 1;
    }
    return;
  }
  const std::size_t tab = text.substr(0, text.find_last_not_of(" \t\r") + 1).find('\t');
  if (tab != std::string_view::npos) {
    columns_.push_back(static_cast<unsigned>(tab + 1));
    fail(0, "a tab in a card whose fields are columns: write blanks instead");
  }
  for (const int width : widths) {
    const std::size_t length = block.wide ? 20 : static_cast<std::size_t>(width);
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
    const auto found = deck_.parameters.find(capitals(trimmed(text.substr(name + 1))));
    if (found == deck_.parameters.end())
      fail(field, fmt::format("'{}' is no parameter that the deck has given before", text));
    return text[0] == '-' ? -found->second : found->second;
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
    // Abaqus has *PART, too, with a comma and a name behind it.
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line.starts_with('*') && line.find(',') != std::string_view::npos) return false;
    if (std::ranges::any_of(starts, [&](const char* start) { return line.starts_with(start); })) return true;
    const std::size_t end = all.find('\n', at);
    if (end == std::string::npos) return false;
    at = end + 1;
  }
  return false;
}

Deck parse(const std::filesystem::path& file, std::string_view text) {
  Deck deck;
  deck.file = file;
  read_blocks(deck, file, text, 0);
  return deck;
}

}  // namespace whipple::decks::dyna
