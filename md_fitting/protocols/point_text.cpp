// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/point_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "md_fitting/data_set/points.hpp"
#include "src/core/base/units.hpp"

namespace whipple::md {
namespace {

struct UsualUnit {
  const char* si;
  const char* usual;
};
constexpr std::array usual_units = {UsualUnit{"Pa", "GPa"},     UsualUnit{"J/kg", "MJ/kg"},
                                    UsualUnit{"m", "angstrom"}, UsualUnit{"m^3/kg", "cm^3/g"},
                                    UsualUnit{"m/s", "km/s"},   UsualUnit{"m^2", "angstrom^2"}};

}  // namespace

std::string format_result(const std::string& quantity, const Estimate& estimate) {
  std::string unit(unit_of(quantity));
  double factor = 1.0;
  for (const UsualUnit& one : usual_units) {
    if (unit == one.si) {
      factor = units::convert(1.0, one.si, one.usual);
      unit = one.usual;
      break;
    }
  }
  const double value = factor * estimate.value;
  const double error = factor * estimate.error;
  const std::string tail = unit.empty() ? "" : " " + unit;
  // Errors below the digits of the value come from a root search, not from a measurement.
  if (!(error > 0.5e-6 * std::abs(value))) return fmt::format("{} = {:.7g}{}", quantity, value, tail);
  // Print two digits of the error, but at most seven of the value: a lattice constant is accurate to any digit.
  const int digits_of_value =
      6 - static_cast<int>(std::floor(std::log10(std::fmax(std::abs(value), 1e-300))));
  const int digits_of_error = 1 - static_cast<int>(std::floor(std::log10(error)));
  const int decimals = std::clamp(std::min(digits_of_error, digits_of_value), 0, 12);
  return fmt::format("{} = {:.{}f} +- {:.{}f}{}", quantity, value, decimals, error, decimals, tail);
}

std::string short_label(const PointRecord& point) {
  std::string text = point.protocol;
  const char* joint = " at ";
  for (const auto& [name, value] : point.conditions) {
    text += joint + format_result(name, {value, 0.0});
    joint = ", ";
  }
  return text;
}

std::string summarize(const PointRecord& point) {
  std::string text = short_label(point);
  if (!point.done()) return fmt::format("{} FAILED: {}", text, point.message);
  const char* joint = ": ";
  for (const auto& [name, estimate] : point.results) {
    if (name == name_of(&StatePoint::solid) || name == name_of(&StatePoint::error_correlation)) continue;
    text += joint + format_result(name, estimate);
    joint = ", ";
  }
  if (!point.message.empty()) text += " (" + point.message + ")";
  return text + fmt::format(" [{:.1f} s]", point.wall_seconds);
}

}  // namespace whipple::md
