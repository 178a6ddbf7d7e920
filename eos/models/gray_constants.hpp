// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "src/core/base/parameter_table.hpp"

namespace whipple::eos {

/// Specifies the melting transition of GRAY.
enum class MeltingTransition : std::uint8_t {
  band,         ///< over a band of temperatures on an isochore, in closed form (G31)
  isochoric,    ///< at one temperature on an isochore (G26)
  equilibrium,  ///< solid and liquid in equilibrium, by their common tangent (G27)
};
constexpr std::array<Word<MeltingTransition>, 3> words(MeltingTransition) {
  return {{{MeltingTransition::band, "band"},
           {MeltingTransition::isochoric, "isochoric"},
           {MeltingTransition::equilibrium, "equilibrium"}}};
}

/// Specifies the condition that determines the attraction a_y of GRAY's vapour.
enum class VapourCondition : std::uint8_t {
  attraction,  ///< a_y as given
  critical,    ///< the complete model has its critical point at `critical_temperature`
  boiling,     ///< the complete model boils at `boiling_temperature` under 101325 Pa
};
constexpr std::array<Word<VapourCondition>, 3> words(VapourCondition) {
  return {{{VapourCondition::attraction, "attraction"},
           {VapourCondition::critical, "critical"},
           {VapourCondition::boiling, "boiling"}}};
}

/// Holds the constants of the GRAY equation of state (docs/theory/gray.md, section 1), SI, molar quantities per
/// mole of atoms. Sources of the form: Royce, UCRL-51121 (1971); Grover, J. Chem. Phys. 55, 3435 (1971); Young and
/// Alder, Phys. Rev. A 3, 364 (1971). Constants of metals: Steinberg, UCRL-MA-106439 (1996).
struct GrayConstants {
  /// Gas constant of the published GRAY constants, J/(mol K). It is kept (instead of 8.314463) because melting
  /// entropy and heat-capacity slopes of the liquid were published with it.
  static constexpr double gas_constant = 8.314;
  static constexpr double same_as_solid = std::numeric_limits<double>::quiet_NaN();
  static constexpr double not_given = std::numeric_limits<double>::infinity();

  // Solid
  double molar_mass = 0;                    ///< kg/mol
  double reference_specific_volume = 0;     ///< V0, m^3/kg
  double hugoniot_intercept = 0;            ///< C of the shock curve, m/s
  double hugoniot_slope = 0;                ///< S, the S1 of Steinberg's form
  double hugoniot_quadratic = 0;            ///< S2 of Us = C + S1 up + S2 (up/Us) up + S3 (up/Us)^2 up
  double hugoniot_cubic = 0;                ///< S3
  double gruneisen = 0;                     ///< gamma0, at V0
  double gruneisen_slope = 0;               ///< a of gamma = gamma0 - a (1 - V/V0)
  double electronic_heat_coefficient = 0;   ///< g_el, J/(mol K^2)
  double anharmonic_heat_coefficient = 0;   ///< g_anh, J/(mol K^2); GRAY's g_e is g_el + g_anh
  double electronic_gruneisen = 2.0 / 3.0;  ///< gamma_e
  // Melting and liquid
  double melting_temperature = 0;                  ///< T_m0 on the isochore V0, K
  double melting_gruneisen = same_as_solid;        ///< gamma_m0 of the Lindemann law
  double melting_gruneisen_slope = same_as_solid;  ///< a_m
  double melting_entropy = 9.637;                  ///< Delta S, J/(mol K)
  double liquid_heat_coefficient = 1.3;            ///< alpha, J/(mol K)
  double hot_liquid_ratio = 9.38;                  ///< tau_G = T_G/T_m
  MeltingTransition melting = MeltingTransition::equilibrium;
  // Vapour
  double join_volume_ratio = 1.3;  ///< V_J/V0
  double covolume_ratio = 0.5;     ///< V_b/V0
  double join_shape = 1.0;         ///< theta
  VapourCondition vapour = VapourCondition::attraction;
  double vapour_attraction = not_given;     ///< a_y, J m^3/kg^2
  double critical_temperature = not_given;  ///< K
  double boiling_temperature = not_given;   ///< K
  // Reference state
  double reference_temperature = 300.0;  ///< T0, K
  double reference_energy = 0.0;         ///< E_0H = E(V0, T0), J/kg
};

/// Returns names, units, ranges and meanings of the constants.
ParameterTable<GrayConstants> gray_parameters();

/// Replaces the "same as the solid" defaults by their values. (The attraction of the vapour presets requires the
/// whole surface: GrayFreeEnergy.)
/// @throws InputError if the constants contradict each other (both names in the message)
GrayConstants resolved(GrayConstants constants);

}  // namespace whipple::eos
