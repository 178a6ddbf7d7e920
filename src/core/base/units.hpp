// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace whipple::units {

/// Holds factor and offset of the conversion from `unit` to `si_unit`: value_si = factor * value + offset.
struct Conversion {
  double factor = 1.0;
  double offset = 0.0;
};

/// Returns the conversion between two units, by UDUNITS2; electron volts use the CODATA 2018 value (UDUNITS2 uses that
/// of 1986).
/// @throws InputError if a unit is unknown or the dimensions differ; the message contains both.
Conversion conversion(std::string_view unit, std::string_view si_unit);

/// Converts one value.
double convert(double value, std::string_view from, std::string_view to);

/// Checks that a number may be given without a unit: dimensional quantities require one, except 0, which is the same in
/// all units, and non-finite values, which range checks report.
/// @throws InputError suggesting the value in SI
double require_no_unit(double value, std::string_view si_unit);

/// Reads "6.58 km/s" and returns the value in `si_unit`; a bare number must pass `require_no_unit`.
/// @throws InputError with the reason and an example of an accepted text.
double parse_quantity(std::string_view text, std::string_view si_unit);

/// Returns "6580 m/s": the shortest text that converts back to the same double, with the unit (none if dimensionless).
std::string format_quantity(double value, std::string_view unit);

}  // namespace whipple::units
