// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/mpm3d_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <ranges>
#include <span>

#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"

namespace whipple::decks::mpm3d {
namespace {

constexpr std::size_t longest_line = 256, most_words = 15, most_faults = 20;

struct Token {
  std::string_view text;
  unsigned line = 0, column = 0;
};

/// Defines a second word and the number of numbers that follow it.
struct Kind {
  std::string_view word;
  std::size_t numbers;
};
constexpr std::array material_kinds = {Kind{"elas", 3}, Kind{"pla1", 4}, Kind{"pla2", 5}, Kind{"john", 12},
                                       Kind{"sjc", 8},  Kind{"sjcf", 9}, Kind{"jcf", 13}, Kind{"hiex", 2},
                                       Kind{"null", 3}, Kind{"dpm", 7},  Kind{"neoh", 3}};
/// Counts component, material, density, spacing, a point and the values of the kind; the points of "poin" are read
/// separately.
constexpr std::array body_kinds = {Kind{"poin", 2}, Kind{"bloc", 10}, Kind{"sphe", 8}, Kind{"blod", 14},
                                   Kind{"cicl", 8}};
constexpr std::array load_kinds = {Kind{"endl", 0}, Kind{"part", 4}, Kind{"body", 4}, Kind{"grav", 4},
                                   Kind{"node", 4}};
constexpr std::array velocity_kinds = {Kind{"endv", 0}, Kind{"node", 4}, Kind{"body", 4},
                                       Kind{"ksin", 2}, Kind{"nuli", 1}, Kind{"vsin", 1}};
constexpr std::array contact_kinds = {Kind{"lagr", 2}, Kind{"othe", 2}};
constexpr std::array switch_kinds = {Kind{"on", 0}, Kind{"off", 0}};
constexpr std::array fields = {
    Kind{"seqv", 0}, Kind{"epef", 0}, Kind{"mat", 0},  Kind{"pres", 0}, Kind{"volu", 0}, Kind{"engk", 0},
    Kind{"engi", 0}, Kind{"velx", 0}, Kind{"vely", 0}, Kind{"velz", 0}, Kind{"cels", 0}, Kind{"fail", 0},
    Kind{"sspd", 0}, Kind{"damg", 0}, Kind{"stsx", 0}, Kind{"disx", 0}, Kind{"disy", 0}, Kind{"disz", 0}};
/// Counts the constants of the equations of state 1 to 4.
constexpr std::array<std::size_t, 4> state_constants = {8, 4, 6, 1};

/// Returns how many numbers follow keywords without a second word.
std::size_t numbers_after(Keyword keyword) {
  switch (keyword) {
    case Keyword::grid:
    case Keyword::fixed:
    case Keyword::window:
      return 6;
    case Keyword::detonation:
      return 3;
    case Keyword::span_x:
    case Keyword::span_y:
    case Keyword::span_z:
    case Keyword::bulk_viscosity:
      return 2;
    case Keyword::particles:
    case Keyword::materials:
    case Keyword::components:
    case Keyword::bodies:
    case Keyword::cell:
    case Keyword::end_time:
    case Keyword::output_interval:
    case Keyword::report_interval:
    case Keyword::time_step_factor:
    case Keyword::quasi_static:
    case Keyword::damping:
      return 1;
    default:
      return 0;
  }
}

std::string key_of(std::string_view word) {
  std::string key(word.substr(0, 4));
  std::ranges::transform(key, key.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return key;
}

std::optional<Keyword> keyword_of(std::string_view word) {
  const std::string key = key_of(word);
  for (const Word<Keyword>& known : words(Keyword{})) {
    if (known.text == key) return known.value;
  }
  return std::nullopt;
}

/// Carries a fault of the deck out of its statement as an exception.
struct Broken {
  InputFault fault;
};

class Reader {
 public:
  Reader(Deck& deck, std::string_view text) : deck_(deck), text_(text) {}

  void read() {
    while (!ended_ && faults_.size() < most_faults) {
      try {
        statement();
      } catch (const Broken& broken) {
        faults_.push_back(broken.fault);
        if (at_end_) break;
        words_.clear();
        resume();
      }
    }
    if (!faults_.empty()) throw InputError(std::move(faults_));
  }

 private:
  [[nodiscard]] InputFault fault(const Token& at, std::string what) const {
    return {.file = deck_.file.string(), .line = at.line, .column = at.column, .text = std::move(what)};
  }
  [[noreturn]] void fail(const Token& at, std::string what) const {
    throw Broken{fault(at, std::move(what))};
  }

  /// Reads the next line that contains words; returns false at the end of the text.
  bool next_line() {
    words_.clear();
    while (words_.empty()) {
      if (text_.empty()) return false;
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view content = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      while (!content.empty() && content.back() == '\r') content.remove_suffix(1);
      find_units(content);
      if (content.size() > longest_line) {
        deck_.notes.emplace_back(
            line_, fmt::format("MPM3D-F90 reads no more than {} characters of a line; the rest is left out",
                               longest_line));
        content = content.substr(0, longest_line);
      }
      content = content.substr(0, content.find('!'));
      rest_ = content;
      constexpr std::string_view between = " \t,";
      for (std::size_t begin = content.find_first_not_of(between); begin != std::string_view::npos;) {
        const std::size_t stop = std::min(content.find_first_of(between, begin), content.size());
        words_.push_back({content.substr(begin, stop - begin), line_, static_cast<unsigned>(begin + 1)});
        begin = content.find_first_not_of(between, stop);
      }
      if (words_.size() > most_words) {
        deck_.notes.emplace_back(
            line_, fmt::format("{} words in a line: MPM3D-F90 has room for {}; all are read here",
                               words_.size(), most_words));
      }
    }
    std::ranges::reverse(words_);  // taken from the back
    return true;
  }

  /// Reads the units from the comment "! Unit: mm g N ms MPa".
  void find_units(std::string_view content) {
    const std::size_t comment = content.find('!');
    if (comment == std::string_view::npos || deck_.units) return;
    content.remove_prefix(comment + 1);
    content.remove_prefix(std::min(content.find_first_not_of(" \t!"), content.size()));
    if (key_of(content) != "unit") return;
    const std::size_t colon = content.find_first_of(": \t");
    if (colon == std::string_view::npos) return;
    std::string list(content.substr(colon));
    std::ranges::replace(list, ':', ' ');
    try {
      deck_.units = parse_unit_system(list);
    } catch (const InputError& error) {
      faults_.push_back(fault({content, line_, static_cast<unsigned>(comment + 1)}, error.what()));
    }
    deck_.units_line = line_;
  }

  /// Continues at the next line that begins with a keyword.
  void resume() {
    while (next_line()) {
      if (keyword_of(words_.back().text)) return;
    }
    at_end_ = ended_ = true;
  }

  Token word(std::string_view what) {
    if (words_.empty() && !next_line()) {
      at_end_ = true;
      fail({"", line_, 1}, fmt::format("the file ends where {} is expected; a deck ends with 'endi'", what));
    }
    const Token token = words_.back();
    words_.pop_back();
    return token;
  }

  /// Reads a number. MPM3D-F90 accepts only numbers that begin with a digit or a minus sign; for others it uses an
  /// undefined value.
  double number(std::string_view what) {
    const Token token = word(what);
    std::string text(token.text);
    if (text.front() != '-' && std::isdigit(static_cast<unsigned char>(text.front())) == 0) {
      fail(token, fmt::format("'{}' where {} is expected{}", text, what,
                              text.front() == '.' || text.front() == '+'
                                  ? " (MPM3D-F90 reads no number that begins so)"
                                  : ""));
    }
    for (char& c : text) {
      if (c == 'd' || c == 'D') c = 'e';
    }
    double value = 0.0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
      fail(token, fmt::format("'{}' is no number, where {} is expected", token.text, what));
    }
    return value;
  }

  double whole_number(std::string_view what, double least, double most) {
    if (words_.empty() && !next_line()) static_cast<void>(word(what));
    const Token token = words_.back();
    const double value = std::trunc(number(what));
    if (value < least || value > most)
      fail(token, fmt::format("{} is {}, not between {} and {}", what, token.text, least, most));
    return value;
  }

  Kind kind(std::span<const Kind> kinds, std::string_view what) {
    const Token token = word(what);
    const std::string key = key_of(token.text);
    const auto found = std::ranges::find(kinds, key, &Kind::word);
    if (found != kinds.end()) return *found;
    std::string known;
    for (const Kind& each : kinds) known += (known.empty() ? "" : ", ") + std::string(each.word);
    fail(token, fmt::format("'{}' where {} is expected: {}", token.text, what, known));
  }

  void numbers(Statement& statement, std::size_t count, std::string_view after) {
    for (std::size_t i = 1; i <= count; ++i) {
      statement.numbers.push_back(number(fmt::format("number {} of {} after '{}'", i, count, after)));
    }
  }

  Statement& add(Keyword keyword, std::string kind_word = {}) {
    return deck_.statements.emplace_back(
        Statement{.keyword = keyword, .line = line_, .kind = std::move(kind_word)});
  }

  /// Reads the entries of a block "velo ... endv" or "load ... endl".
  void block(Keyword keyword, std::span<const Kind> kinds) {
    while (true) {
      const Kind entry = kind(kinds, fmt::format("an entry of '{}'", word_of(keyword)));
      if (entry.word == kinds.front().word) return;
      numbers(add(keyword, std::string(entry.word)), entry.numbers, entry.word);
    }
  }

  void materials(const Token& keyword) {
    if (materials_ == 0.0) fail(keyword, "'mate' before 'nmat', which says how many materials follow");
    for (double number_of_material = 0.0; number_of_material < materials_;) {
      number_of_material = whole_number("the number of a material", 1.0, materials_);
      const Kind model = kind(material_kinds, "the model of a material");
      Statement& statement = add(Keyword::material, std::string(model.word));
      statement.numbers.push_back(number_of_material);
      numbers(statement, model.numbers, model.word);
    }
  }

  void body() {
    const Kind shape = kind(body_kinds, "the shape of a body");
    Statement& statement = add(Keyword::body, std::string(shape.word));
    if (shape.word == "poin") {
      statement.numbers.push_back(whole_number("the component of a body", 1.0, 1e6));
      const double points = whole_number("the number of points", 1.0, 1e9);
      for (double i = 0.0; i < points; ++i) numbers(statement, 6, "point");
    } else {
      numbers(statement, shape.numbers, shape.word);
    }
  }

  void equation_of_state() {
    Statement& statement = add(Keyword::equation_of_state);
    statement.numbers.push_back(whole_number("the number of a material", 1.0, 1e6));
    const double type = whole_number("the type of an equation of state", 1.0, 4.0);
    statement.numbers.push_back(type);
    numbers(statement, state_constants[static_cast<std::size_t>(type) - 1],
            fmt::format("seos type {}", type));
  }

  void statement() {
    const Token token = word("a keyword");
    const std::optional<Keyword> keyword = keyword_of(token.text);
    if (!keyword) unknown(token);
    switch (*keyword) {
      case Keyword::end_of_input:
        ended_ = true;
        break;
      case Keyword::title: {
        std::string_view title = rest_.substr(token.column - 1 + token.text.size());
        title.remove_prefix(
            std::min(title.find_first_not_of(" \t,*"), title.size()));  // titles begin with "***"
        while (!title.empty() && (title.back() == ' ' || title.back() == '\t')) title.remove_suffix(1);
        add(*keyword, std::string(title));
        words_.clear();
        break;
      }
      case Keyword::musl:
      case Keyword::usf:
      case Keyword::usl:
      case Keyword::jaumann:
        add(*keyword, std::string(kind(switch_kinds, fmt::format("on or off after '{}'", token.text)).word));
        break;
      case Keyword::materials:
        materials_ = whole_number("the number of materials", 1.0, 1e4);
        add(*keyword).numbers = {materials_};
        break;
      case Keyword::material:
        materials(token);
        break;
      case Keyword::equation_of_state:
        equation_of_state();
        break;
      case Keyword::body:
        body();
        break;
      case Keyword::velocity:
        block(*keyword, velocity_kinds);
        break;
      case Keyword::load:
        block(*keyword, load_kinds);
        break;
      case Keyword::contact: {
        const Kind method = kind(contact_kinds, "the method of contact");
        numbers(add(*keyword, std::string(method.word)), method.numbers, "cont");
        break;
      }
      case Keyword::output_field:
      case Keyword::particle_curve:
      case Keyword::point_curve: {
        const Kind field = kind(fields, "a field");
        Statement& curve = add(*keyword, std::string(field.word));
        if (*keyword == Keyword::point_curve) numbers(curve, 3, "curx");
        if (*keyword == Keyword::particle_curve && !words_.empty()) numbers(curve, 1, "curv");
        break;
      }
      default:
        numbers(add(*keyword), numbers_after(*keyword), token.text);
    }
  }

  [[noreturn]] void unknown(const Token& token) {
    if (!deck_.statements.empty() &&
        (std::isdigit(static_cast<unsigned char>(token.text.front())) != 0 || token.text.front() == '-')) {
      const Statement& before = deck_.statements.back();
      fail(token, fmt::format("'{}' where a keyword is expected: too many numbers after '{}' (line {})",
                              token.text, before.name(), before.line));
    }
    std::vector<std::string> known;
    for (const Word<Keyword>& each : words(Keyword{})) known.emplace_back(each.text);
    fail(token, fmt::format("unknown keyword '{}'{}", token.text, did_you_mean(key_of(token.text), known)));
  }

  Deck& deck_;
  std::string_view text_;     ///< the unread text
  std::string_view rest_;     ///< the line without its comment
  std::vector<Token> words_;  ///< words of the line, the next one last
  std::vector<InputFault> faults_;
  unsigned line_ = 0;
  double materials_ = 0.0;
  bool ended_ = false, at_end_ = false;
};

}  // namespace

std::string Statement::name() const {
  const std::string word(word_of(keyword));
  return kind.empty() || keyword == Keyword::title ? word : fmt::format("{} {}", word, kind);
}

const Statement* Deck::last(Keyword keyword) const {
  const auto found = std::ranges::find(statements.rbegin(), statements.rend(), keyword, &Statement::keyword);
  return found == statements.rend() ? nullptr : &*found;
}

std::vector<const Statement*> Deck::all(Keyword keyword) const {
  std::vector<const Statement*> found;
  for (const Statement& statement : statements) {
    if (statement.keyword == keyword) found.push_back(&statement);
  }
  return found;
}

int whole(double value) { return static_cast<int>(std::clamp(value, -2147483647.0, 2147483647.0)); }

bool recognise(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    content = content.substr(0, content.find('!'));
    const std::size_t begin = content.find_first_not_of(" \t\r,");
    if (begin == std::string_view::npos) continue;
    content.remove_prefix(begin);
    return keyword_of(content.substr(0, content.find_first_of(" \t\r,"))).has_value();
  }
  return false;
}

Deck parse(const std::filesystem::path& file, std::string_view text) {
  Deck deck;
  deck.file = file;
  Reader(deck, text).read();
  return deck;
}

}  // namespace whipple::decks::mpm3d
