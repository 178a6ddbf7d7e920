// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/solid_constants.hpp"

#include <algorithm>

#include "src/core/base/error.hpp"

namespace whipple::fit {

namespace {

template <class Constants>
auto& member(Constants& c, Place place) {
  switch (place) {
    case Place::volume:
      return c.gray.reference_specific_volume;
    case Place::intercept:
      return c.gray.hugoniot_intercept;
    case Place::slope:
      return c.gray.hugoniot_slope;
    case Place::quadratic:
      return c.gray.hugoniot_quadratic;
    case Place::gruneisen:
      return c.gray.gruneisen;
    case Place::gruneisen_slope:
      return c.gray.gruneisen_slope;
    case Place::anharmonic:
      return c.gray.anharmonic_heat_coefficient;
    case Place::melting:
      return c.gray.melting_temperature;
    case Place::entropy:
      return c.gray.melting_entropy;
    case Place::heat_capacity:
      return c.heat_capacity;
    case Place::bulk_modulus:
      return c.bulk_modulus;
    case Place::bulk_modulus_slope:
      return c.bulk_modulus_slope;
  }
  throw InternalError("unknown constant");
}

}  // namespace

double& at(SolidConstants& constants, Place place) { return member(constants, place); }
double at(const SolidConstants& constants, Place place) { return member(constants, place); }

Bounds bounds_of(Place place, const SolidConstants& start) {
  switch (place) {
    case Place::quadratic:
    case Place::gruneisen_slope:
    case Place::anharmonic:
      return {};          // either sign
    case Place::entropy:  // Delta S - alpha, the entropy of melting at constant volume, is positive
      return {.lower = start.gray.liquid_heat_coefficient};
    case Place::bulk_modulus_slope:
      return {.lower = 1.0};
    default:
      return {.lower = 0.0};
  }
}

double scale_of(Place place) {
  switch (place) {
    case Place::anharmonic:
      return 1e-4;
    case Place::quadratic:
      return 0.1;
    default:
      return 1.0;
  }
}

std::string_view name_of(Place place) {
  switch (place) {
    case Place::volume:
      return "reference_specific_volume";
    case Place::intercept:
      return "hugoniot_intercept";
    case Place::slope:
      return "hugoniot_slope";
    case Place::quadratic:
      return "hugoniot_quadratic";
    case Place::gruneisen:
      return "gruneisen";
    case Place::gruneisen_slope:
      return "gruneisen_slope";
    case Place::anharmonic:
      return "anharmonic_heat_coefficient";
    case Place::melting:
      return "melting_temperature";
    case Place::entropy:
      return "melting_entropy";
    case Place::heat_capacity:
      return "heat_capacity";
    case Place::bulk_modulus:
      return "bulk_modulus";
    case Place::bulk_modulus_slope:
      return "bulk_modulus_slope";
  }
  throw InternalError("unknown constant");
}

bool SolidModel::fits(Place place) const { return std::find(free.begin(), free.end(), place) != free.end(); }

}  // namespace whipple::fit
