// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/gray_constants.hpp"

#include <fmt/core.h>

#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::eos {

ParameterTable<GrayConstants> gray_parameters() {
  using C = GrayConstants;
  return {
      real("molar_mass", &C::molar_mass, "kg/mol", range::positive(), "mass of a mole of atoms"),
      real("reference_specific_volume", &C::reference_specific_volume, "m^3/kg", range::positive(),
           "V0, specific volume at the reference temperature and zero pressure"),
      real("hugoniot_intercept", &C::hugoniot_intercept, "m/s", range::positive(),
           "C of the shock Hugoniot Us = C + S up"),
      real("hugoniot_slope", &C::hugoniot_slope, "", range::positive(),
           "S of Us = C + S up, the S1 of Us = C + S1 up + S2 (up/Us) up + S3 (up/Us)^2 up"),
      real("hugoniot_quadratic", &C::hugoniot_quadratic, "", range::any(), "S2; 0: a linear Hugoniot")
          .optional(),
      real("hugoniot_cubic", &C::hugoniot_cubic, "", range::any(), "S3").optional(),
      real("gruneisen", &C::gruneisen, "", range::positive(), "gamma0, lattice Grueneisen parameter at V0"),
      real("gruneisen_slope", &C::gruneisen_slope, "", range::any(), "a of gamma = gamma0 - a (1 - V/V0)"),
      real("electronic_heat_coefficient", &C::electronic_heat_coefficient, "J/(mol K^2)",
           range::non_negative(), "g_el of the electronic heat capacity g_el T at V0"),
      real("anharmonic_heat_coefficient", &C::anharmonic_heat_coefficient, "J/(mol K^2)", range::any(),
           "g_anh of the anharmonic heat capacity g_anh T at V0; g_e of GRAY is g_el + g_anh")
          .optional(),
      real("electronic_gruneisen", &C::electronic_gruneisen, "", range::any(),
           "gamma_e of the terms in T^2: g_e (V/V0)^gamma_e")
          .optional(),
      real("melting_temperature", &C::melting_temperature, "K", range::positive(),
           "T_m0, melting temperature on the isochore V0 (not at zero pressure)"),
      real("melting_gruneisen", &C::melting_gruneisen, "", range::positive(),
           "gamma_m0 of the Lindemann melting law")
          .optional("same as gruneisen"),
      real("melting_gruneisen_slope", &C::melting_gruneisen_slope, "", range::any(),
           "a_m of the Lindemann melting law")
          .optional("same as gruneisen_slope"),
      real("melting_entropy", &C::melting_entropy, "J/(mol K)", range::positive(),
           "Delta S; the entropy of melting at constant volume is Delta S - alpha")
          .optional(),
      real("liquid_heat_coefficient", &C::liquid_heat_coefficient, "J/(mol K)", range::non_negative(),
           "alpha of the liquid's heat capacity 3R - alpha T/T_m")
          .optional(),
      real("hot_liquid_ratio", &C::hot_liquid_ratio, "", {.lower = 2.0, .lower_open = true},
           "T_G/T_m: above T_G the heat capacity stays at 3R - alpha T_G/T_m")
          .optional(),
      choice("melting", &C::melting,
             "band of temperatures on an isochore, in closed form; one temperature; phases in equilibrium")
          .optional(),
      real("join_volume_ratio", &C::join_volume_ratio, "", range::open_between(1.0, 2.0),
           "V_J/V0, where the vapour is joined to the liquid; 1.2 to 1.4 is sound")
          .optional(),
      real("covolume_ratio", &C::covolume_ratio, "", range::open_between(0.0, 1.0),
           "V_b/V0, hard-sphere volume scale of the vapour")
          .optional(),
      real("join_shape", &C::join_shape, "", range::positive(), "theta of the join function of the vapour")
          .optional(),
      choice("vapour", &C::vapour,
             "a_y: vapour_attraction as given, or solved for critical_temperature or boiling_temperature")
          .optional(),
      real("vapour_attraction", &C::vapour_attraction, "J m^3/kg^2", range::positive(),
           "a_y, van der Waals attraction of the vapour")
          .optional("required by vapour = \"attraction\""),
      real("critical_temperature", &C::critical_temperature, "K", range::positive(),
           "critical temperature of the model with vapour = \"critical\"")
          .optional("required by vapour = \"critical\""),
      real("boiling_temperature", &C::boiling_temperature, "K", range::positive(),
           "boiling temperature at 101325 Pa of the model with vapour = \"boiling\"")
          .optional("required by vapour = \"boiling\""),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
      real("reference_energy", &C::reference_energy, "J/kg", range::any(), "E(V0, T0)").optional(),
  };
}

GrayConstants resolved(GrayConstants c) {
  if (std::isnan(c.melting_gruneisen)) c.melting_gruneisen = c.gruneisen;
  if (std::isnan(c.melting_gruneisen_slope)) c.melting_gruneisen_slope = c.gruneisen_slope;
  if (c.melting_entropy <= c.liquid_heat_coefficient) {
    throw InputError(fmt::format(
        "gray: melting_entropy ({} J/(mol K)) must exceed liquid_heat_coefficient ({} J/(mol K)): "
        "their difference is the entropy of melting",
        c.melting_entropy, c.liquid_heat_coefficient));
  }
  if (c.covolume_ratio >= c.join_volume_ratio) {
    throw InputError(fmt::format("gray: covolume_ratio ({}) must be below join_volume_ratio ({})",
                                 c.covolume_ratio, c.join_volume_ratio));
  }
  if (c.join_shape <= c.covolume_ratio / c.join_volume_ratio) {
    throw InputError(fmt::format("gray: join_shape ({}) must exceed covolume_ratio/join_volume_ratio ({})",
                                 c.join_shape, c.covolume_ratio / c.join_volume_ratio));
  }
  const auto require = [&](VapourCondition vapour, const char* name, double value) {
    if (c.vapour == vapour && !std::isfinite(value)) {
      throw InputError(
          fmt::format("gray: vapour = \"{}\" needs {}, which is missing", word_of(vapour), name));
    }
  };
  require(VapourCondition::attraction, "vapour_attraction", c.vapour_attraction);
  require(VapourCondition::critical, "critical_temperature", c.critical_temperature);
  require(VapourCondition::boiling, "boiling_temperature", c.boiling_temperature);
  return c;
}

}  // namespace whipple::eos
