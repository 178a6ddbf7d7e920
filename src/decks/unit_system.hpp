// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace whipple::decks {

/// Holds the exponents of length, mass, time and temperature of a quantity.
struct Dimension {
  int length = 0, mass = 0, time = 0, temperature = 0;
};
namespace dimension {
inline constexpr Dimension none = {};
inline constexpr Dimension length = {.length = 1};
inline constexpr Dimension time = {.time = 1};
inline constexpr Dimension rate = {.time = -1};
inline constexpr Dimension velocity = {.length = 1, .time = -1};
inline constexpr Dimension acceleration = {.length = 1, .time = -2};
inline constexpr Dimension force = {.length = 1, .mass = 1, .time = -2};
inline constexpr Dimension density = {.length = -3, .mass = 1};
inline constexpr Dimension pressure = {.length = -1, .mass = 1, .time = -2};
inline constexpr Dimension viscosity = {.length = -1, .mass = 1, .time = -1};
inline constexpr Dimension specific_energy = {.length = 2, .time = -2};
inline constexpr Dimension heat_capacity = {.length = 2, .time = -2, .temperature = -1};
}  // namespace dimension

/// Holds the consistent units of a deck: those of length, mass and time; all others are derived, temperature is in K.
struct UnitSystem {
  std::string length, mass, time;

  /// Returns the unit of a quantity, by its usual name if there is one ("MPa"), otherwise as a product ("g/mm^3").
  [[nodiscard]] std::string unit(const Dimension& dimension) const;
  /// Returns a value of the deck with its unit, as TOML: "\"2.12 mm\""; a bare number if it is dimensionless.
  [[nodiscard]] std::string quantity(double value, const Dimension& dimension) const;
  /// Returns a value of the deck in SI.
  [[nodiscard]] double in_si(double value, const Dimension& dimension) const;
};

/// Parses "mm g ms", in any order, with commas or blanks. Units of force and pressure may follow ("mm g N ms MPa") and
/// must be consistent with length, mass and time.
/// @returns nothing if the words do not name length, mass and time
/// @throws InputError if a unit of force or pressure contradicts the others
std::optional<UnitSystem> parse_unit_system(std::string_view text);

/// Returns a number with at most twelve digits, which hides the rounding of sums ("6.36", not "6.3600000000000003").
std::string number(double value);

}  // namespace whipple::decks
