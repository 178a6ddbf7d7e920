// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace whipple::units {

/// Factor and offset that bring a value in `unit` to `si_unit`: value_si = factor * value + offset.
struct Conversion {
  double factor = 1.0;
  double offset = 0.0;
};

/// Conversion between two units, through UDUNITS2; electron volts are the CODATA 2018 value
/// (UDUNITS2 still carries that of 1986).
/// @throws InputError if a unit is unknown or the dimensions differ; the message names both.
Conversion conversion(std::string_view unit, std::string_view si_unit);

/// Converts one value.
double convert(double value, std::string_view from, std::string_view to);

/// A number that was given without a unit: what has a dimension needs one, but for 0, which is the same in all,
/// and for what is not finite, of which ranges speak.
/// @throws InputError with the reading in SI as the remedy
double require_no_unit(double value, std::string_view si_unit);

/// Reads "6.58 km/s" and returns the value in `si_unit`; a bare number must pass `require_no_unit`.
/// @throws InputError with the reason and an example of what is accepted.
double parse_quantity(std::string_view text, std::string_view si_unit);

/// "6580 m/s": shortest text that reads back to the same double, with the unit (none if dimensionless).
std::string format_quantity(double value, std::string_view unit);

}  // namespace whipple::units
