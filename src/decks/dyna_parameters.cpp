// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/dyna_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/decks/unit_system.hpp"

namespace whipple::decks::dyna {
namespace {

using Unary = double (*)(double);
using Binary = double (*)(double, double);
constexpr std::array<std::pair<std::string_view, Unary>, 17> unary = {
    {{"ABS", [](double x) { return std::abs(x); }},
     {"SQRT", [](double x) { return std::sqrt(x); }},
     {"EXP", [](double x) { return std::exp(x); }},
     {"LOG", [](double x) { return std::log(x); }},
     {"LOG10", [](double x) { return std::log10(x); }},
     {"SIN", [](double x) { return std::sin(x); }},
     {"COS", [](double x) { return std::cos(x); }},
     {"TAN", [](double x) { return std::tan(x); }},
     {"ASIN", [](double x) { return std::asin(x); }},
     {"ACOS", [](double x) { return std::acos(x); }},
     {"ATAN", [](double x) { return std::atan(x); }},
     {"SINH", [](double x) { return std::sinh(x); }},
     {"COSH", [](double x) { return std::cosh(x); }},
     {"TANH", [](double x) { return std::tanh(x); }},
     {"INT", [](double x) { return std::trunc(x); }},
     {"AINT", [](double x) { return std::trunc(x); }},
     {"NINT", [](double x) { return std::round(x); }}}};
constexpr std::array<std::pair<std::string_view, Binary>, 5> binary = {
    {{"MIN", [](double x, double y) { return std::fmin(x, y); }},
     {"MAX", [](double x, double y) { return std::fmax(x, y); }},
     {"MOD", [](double x, double y) { return std::fmod(x, y); }},
     {"SIGN", [](double x, double y) { return std::copysign(std::abs(x), y); }},
     {"ATAN2", [](double x, double y) { return std::atan2(x, y); }}}};

class Expression {
 public:
  Expression(std::string_view text, const std::function<std::optional<double>(std::string_view)>& value_of)
      : text_(text), value_of_(value_of) {}

  double value() {
    const double result = sum();
    if (at_ < text_.size()) fail(fmt::format("'{}' is not expected", text_.substr(at_)));
    if (!std::isfinite(result)) fail("it has no finite value");
    return result;
  }

 private:
  static constexpr int deepest = 100;  // nested parentheses and signs

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("the expression '{}': {}", text_, what));
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool take(std::string_view symbol) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(symbol)) return false;
    at_ += symbol.size();
    skip_blanks();
    return true;
  }
  void expect(std::string_view symbol) {
    if (!take(symbol)) fail(fmt::format("'{}' is missing", symbol));
  }
  double sum() {
    double value = product();
    for (;;) {
      if (take("+")) {
        value += product();
      } else if (take("-")) {
        value -= product();
      } else {
        return value;
      }
    }
  }
  double product() {
    double value = power();
    for (;;) {
      if (take("*")) {
        value *= power();
      } else if (take("/")) {
        value /= power();
      } else {
        return value;
      }
    }
  }
  /// Evaluates powers with the usual precedence: -2**2 is -4, 2**-1 is 1/2, 2**3**2 is 2**9.
  double power() {
    if (++depth_ > deepest) fail("it is too deep");
    double value = 0.0;
    if (take("-")) {
      value = -power();
    } else if (take("+")) {
      value = power();
    } else {
      value = operand();
      if (take("**") || take("^")) value = std::pow(value, power());
    }
    --depth_;
    return value;
  }
  double operand() {
    skip_blanks();
    if (take("(")) {
      const double value = sum();
      expect(")");
      return value;
    }
    const std::size_t begin = at_;
    const auto is = [&](auto test) {
      return at_ < text_.size() && test(static_cast<unsigned char>(text_[at_]));
    };
    if (is([](int c) { return std::isdigit(c) != 0 || c == '.'; })) {
      while (is([](int c) { return std::isdigit(c) != 0 || c == '.'; })) ++at_;
      if (is([](int c) { return c == 'e' || c == 'E' || c == 'd' || c == 'D'; })) {
        ++at_;
        if (is([](int c) { return c == '+' || c == '-'; })) ++at_;
        while (is([](int c) { return std::isdigit(c) != 0; })) ++at_;
      }
      const std::optional<double> value = number_of(std::string(text_.substr(begin, at_ - begin)));
      if (!value) fail(fmt::format("'{}' is no number", text_.substr(begin, at_ - begin)));
      skip_blanks();
      return *value;
    }
    take("&");
    const std::size_t first = at_;
    while (is([](int c) { return std::isalnum(c) != 0 || c == '_'; })) ++at_;
    const std::string name = capitals(std::string(text_.substr(first, at_ - first)));
    skip_blanks();
    if (name.empty()) fail("a number, a name or a parenthesis is missing");
    return take("(") ? call(name) : named(name);
  }
  double call(const std::string& name) {
    const double first = sum();
    const auto one = std::ranges::find(unary, name, &std::pair<std::string_view, Unary>::first);
    const auto two = std::ranges::find(binary, name, &std::pair<std::string_view, Binary>::first);
    if (one == unary.end() && two == binary.end()) fail(fmt::format("there is no function {}", name));
    double value = 0.0;
    if (one != unary.end()) {
      value = one->second(first);
    } else {
      expect(",");
      value = two->second(first, sum());
    }
    expect(")");
    return value;
  }
  double named(const std::string& name) {
    if (const std::optional<double> value = value_of_(name)) return *value;
    if (name == "PI") return std::numbers::pi;
    fail(fmt::format("there is no parameter {} before it", name));
  }

  std::string_view text_;
  const std::function<std::optional<double>(std::string_view)>& value_of_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// Splits a card into cells: at commas, or of equal width.
std::vector<std::string> cells_of(const std::string& text, std::size_t width) {
  std::vector<std::string> cells;
  const bool commas = text.find(',') != std::string::npos;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = commas ? std::min(text.find(',', at), text.size()) : at + width;
    cells.push_back(trimmed(std::string_view(text).substr(at, end - at)));
    at = end + (commas ? 1 : 0);
  }
  return cells;
}

/// Returns name and value or expression of the parameters of a card.
std::vector<std::pair<std::string, std::string>> pairs_of(const Block& block, const Card& card,
                                                          bool expression) {
  const std::size_t width = block.layout == Layout::wide ? 20 : 10;
  std::vector<std::pair<std::string, std::string>> pairs;
  if (expression) {
    const std::size_t comma = card.text.find(',');
    const bool between_commas = comma <= width;
    const std::size_t end = std::min(between_commas ? comma : width, card.text.size());
    pairs.emplace_back(trimmed(std::string_view(card.text).substr(0, end)),
                       trimmed(std::string_view(card.text).substr(
                           std::min(end + (between_commas ? 1 : 0), card.text.size()))));
    return pairs;
  }
  const std::vector<std::string> cells = cells_of(card.text.substr(0, 8 * width), width);
  for (std::size_t i = 0; i < cells.size(); i += 2)
    pairs.emplace_back(cells[i], i + 1 < cells.size() ? cells[i + 1] : "");
  return pairs;
}

/// Evaluates a number, the name of another parameter, or an expression.
double value_of(const Deck& deck, const Block& block, const Card& card, const std::string& name,
                const std::string& text, bool expression) {
  const std::optional<double> plain = number_of(text);
  if (plain && !expression) return *plain;
  try {
    return evaluate(text, [&](std::string_view each) { return parameter(deck, block.file, each); });
  } catch (const InputError& error) {
    fail(block, card.line, fmt::format("{}: {}", name, error.what()));
  }
}

}  // namespace

double evaluate(std::string_view expression,
                const std::function<std::optional<double>(std::string_view name)>& value_of) {
  return Expression(expression, value_of).value();
}

std::optional<double> parameter(const Deck& deck, const std::string& file, std::string_view name) {
  const std::string key = capitals(trimmed(name));
  if (const auto own = deck.of_file.find(file); own != deck.of_file.end()) {
    if (const auto found = own->second.find(key); found != own->second.end()) return found->second;
  }
  const auto found = deck.parameters.find(key);
  return found == deck.parameters.end() ? std::nullopt : std::optional(found->second);
}

bool read_parameters(Deck& deck, const Block& block) {
  const bool expression = block.keyword.starts_with("PARAMETER_EXPRESSION");
  const bool local = block.keyword.ends_with("_LOCAL");
  if (block.keyword != "PARAMETER" && block.keyword != "PARAMETER_LOCAL" &&
      block.keyword != "PARAMETER_EXPRESSION" && block.keyword != "PARAMETER_EXPRESSION_LOCAL") {
    return false;
  }
  Parameters& known = local ? deck.of_file[block.file] : deck.parameters;
  for (const Card& card : block.cards) {
    for (const auto& [typed, text] : pairs_of(block, card, expression)) {
      if (typed.empty() && text.empty()) continue;
      const char type = typed.empty() ? ' ' : capitals(typed)[0];
      const std::string name = capitals(trimmed(std::string_view(typed).substr(typed.empty() ? 0 : 1)));
      if (type == 'C') continue;  // a text
      if ((type != 'R' && type != 'I') || name.empty()) {
        fail(block, card.line,
             fmt::format("'{}' is no name of a parameter behind its type, R, I or C", typed));
      }
      const double value = value_of(deck, block, card, name, text, expression);
      if (type == 'I' && value != std::round(value)) {
        fail(block, card.line, fmt::format("{} is {}, no integer", name, number(value)));
      }
      const auto [entry, is_new] = known.emplace(name, value);
      if (!is_new && entry->second != value) {
        deck.notes.push_back(
            {place_of(block, card.line), "*" + block.keyword,
             fmt::format("{} is given again: it keeps its first value, {}", name, number(entry->second))});
      }
    }
  }
  return true;
}

}  // namespace whipple::decks::dyna
