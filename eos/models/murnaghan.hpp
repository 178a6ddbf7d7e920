// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"
#include "eos/models/power_isentrope.hpp"

namespace whipple::eos {

struct MurnaghanConstants {
  double reference_density = 0;          ///< rho0, kg/m^3
  double bulk_modulus = 0;               ///< K0, isentropic, Pa
  double bulk_modulus_slope = 0;         ///< K0' = dK/dp
  double gruneisen = 0;                  ///< Gamma, constant
  double heat_capacity = 0;              ///< c_v, J/(kg K)
  double reference_temperature = 300.0;  ///< K
};

/// Murnaghan's equation as the isentrope through the reference state (Proc. Natl. Acad. Sci. 30 (1944) 244;
/// docs/theory/equations_of_state.md, section 2.3): p_s = K0/K0' [(rho/rho0)^K0' - 1], p = p_s + rho Gamma (e
/// - e_s).
class MurnaghanCurve {
 public:
  using Constants = MurnaghanConstants;
  static constexpr std::string_view name = "murnaghan";
  static constexpr std::string_view summary =
      "Murnaghan isentrope with a constant Grueneisen parameter; no phases";
  static ParameterTable<Constants> parameters();

  explicit MurnaghanCurve(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double reference_sound_speed() const { return isentrope_.sound_speed(); }
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return true; }
  [[nodiscard]] double maximum_density() const { return isentrope_.maximum_density(); }
  [[nodiscard]] std::string_view phase(double, double) const { return "solid"; }

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const { return isentrope_.isochore(rho); }
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    return isentrope_.log_isentrope_temperature(rho);
  }

 private:
  Constants constants_;
  PowerIsentrope isentrope_;
};

using Murnaghan = ConstantHeatCapacity<MurnaghanCurve>;
extern template class ConstantHeatCapacity<MurnaghanCurve>;

}  // namespace whipple::eos
