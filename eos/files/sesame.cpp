// SPDX-License-Identifier: BSD-3-Clause
#include "eos/files/sesame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "eos/files/sesame_layout.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/pattern.hpp"

namespace whipple::eos {
namespace {

namespace fs = std::filesystem;

using namespace sesame_layout;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::optional<int> integer_in(std::string_view line, std::size_t first, std::size_t count) {
  if (line.size() <= first) return std::nullopt;
  const std::string_view word = trimmed(line.substr(first, count));
  int value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || fault != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Holds a Fortran number at the beginning of a text: the E may be a D, or be missing before the sign of the exponent.
struct Real {
  double value = 0;
  std::size_t end = 0;  ///< number of characters including preceding blanks; 0: there is none
};

Real real_at(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_sign = [](char c) { return c == '+' || c == '-'; };
  const auto at = [&](std::size_t i) { return i < text.size() ? text[i] : ' '; };
  std::size_t i = std::min(text.find_first_not_of(' '), text.size());
  std::string number;
  if (is_sign(at(i))) number += at(i++);
  const std::size_t first = i;
  while (is_digit(at(i)) || at(i) == '.') number += at(i++);
  if (i == first) return {};
  const bool marked = at(i) == 'E' || at(i) == 'e' || at(i) == 'D' || at(i) == 'd';
  if (const std::size_t sign = marked ? i + 1 : i;
      is_digit(at(sign + is_sign(at(sign)))) && (marked || is_sign(at(sign)))) {
    number += 'E';
    for (i = sign, number += at(i++); is_digit(at(i));) number += at(i++);
  }
  const char* const begin = number.data() + (number.front() == '+' ? 1 : 0);
  Real result;
  const auto [end, fault] = std::from_chars(begin, number.data() + number.size(), result.value);
  if (fault != std::errc() || end != number.data() + number.size() || !std::isfinite(result.value)) return {};
  result.end = i;
  return result;
}

std::optional<double> real_of(std::string_view word) {
  const Real real = real_at(word);
  if (real.end == 0 || !trimmed(word.substr(real.end)).empty()) return std::nullopt;
  return real.value;
}

constexpr int index_table = 0;  // not a table of a material

struct Header {
  int material = 0, table = 0;
  std::size_t words = 0;
  int created = 0, changed = 0;
};

/// Holds the numbers of one table with their line numbers.
struct Words {
  std::vector<double> values;
  std::size_t first_line = 0;
  std::size_t per_line = words_per_line;
  [[nodiscard]] std::size_t line(std::size_t word) const { return first_line + word / per_line; }
};

class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path), file_(read_text(path)) {
    if (!file_) throw InputError(fmt::format("{}: does not exist or cannot be read", path.string()));
  }

  /// Returns the header of the next table; none at the record that ends the file.
  std::optional<Header> header() {
    do {
      if (!next()) return end_of_file();
    } while (trimmed(text_).empty() && index_);
    if (const auto labelled = labelled_header()) return labelled;
    const std::optional<int> flag = integer_in(text_, 0, 2);
    if (flag == 2) return std::nullopt;
    const auto material = integer_in(text_, 2, 6), table = integer_in(text_, 8, 6),
               words = integer_in(text_, 14, 6);
    if ((flag != 0 && flag != 1) || !material || !table || !words || *words < 1) {
      refuse(line_,
             fmt::format(
                 "expected the header of a table: 0 or 1, material, table and number of words in "
                 "columns 1-2, 3-8, 9-14 and 15-20, or ' INDEX MATID = ... NWDS = ...' and ' RECORD TYPE "
                 "= ... NWDS = ...'; found '{}'. Binary files and the inverted tables of FLASH (.301) are "
                 "other layouts, which are not read",
                 text_.substr(0, 40)));
    }
    return Header{*material, *table, static_cast<std::size_t>(*words), integer_in(text_, 24, 9).value_or(0),
                  integer_in(text_, 33, 9).value_or(0)};
  }

  std::string comment(const Header& header) {
    std::string text;
    for_each_line(header, [&](std::size_t left) {
      const std::size_t count = std::min(comment_width, left);
      text_.resize(count, ' ');
      text += text_;
      return count;
    });
    text.resize(text.find_last_not_of(' ') + 1);
    return text;
  }

  Words words(const Header& header) {
    Words words;
    words.first_line = line_ + 1;
    for_each_line_of_numbers(header, [&](std::size_t count) {
      words.per_line = per_line_;
      for (std::size_t i = 0; i < count; ++i) {
        const std::string_view word = text_.size() > i * width_
                                          ? std::string_view(text_).substr(i * width_, width_)
                                          : std::string_view();
        const std::optional<double> value = real_of(word);
        if (!value) {
          refuse(line_, fmt::format("table {} of material {}: expected a number in columns {}-{}, found '{}'",
                                    header.table, header.material, i * width_ + 1, (i + 1) * width_, word));
        }
        words.values.push_back(*value);
      }
    });
    return words;
  }

  void skip(const Header& header) {
    if (header.table < 200) {  // tables 101 to 199 are text
      for_each_line(header, [](std::size_t left) { return std::min(comment_width, left); });
    } else {
      for_each_line_of_numbers(header, [](std::size_t) {});
    }
  }

  [[noreturn]] void refuse(std::size_t line, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_.string(), line, what));
  }

 private:
  std::optional<Header> end_of_file() const {
    if (line_ == 0) refuse(1, "the file is empty: expected the header of a table");
    // Files with labelled headers have no last record.
    if (!index_) log::warning("{}: ends without its last record ' 2': tables may be missing", path_.string());
    return std::nullopt;
  }

  /// Reads a header in the layout of ANEOS tables: " INDEX MATID = 7 NWDS = 9", then the words of an index of the
  /// material, then " RECORD TYPE = 201 NWDS = 5" before each table.
  std::optional<Header> labelled_header() {
    static const Pattern index_line(R"(\s*INDEX\s+MATID\s*=\s*(\d{1,6})\s+NWDS\s*=\s*(\d{1,8})\s*)"),
        record_line(R"(\s*RECORD\s+TYPE\s*=\s*(\d{1,6})\s+NWDS\s*=\s*(\d{1,8})\s*)");
    if (const auto found = index_line.match(text_)) {
      index_ = std::stoi(found->at(1));
      for_each_line_of_numbers({*index_, index_table, std::stoul(found->at(2))}, [](std::size_t) {});
      if (!next()) refuse(line_, fmt::format("the file ends behind the index of material {}", *index_));
    }
    const auto record = record_line.match(text_);
    if (!index_ || !record) return std::nullopt;
    return Header{*index_, std::stoi(record->at(1)), std::stoul(record->at(2))};
  }

  bool next() {
    if (!std::getline(file_, text_)) return false;
    if (++line_ == 1 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);  // byte order mark
    if (!text_.empty() && text_.back() == '\r') text_.pop_back();
    return true;
  }

  /// Calls visit(entries left) with each line of a table in `text_`; it returns the number of entries consumed.
  template <class Visit>
  void for_each_line(const Header& header, Visit&& visit) {
    for (std::size_t left = header.words; left > 0;) {
      if (!next()) {
        refuse(line_, fmt::format("the file ends in table {} of material {}: expected {} more of {} words",
                                  header.table, header.material, left, header.words));
      }
      left -= visit(left);
    }
  }

  /// Calls visit(number of words) with each line. The first word of a table gives the column width, and a line has
  /// as many words as columns; a remainder shorter than a column contains flags.
  template <class Visit>
  void for_each_line_of_numbers(const Header& header, Visit&& visit) {
    width_ = 0;
    for_each_line(header, [&](std::size_t left) {
      if (width_ == 0) {
        const std::size_t first = real_at(text_).end;
        width_ = first >= least_word_width ? first : word_width;
        per_line_ = std::max<std::size_t>(1, (text_.find_last_not_of(' ') + 1) / width_);
      }
      const std::size_t count = std::min(per_line_, left);
      visit(count);
      return count;
    });
  }

  fs::path path_;
  std::istringstream file_;
  std::string text_;
  std::size_t line_ = 0, width_ = 0, per_line_ = words_per_line;
  std::optional<int> index_;  ///< material of the last index line, in files with labelled headers
};

/// Parses a table: a count, then columns.
class Parts {
 public:
  Parts(const Reader& reader, const Header& header, const Words& words)
      : reader_(reader), header_(header), words_(words) {}

  std::size_t count(const char* what, std::size_t least) {
    const double value = words_.values[at_];
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most_words)) ||
        value != std::floor(value)) {
      refuse(
          fmt::format("expected the number of {}, an integer of at least {}, found {}", what, least, value));
    }
    ++at_;
    return static_cast<std::size_t>(value);
  }

  std::vector<double> column(std::size_t count, double unit) {
    const auto first = words_.values.begin() + static_cast<std::ptrdiff_t>(at_);
    std::vector<double> values(first, first + static_cast<std::ptrdiff_t>(count));
    for (double& value : values) value *= unit;
    at_ += count;
    return values;
  }

  /// Returns a column that increases strictly from zero or more.
  std::vector<double> axis(const char* what, std::size_t count, double unit) {
    const std::size_t first = at_;
    const std::vector<double> values = column(count, unit);
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0 ? values[i] > values[i - 1] : values[i] >= 0) continue;
      at_ = first + i;
      refuse(fmt::format("{} {} is {}, expected {}: the grid must rise from zero or more", what, i + 1,
                         words_.values[at_],
                         i > 0 ? fmt::format("more than {}", words_.values[at_ - 1]) : "at least 0"));
    }
    return values;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    reader_.refuse(words_.line(at_),
                   fmt::format("table {} of material {}: {}", header_.table, header_.material, what));
  }

 private:
  const Reader& reader_;
  const Header& header_;
  const Words& words_;
  std::size_t at_ = 0;
};

SesameGrid grid_of(const Reader& reader, const Header& header, const Words& words) {
  Parts parts(reader, header, words);
  if (header.words < 2) parts.refuse("expected the numbers of densities and temperatures");
  const std::size_t nr = parts.count("densities", 2), nt = parts.count("temperatures", 2);
  const std::size_t axes = 2 + nr + nt, states = nr * nt;
  if (header.words != axes + 2 * states && header.words != axes + 3 * states) {
    parts.refuse(
        fmt::format("{} densities and {} temperatures: expected {} words (p, e), or {} (p, e, Helmholtz "
                    "energy), the header says {}",
                    nr, nt, axes + 2 * states, axes + 3 * states, header.words));
  }
  SesameGrid grid;
  grid.density = parts.axis("density", nr, Mg_m3);
  grid.temperature = parts.axis("temperature", nt, K);
  grid.pressure = parts.column(states, GPa);
  grid.energy = parts.column(states, MJ_kg);
  if (header.words == axes + 3 * states) grid.helmholtz = parts.column(states, MJ_kg);
  return grid;
}

SesameVaporisation vaporisation_of(const Reader& reader, const Header& header, const Words& words) {
  Parts parts(reader, header, words);
  const std::size_t n = parts.count("temperatures", 1);
  if (header.words != 1 + 6 * n && header.words != 1 + 8 * n) {
    parts.refuse(
        fmt::format("{} temperatures: expected {} words, or {} with Helmholtz energies, the header says {}",
                    n, 1 + 6 * n, 1 + 8 * n, header.words));
  }
  SesameVaporisation v;
  v.pressure = parts.column(n, GPa);
  v.temperature = parts.axis("temperature", n, K);
  v.vapour_density = parts.column(n, Mg_m3);
  v.liquid_density = parts.column(n, Mg_m3);
  v.vapour_energy = parts.column(n, MJ_kg);
  v.liquid_energy = parts.column(n, MJ_kg);
  if (header.words == 1 + 8 * n) {
    v.vapour_helmholtz = parts.column(n, MJ_kg);
    v.liquid_helmholtz = parts.column(n, MJ_kg);
  }
  return v;
}

}  // namespace

SesameMaterial read_sesame(const fs::path& path, std::optional<int> number) {
  Reader reader(path);
  std::vector<int> found;
  SesameMaterial result;
  bool with_constants = false;
  while (const std::optional<Header> header = reader.header()) {
    if (std::ranges::find(found, header->material) == found.end()) found.push_back(header->material);
    if (header->material != number.value_or(found.front())) {
      reader.skip(*header);
      continue;
    }
    result.number = header->material;
    switch (header->table) {
      case 101:
        result.comment = reader.comment(*header);
        result.created = header->created;
        result.changed = header->changed;
        break;
      case 201: {
        const Words words = reader.words(*header);
        if (header->words < 5) {
          reader.refuse(words.first_line,
                        fmt::format("table 201 of material {}: expected 5 words or more, the header says {}",
                                    header->material, header->words));
        }
        result.atomic_number = words.values[0];
        result.atomic_mass = words.values[1] * g_mol;
        result.reference_density = words.values[2] * Mg_m3;
        result.bulk_modulus = words.values[3] * GPa;
        result.exchange_coefficient = words.values[4];
        if (!(result.reference_density > 0)) {
          reader.refuse(words.first_line,
                        fmt::format("table 201 of material {}: expected a positive reference density, "
                                    "found {}",
                                    header->material, words.values[2]));
        }
        with_constants = true;
        break;
      }
      case 301:
        result.total = grid_of(reader, *header, reader.words(*header));
        break;
      case 401:
        result.vaporisation = vaporisation_of(reader, *header, reader.words(*header));
        break;
      default:
        reader.skip(*header);
    }
  }
  const std::string name = path.string();
  if (!number && found.size() > 1) {
    throw InputError(
        fmt::format("{}: holds the materials {}: expected the number of one", name, fmt::join(found, ", ")));
  }
  if (result.number == 0) {
    throw InputError(fmt::format("{}: holds no material {}; it holds {}", name, number.value_or(0),
                                 found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", "))));
  }
  if (!with_constants || result.total.density.empty()) {
    throw InputError(
        fmt::format("{}: material {} has no table {}", name, result.number, with_constants ? 301 : 201));
  }
  return result;
}

}  // namespace whipple::eos
