// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string_view>

namespace whipple::eos {

/// Holds all quantities of a complete equation of state at one point (SI; pressure positive in compression;
/// energies per unit mass). Quantities that a model does not provide are NaN.
struct State {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double density = unknown;                   ///< kg/m^3
  double specific_internal_energy = unknown;  ///< J/kg
  double temperature = unknown;               ///< K
  double pressure = unknown;                  ///< Pa
  double sound_speed = unknown;               ///< m/s, isentropic (bulk)
  double specific_entropy = unknown;          ///< J/(kg K)
  double heat_capacity = unknown;             ///< J/(kg K), at constant volume
  double gruneisen = unknown;                 ///< V (dp/de)_V
  double isothermal_bulk_modulus = unknown;   ///< Pa
  double melted_fraction = 0.0;               ///< mass fraction of liquid and vapour
  double vaporised_fraction = 0.0;            ///< mass fraction of vapour
  double distension = 1.0;                    ///< volume over that of the pore-free material
  std::string_view phase = "";                ///< "solid", "melting", "liquid", "hot liquid", "vapour", …

  // Derived quantities, computed by `derive`.
  double isentropic_bulk_modulus = unknown;  ///< Pa, rho c^2
  double isobaric_heat_capacity = unknown;   ///< J/(kg K)
  double thermal_expansion = unknown;        ///< 1/K, of the volume at constant pressure
  double helmholtz_energy = unknown;         ///< J/kg, e - T s
  double gibbs_energy = unknown;             ///< J/kg, e - T s + p V
};

/// Computes the derived quantities: K_S = rho c^2, alpha = Gamma rho C_v/K_T, C_p = C_v (1 + alpha Gamma T), F = e
/// - T s, G = F + p/rho. C_p and alpha are unknown (NaN) where K_T is not positive, since there is no stable state
/// at constant pressure.
void derive(State& state);

}  // namespace whipple::eos
