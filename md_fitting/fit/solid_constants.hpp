// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/fit/bounds.hpp"

namespace whipple::fit {

/// Holds the constants of the laws in laws.hpp: those of GRAY and of the other solid models.
struct SolidConstants {
  eos::GrayConstants gray;
  double heat_capacity = 0.0;       ///< J/(kg K): of E = e + c T + ..., 3R/M if not fitted
  double bulk_modulus = 0.0;        ///< Pa, isothermal, at V0 and the reference temperature
  double bulk_modulus_slope = 0.0;  ///< dK_T/dP there
};

/// Lists the constants that may be fitted.
enum class Place {
  volume,
  intercept,
  slope,
  quadratic,
  gruneisen,
  gruneisen_slope,
  anharmonic,
  melting,
  entropy,
  heat_capacity,
  bulk_modulus,
  bulk_modulus_slope
};

double& at(SolidConstants& constants, Place place);
double at(const SolidConstants& constants, Place place);

/// Returns the open interval of a fitted constant: the range in its parameter table, further limited by the other
/// constants.
Bounds bounds_of(Place place, const SolidConstants& start);
/// Returns the scale of a constant without bounds, such that its parameter is of order one.
double scale_of(Place place);
/// Returns the key in GRAY's parameter table, or in that of the model to which the constant belongs.
std::string_view name_of(Place place);

/// Describes a model of the solid as a least-squares problem: its constants and the data that determine them.
struct SolidModel {
  std::vector<Place> free;  ///< includes melting and entropy only if the data determine them
  bool hugoniot = false;    ///< shock states determine C and S
  bool isotherm = false;    ///< states at the reference temperature determine K0 and K0'
  bool surface = false;     ///< the melting data use the full GRAY surface, not only Lindemann's law

  [[nodiscard]] bool fits(Place place) const;
};

}  // namespace whipple::fit
