// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/fit/fit_result.hpp"

/// Lists constants that molecular dynamics does not determine, per element, each with its name and source: the only
/// place from which the fit takes a number that is not in the store.
namespace whipple::fit {

struct NamedDefault {
  std::string_view parameter;  ///< key of the model's parameter table
  std::string_view name;       ///< name of the choice
  double value;                ///< SI
  std::string_view source;
  Evidence evidence = Evidence::chosen;
  double error = 0.0;               ///< SI, one standard deviation; 0: the source gives none
  std::string_view error_source{};  ///< of the error
};

struct ElementDefaults {
  std::string_view element;  ///< chemical symbol
  std::string_view metal;    ///< English name, also the stem of its template material
  double melting_point;      ///< K, at atmospheric pressure, measured
  std::span<const NamedDefault>
      electronic;                    ///< choices of electronic_heat_coefficient; the first is the default
  NamedDefault melting_temperature;  ///< taken only if the store holds no coexistence point
  std::span<const NamedDefault> constants;  ///< the remaining constants of GRAY
  eos::VapourCondition vapour;              ///< where GRAY takes a_y from
  NamedDefault debye_temperature;           ///< taken only if the store holds no elastic constants
};

/// @throws InputError naming the known elements.
const ElementDefaults& element_defaults(std::string_view element);

/// A row of published constants that a fit is printed beside.
struct PublishedRow {
  std::string_view name;
  std::string_view element;
  std::string_view source;
  double specific_volume;  ///< m^3/kg
  double hugoniot_intercept;
  double hugoniot_slope;
  double gruneisen;
  double gruneisen_slope;
  double heat_coefficient;  ///< J/(mol K^2): g_e, whatever it stands for
  double melting_temperature;
};
std::span<const PublishedRow> published_rows();

}  // namespace whipple::fit
