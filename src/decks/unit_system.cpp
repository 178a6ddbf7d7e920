// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/unit_system.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::decks {
namespace {

/// Lists the units that decks name, in UDUNITS-2 notation; the first of each kind is the SI unit.
constexpr std::array lengths = {"m", "cm", "mm", "um", "in", "ft"};
constexpr std::array masses = {"kg", "g", "mg", "ug", "t"};
constexpr std::array times = {"s", "ms", "us", "ns"};
constexpr std::array forces = {"N", "kN", "mN", "MN", "uN", "dyn"};
constexpr std::array pressures = {"Pa", "kPa", "MPa", "GPa", "TPa", "bar", "Mbar"};
/// Lists the usual names, tried in this order for a product of units of a system.
constexpr std::array usual = {"m/s",       "km/s",      "kg/m^3", "g/cm^3", "Pa",    "kPa",   "MPa",
                              "GPa",       "TPa",       "Mbar",   "J/kg",   "kJ/kg", "MJ/kg", "J/(kg K)",
                              "kJ/(kg K)", "MJ/(kg K)", "Pa s",   "kPa s",  "mPa s", "N",     "kN"};

template <class Names>
std::optional<std::string> found_in(const Names& names, const std::string& word) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  if (std::ranges::find(names, word) != names.end()) return word;
  // "Kg" and "MM" are common; for forces and pressures, m and M have different meanings.
  for (const char* name : names) {
    if (lower(name) == lower(word)) return name;
  }
  return std::nullopt;
}

std::string si_unit(const Dimension& dimension) { return UnitSystem{"m", "kg", "s"}.unit(dimension); }

bool same(const std::string& left, const std::string& right) {
  try {
    return std::abs(units::convert(1.0, left, right) - 1.0) < 1e-12;
  } catch (const InputError&) {
    return false;  // a unit of another kind
  }
}

}  // namespace

std::string UnitSystem::unit(const Dimension& dimension) const {
  std::vector<std::string> above, below;
  const std::array<std::pair<std::string, int>, 4> factors = {{{mass, dimension.mass},
                                                               {length, dimension.length},
                                                               {time, dimension.time},
                                                               {"K", dimension.temperature}}};
  for (const auto& [name, exponent] : factors) {
    if (exponent == 0) continue;
    const int power = std::abs(exponent);
    (exponent > 0 ? above : below).push_back(power == 1 ? name : fmt::format("{}^{}", name, power));
  }
  if (above.empty() && below.empty()) return "";
  std::string product = above.empty() ? "1" : fmt::format("{}", fmt::join(above, " "));
  if (below.size() == 1) product += "/" + below.front();
  if (below.size() > 1) product += fmt::format("/({})", fmt::join(below, " "));
  if (above.size() + below.size() > 1) {
    for (const char* name : usual) {
      if (same(product, name)) return name;
    }
  }
  return product;
}

std::string UnitSystem::quantity(double value, const Dimension& dimension) const {
  const std::string name = unit(dimension);
  return name.empty() ? number(value) : fmt::format("\"{} {}\"", number(value), name);
}

double UnitSystem::in_si(double value, const Dimension& dimension) const {
  const std::string name = unit(dimension);
  return name.empty() ? value : units::convert(value, name, si_unit(dimension));
}

namespace {

/// Sets the unit of a dimension. @throws InputError if the text has named another one
void take(std::string& unit, std::string_view found, std::string_view text) {
  if (!unit.empty() && unit != found)
    throw InputError(fmt::format("units \"{}\" contradict each other: {} and {}", text, unit, found));
  unit = found;
}

}  // namespace

std::optional<UnitSystem> parse_unit_system(std::string_view text) {
  std::string words(text);
  std::ranges::replace_if(
      words, [](char c) { return c == ',' || c == ';' || c == '-' || c == '\t' || c == '\r'; }, ' ');
  std::istringstream stream(words);
  UnitSystem system;
  std::vector<std::pair<std::string, Dimension>> derived;
  for (std::string word; stream >> word;) {
    if (const auto force = std::ranges::find(forces, word); force != forces.end()) {
      derived.emplace_back(word, Dimension{.length = 1, .mass = 1, .time = -2});
    } else if (std::ranges::find(pressures, word) != pressures.end()) {
      derived.emplace_back(word, dimension::pressure);
    } else if (const auto length = found_in(lengths, word)) {
      take(system.length, *length, text);
    } else if (const auto mass = found_in(masses, word)) {
      take(system.mass, *mass, text);
    } else if (const auto time = found_in(times, word)) {
      take(system.time, *time, text);
    }
  }
  if (system.length.empty() || system.mass.empty() || system.time.empty()) return std::nullopt;
  for (const auto& [name, dimension] : derived) {
    if (!same(name, system.unit(dimension))) {
      throw InputError(fmt::format("units \"{}\" contradict each other: {}, {} and {} make {}, not {}", text,
                                   system.length, system.mass, system.time, system.unit(dimension), name));
    }
  }
  return system;
}

std::string number(double value) { return fmt::format("{:.12g}", value == 0.0 ? 0.0 : value); }

}  // namespace whipple::decks
