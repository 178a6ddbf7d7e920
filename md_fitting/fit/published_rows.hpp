// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace whipple::fit {

/// Holds a row of published constants for comparison with a fit.
struct PublishedRow {
  std::string_view name;
  std::string_view element;
  std::string_view source;
  double specific_volume;  ///< m^3/kg
  double hugoniot_intercept;
  double hugoniot_slope;
  double gruneisen;
  double gruneisen_slope;
  double heat_coefficient;  ///< J/(mol K^2): g_e, whatever its physical interpretation
  double melting_temperature;
};
std::span<const PublishedRow> published_rows();

}  // namespace whipple::fit
