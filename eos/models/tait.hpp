// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"
#include "eos/models/power_isentrope.hpp"

namespace whipple::eos {

struct TaitConstants {
  double reference_density = 0;          ///< rho0, kg/m^3
  double sound_speed = 0;                ///< c0 of the reference state, m/s
  double exponent = 0;                   ///< n
  double gruneisen = 0;                  ///< Gamma, constant
  double heat_capacity = 0;              ///< c_v, J/(kg K)
  double reference_temperature = 300.0;  ///< K
};

/// Models Tait's equation in the form of Cole, Underwater Explosions (1948), as the isentrope of a liquid
/// (docs/theory/equations_of_state.md, section 2.3): p_s = rho0 c0^2/n [(rho/rho0)^n - 1], p = p_s + rho Gamma (e -
/// e_s). It carries tension down to -rho0 c0^2/n: cavitation is a failure criterion of the material.
class TaitCurve : public PowerIsentropeCurve<TaitConstants> {
 public:
  static constexpr std::string_view name = "tait";
  static constexpr std::string_view summary = "Tait liquid (water) with a constant Grueneisen parameter";
  static ParameterTable<Constants> parameters();

  explicit TaitCurve(const Constants& constants);

  [[nodiscard]] std::string_view phase(double, double) const { return "liquid"; }
};

using Tait = ConstantHeatCapacity<TaitCurve>;
extern template class ConstantHeatCapacity<TaitCurve>;

}  // namespace whipple::eos
