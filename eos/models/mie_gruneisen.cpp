// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/models/mie_gruneisen.hpp"

#include "eos/constant_heat_capacity_batch.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double pole_margin = 0.05;  ///< minimum denominator of p_H

}  // namespace

template class ConstantHeatCapacity<MieGruneisenCurve>;

ParameterTable<MieGruneisenConstants> MieGruneisenCurve::parameters() {
  using C = MieGruneisenConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at the reference temperature and zero pressure"),
      real("hugoniot_intercept", &C::hugoniot_intercept, "m/s", range::positive(),
           "c0 of the shock Hugoniot Us = c0 + s up (S2, S3: + S2 (up/Us) up + S3 (up/Us)^2 up)"),
      real("hugoniot_slope", &C::hugoniot_slope, "", range::positive(), "s = S1 of the shock Hugoniot"),
      real("hugoniot_quadratic", &C::hugoniot_quadratic, "", range::any(), "S2 of the shock Hugoniot")
          .optional(),
      real("hugoniot_cubic", &C::hugoniot_cubic, "", range::any(), "S3 of the shock Hugoniot").optional(),
      real("gruneisen", &C::gruneisen, "", range::positive(), "Gamma0, Grueneisen parameter at rho0"),
      choice("gruneisen_law", &C::gruneisen_law,
             "in compression: rho Gamma constant, Gamma constant, or rho Gamma = rho0 (Gamma0 + b mu)")
          .optional(),
      real("gruneisen_slope", &C::gruneisen_slope, "", range::any(), "b of the linear law").optional(),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

GruneisenLaw MieGruneisenCurve::law(const Constants& k) {
  if (k.gruneisen_law != CompressedGruneisenLaw::linear && k.gruneisen_slope != 0) {
    throw InputError("mie_gruneisen: gruneisen_slope needs gruneisen_law = \"linear\"");
  }
  // Gamma constant: rho Gamma = rho0 Gamma0 (1 + mu).
  const bool constant = k.gruneisen_law == CompressedGruneisenLaw::constant;
  return {k.gruneisen, constant ? k.gruneisen : k.gruneisen_slope, 0.0};
}

GruneisenSolid<MieGruneisenCurve::Hugoniot> MieGruneisenCurve::solid(const Constants& k) {
  const ShockCurve curve{k.hugoniot_slope, k.hugoniot_quadratic, k.hugoniot_cubic};
  const GruneisenLaw gamma = law(k);
  const double modulus = k.reference_density * k.hugoniot_intercept * k.hugoniot_intercept;
  return {name,
          {curve, gamma, modulus},
          gamma,
          {k.reference_density, k.reference_temperature, 0.0, k.heat_capacity},
          0.0,
          modulus,
          curve.limit(pole_margin, 1 - 1 / greatest_compression_ratio)};
}

MieGruneisenCurve::MieGruneisenCurve(const Constants& constants)
    : constants_(constants), solid_(solid(constants)) {}

}  // namespace whipple::eos
