// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/fit/bounds.hpp"

namespace whipple::fit {

/// Holds the constants of the laws in laws.hpp: those of GRAY and of the other models of a solid.
struct SolidConstants {
  eos::GrayConstants gray;
  double heat_capacity = 0.0;       ///< J/(kg K): of E = e + c T + ..., 3R/M if it is not fitted
  double bulk_modulus = 0.0;        ///< Pa, isothermal, at V0 and the reference temperature
  double bulk_modulus_slope = 0.0;  ///< dK_T/dP there
};

/// A constant that may be fitted.
enum class Place {
  volume,
  intercept,
  slope,
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

/// Open interval of a fitted constant: the range of its parameter table, and what the others demand.
Bounds bounds_of(Place place, const SolidConstants& start);
/// Returns the scale of a constant without bounds, such that its parameter is of order one.
double scale_of(Place place);
/// Key in GRAY's parameter table, or in that of the model that owns the constant.
std::string_view name_of(Place place);

/// One model of the solid as a problem of least squares: which constants it has and which data bear them.
struct SolidModel {
  std::vector<Place> free;  ///< melting and entropy only where the data have them
  bool hugoniot = false;    ///< shock states bear C and S
  bool isotherm = false;    ///< states at the reference temperature bear K0 and K0'
  bool surface = false;  ///< GRAY's whole surface stands behind the melting data, not Lindemann's law alone

  [[nodiscard]] bool fits(Place place) const;
};

}  // namespace whipple::fit
