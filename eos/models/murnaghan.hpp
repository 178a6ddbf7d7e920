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

/// Models Murnaghan's equation as the isentrope through the reference state (Proc. Natl. Acad. Sci. 30 (1944) 244;
/// docs/theory/equations_of_state.md, section 2.3): p_s = K0/K0' [(rho/rho0)^K0' - 1], p = p_s + rho Gamma (e - e_s).
class MurnaghanCurve : public PowerIsentropeCurve<MurnaghanConstants> {
 public:
  static constexpr std::string_view name = "murnaghan";
  static constexpr std::string_view summary =
      "Murnaghan isentrope with a constant Grueneisen parameter; no phases";
  static ParameterTable<Constants> parameters();

  explicit MurnaghanCurve(const Constants& constants);

  [[nodiscard]] std::string_view phase(double, double) const { return "solid"; }
};

using Murnaghan = ConstantHeatCapacity<MurnaghanCurve>;
extern template class ConstantHeatCapacity<MurnaghanCurve>;

}  // namespace whipple::eos
