// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "src/core/base/error.hpp"

namespace whipple::units {
namespace {

using UnitPtr = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using ConverterPtr = std::unique_ptr<cv_converter, decltype(&cv_free)>;

constexpr double electron_volt = 1.602176634e-19;  // J, exact (SI 2019)

/// Owns the unit database, which is read once per process; UDUNITS2 is not thread-safe, hence the mutex.
class UnitSystem {
 public:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);
    system_ = ut_read_xml(nullptr);
    if (system_ == nullptr) {
      throw InternalError("cannot read the unit database of UDUNITS2 (package libudunits2-0)");
    }
    const UnitPtr joule = parse("J");
    ut_unmap_name_to_unit(system_, "electronvolt", UT_ASCII);
    ut_unmap_symbol_to_unit(system_, "eV", UT_ASCII);
    const UnitPtr ev(ut_scale(electron_volt, joule.get()), &ut_free);
    ut_map_symbol_to_unit("eV", UT_ASCII, ev.get());
    // Otherwise "cc" is one hundredth of the speed of light.
    const UnitPtr cubic_centimetre = parse("cm^3");
    ut_map_symbol_to_unit("cc", UT_ASCII, cubic_centimetre.get());
    const UnitPtr degree = parse("degree");
    ut_map_symbol_to_unit("deg", UT_ASCII, degree.get());
  }
  UnitSystem(const UnitSystem&) = delete;  // owns the database
  UnitSystem& operator=(const UnitSystem&) = delete;
  ~UnitSystem() { ut_free_system(system_); }

  [[nodiscard]] UnitPtr parse(const std::string& text) const {
    const std::string trimmed = text.empty() ? "1" : text;
    return {ut_parse(system_, trimmed.c_str(), UT_UTF8), &ut_free};
  }

 private:
  ut_system* system_ = nullptr;
};

UnitPtr parse_unit(const UnitSystem& system, std::string_view text, std::string_view kind) {
  // The scanner of UDUNITS2 copies unknown characters to standard output.
  const bool printable = std::ranges::none_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  // ... and it passes over a parenthesis that closes none.
  const bool paired = std::ranges::count(text, '(') == std::ranges::count(text, ')');
  UnitPtr unit = printable && paired ? system.parse(std::string(text)) : UnitPtr(nullptr, &ut_free);
  if (!unit) throw InputError(fmt::format("unknown unit '{}': expected a unit of the kind '{}'", text, kind));
  return unit;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns whether a unit contains a number other than a whole exponent: UDUNITS2 multiplies by it, so that "3 2 m" would
/// be six metres, and "m^1.5" five. A leading one is allowed, as in "1/Pa".
bool has_factor(std::string_view unit) {
  const auto may_carry = [&](std::size_t end) {  // what stands before `end` takes an exponent
    const char last = end == 0 ? ' ' : unit[end - 1];
    return std::isalpha(static_cast<unsigned char>(last)) != 0 || last == ')' || last == '^';
  };
  for (std::size_t i = unit.starts_with("1/") ? 1 : 0; i < unit.size(); ++i) {
    if (!is_digit(unit[i]) || (i > 0 && is_digit(unit[i - 1]))) continue;
    const bool has_sign = i > 0 && (unit[i - 1] == '-' || unit[i - 1] == '+');
    if (!may_carry(has_sign ? i - 1 : i)) return true;
  }
  return false;
}

/// Returns k for a conversion by 10^k; nothing for any other.
std::optional<int> power_of_ten(const Conversion& c) {
  if (c.offset != 0.0 || !(c.factor > 0.0)) return std::nullopt;
  const double power = std::round(std::log10(c.factor));
  if (std::abs(c.factor / std::pow(10.0, power) - 1.0) > 1e-14) return std::nullopt;
  return static_cast<int>(power);
}

/// Reads a decimal number times 10^power with a single rounding: "2.03 g" becomes the double nearest to 0.00203 kg,
/// unlike 2.03 * 0.001.
double scaled_decimal(std::string_view number, int power) {
  const std::size_t mark = number.find_first_of("eE");
  const std::string_view mantissa = number.substr(0, mark);
  int exponent = 0;
  if (mark != std::string_view::npos) {
    std::string_view digits = number.substr(mark + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  }
  const std::string scaled = fmt::format("{}e{}", mantissa, exponent + power);
  double value = 0.0;
  const auto [rest, status] = std::from_chars(scaled.data(), scaled.data() + scaled.size(), value);
  if (status != std::errc()) throw InputError(fmt::format("'{}' is beyond the range of numbers", scaled));
  return value;
}

std::mutex& database_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

Conversion conversion(std::string_view unit, std::string_view si_unit) {
  const std::scoped_lock lock(database_mutex());
  static const UnitSystem system;
  const std::string_view kind = si_unit.empty() ? "1 (no unit)" : si_unit;
  const UnitPtr from = parse_unit(system, unit, kind);
  const UnitPtr to = parse_unit(system, si_unit, kind);
  if (ut_are_convertible(from.get(), to.get()) == 0) {
    throw InputError(
        fmt::format("unit '{}' has the wrong dimension: expected a unit of the kind '{}'", unit, kind));
  }
  const ConverterPtr converter(ut_get_converter(from.get(), to.get()), &cv_free);
  const double offset = cv_convert_double(converter.get(), 0.0);
  if (!std::isfinite(offset)) {  // UDUNITS2 converts between a unit and its reciprocal, too
    throw InputError(
        fmt::format("unit '{}' is the reciprocal of what is expected: a unit of the kind '{}'", unit, kind));
  }
  return {cv_convert_double(converter.get(), 1.0) - offset, offset};
}

double convert(double value, std::string_view from, std::string_view to) {
  const Conversion c = conversion(from, to);
  return c.factor * value + c.offset;
}

double require_no_unit(double value, std::string_view si_unit) {
  if (si_unit.empty() || value == 0.0 || !std::isfinite(value)) return value;
  throw InputError(fmt::format("is {} without a unit; in SI units that would be \"{}\"", value,
                               format_quantity(value, si_unit)));
}

double parse_quantity(std::string_view text, std::string_view si_unit) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  while (begin != end && *begin == ' ') ++begin;
  if (begin != end && *begin == '+' && !std::string_view(begin + 1, end).starts_with('-')) ++begin;
  double value = 0.0;
  const auto [rest, status] = std::from_chars(begin, end, value);
  if (status != std::errc() || !std::isfinite(value)) {
    throw InputError(si_unit.empty()
                         ? fmt::format("'{}' is not a number: expected for example \"1.5\"", text)
                         : fmt::format("'{}' is not a number with a unit: expected for example \"1.5 {}\"",
                                       text, si_unit));
  }
  std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  while (!unit.empty() && unit.back() == ' ') unit.remove_suffix(1);
  if (unit.empty()) return require_no_unit(value, si_unit);
  if (has_factor(unit)) throw InputError(fmt::format("'{}' is not a unit: it holds a second number", unit));
  const Conversion c = conversion(unit, si_unit);
  if (const auto power = power_of_ten(c)) return scaled_decimal(std::string_view(begin, rest), *power);
  return c.factor * value + c.offset;
}

std::string format_quantity(double value, std::string_view unit) {
  return unit.empty() || unit == "1" ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

}  // namespace whipple::units
