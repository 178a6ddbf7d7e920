// SPDX-License-Identifier: BSD-3-Clause
#include "src/app/eos_queries.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "eos/curves/tables.hpp"

namespace whipple::app {
namespace {

using eos::curves::CurveTable;
using eos::curves::Subjects;
using eos::curves::Variable;

/// Describes the command-line option of a quantity.
struct QuantityOption {
  EosQuantity quantity;
  const char* name;
  std::string EosOptions::* text;
  const char* help;
};

const QuantityOption quantity_options[] = {
    {EosQuantity::density, "--density", &EosOptions::density, "e.g. '9.5 g/cm^3'"},
    {EosQuantity::temperature, "--temperature", &EosOptions::temperature, "e.g. '300 K'"},
    {EosQuantity::energy, "--energy", &EosOptions::energy, "Specific internal energy, e.g. '1.2 MJ/kg'"},
    {EosQuantity::pressure, "--pressure", &EosOptions::pressure, "e.g. '100 GPa'"},
    {EosQuantity::entropy, "--entropy", &EosOptions::entropy, "Specific entropy, e.g. '500 J/(kg K)'"},
    {EosQuantity::particle_velocity, "--particle-velocity", &EosOptions::particle_velocity, "e.g. '2 km/s'"},
    {EosQuantity::initial_density, "--initial-density", &EosOptions::initial_density,
     "Of porous material ahead of the shock, e.g. '6 g/cm^3'"},
    {EosQuantity::reflected, "--reflected", &EosOptions::reflected,
     "From the state shocked to this pressure, e.g. '50 GPa'"},
    {EosQuantity::velocity, "--velocity", &EosOptions::velocity, "Of the impactor, e.g. '5 km/s'"},
    {EosQuantity::from, "--from", &EosOptions::from, "Begin of the curve, e.g. '10 GPa'"},
    {EosQuantity::to, "--to", &EosOptions::to, "End of the curve, e.g. '150 GPa'"},
    {EosQuantity::states, "--states", &EosOptions::states,
     "CSV file of states instead of one: columns like 'density [g/cm^3]' and 'temperature [K]'"},
    {EosQuantity::volume, "--volume", &EosOptions::volume,
     "Volume of the products over that of the explosive to which they drive (default 7)"},
};

CurveTable state_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::state_table(subjects, state_queries(o));
}
CurveTable hugoniot_table(const EosOptions& o, const Subjects& subjects) {
  const Variable variable = curve_variable(o, std::array{Variable::pressure, Variable::particle_velocity});
  return eos::curves::hugoniot_table(subjects, hugoniot_start(o), shock_query(o), variable,
                                     curve_range(o, variable));
}
CurveTable isotherm_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::isotherm_table(subjects, quantity("--temperature", o.temperature, "K"),
                                     curve_range(o, Variable::pressure));
}
CurveTable isentrope_table(const EosOptions& o, const Subjects& subjects) {
  const Variable variable = curve_variable(o, std::array{Variable::pressure, Variable::density});
  return eos::curves::isentrope_table(subjects, state_query(o), variable, curve_range(o, variable));
}
CurveTable release_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::release_table(subjects, hugoniot_start(o), shock_query(o),
                                    curve_range(o, Variable::pressure));
}
CurveTable cold_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::cold_table(subjects, curve_range(o, Variable::density));
}
CurveTable melt_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::melt_table(subjects, curve_range(o, Variable::pressure));
}
CurveTable dome_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::dome_table(subjects, curve_range(o, Variable::pressure));
}
CurveTable match_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::match_table(subjects, impact_velocity(o));
}

CurveTable detonation_table(const EosOptions&, const Subjects& subjects) {
  return eos::curves::detonation_table(subjects);
}
CurveTable products_table(const EosOptions& o, const Subjects& subjects) {
  const Variable variable = curve_variable(o, std::array{Variable::pressure, Variable::density});
  return eos::curves::products_table(subjects, variable, curve_range(o, variable));
}
CurveTable contact_table(const EosOptions&, const Subjects& subjects) {
  return eos::curves::contact_table(subjects);
}
CurveTable gurney_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::gurney_table(subjects, quantity("--volume", o.volume, "").value_or(7.0), o.points);
}
CurveTable cylinder_table(const EosOptions& o, const Subjects& subjects) {
  return eos::curves::cylinder_table(
      subjects, {}, {quantity("--from", o.from, "m"), quantity("--to", o.to, "m"), o.points});
}

}  // namespace

const std::vector<EosQuery>& eos_queries() {
  using enum EosQuantity;
  static const std::vector<EosQuery> all = {
      {"state",
       "States, from two quantities each",
       {density, temperature, energy, pressure, entropy, states},
       nullptr,
       nullptr,
       state_table,
       state_remarks,
       "whipple eos state copper --density '10 g/cm^3' --temperature '3000 K'\n  "
       "whipple eos state copper --states states.csv --csv -",
       true},
      {"hugoniot",
       "Hugoniot: principal, porous or through a shocked state; a curve, or one shocked state",
       {density, pressure, particle_velocity, from, to, initial_density, reflected},
       "up_km_s",
       "us_km_s",
       hugoniot_table,
       hugoniot_remarks,
       "whipple eos hugoniot copper aluminium --to '300 GPa' --plot hugoniot.png --with "
       "cu_hugoniot_marsh1980\n  "
       "whipple eos hugoniot copper --initial-density '6 g/cm^3' --pressure '40 GPa'",
       false,
       true},
      {"isotherm",
       "Pressure and density at constant temperature",
       {temperature, from, to},
       "V_over_V0",
       "P_GPa",
       isotherm_table,
       nullptr,
       "whipple eos isotherm copper --temperature '298 K' --to '150 GPa'"},
      {"isentrope",
       "Isentrope from a state to a pressure or density",
       {density, temperature, energy, pressure, entropy, to},
       "V_over_V0",
       "P_GPa",
       isentrope_table,
       nullptr,
       "whipple eos isentrope copper --to '200 GPa'"},
      {"release",
       "Release of a shocked state: residual temperature, melted and vaporised fraction",
       {density, pressure, particle_velocity, to, initial_density},
       "V_over_V0",
       "P_GPa",
       release_table,
       release_remarks,
       "whipple eos release copper --pressure '160 GPa' --to '0 Pa'"},
      {"melt",
       "Solidus and liquidus over pressure; shocks that melt and vaporise on release",
       {from, to},
       "P_GPa",
       "liquidus_K",
       melt_table,
       melt_remarks,
       "whipple eos melt copper --to '100 GPa'"},
      {"dome",
       "Liquid and vapour in equilibrium",
       {from, to},
       "T_K",
       "P_MPa",
       dome_table,
       dome_remarks,
       "whipple eos dome copper"},
      {"cold",
       "Cold curve over density: pressure, energy, limits",
       {from, to},
       "V_over_V0",
       "P_GPa",
       cold_table,
       cold_remarks,
       "whipple eos cold copper --from '7 g/cm^3' --to '16 g/cm^3'"},
      {"match",
       "Impact of the first material on the second, and the shock transmitted into the others",
       {velocity},
       nullptr,
       nullptr,
       match_table,
       match_remarks,
       "whipple eos match copper aluminium --velocity '5.55 km/s'"},
      {"detonation",
       "Explosives: Chapman-Jouguet state, detonation velocity, Gurney velocity",
       {},
       nullptr,
       nullptr,
       detonation_table,
       nullptr,
       "whipple eos detonation tnt composition_b pbx_9404"},
      {"products",
       "Explosives: isentrope of the products from the Chapman-Jouguet state on",
       {to},
       "V_over_V0",
       "P_GPa",
       products_table,
       nullptr,
       "whipple eos products composition_b --to '1 bar' --plot products.png --log xy"},
      {"contact",
       "Detonation of the first material meets each of the others: pressure and velocity",
       {},
       nullptr,
       nullptr,
       contact_table,
       nullptr,
       "whipple eos contact composition_b copper aluminium_6061_t6 water"},
      {"gurney",
       "Explosives: Gurney's speeds of driven metal over the ratio of masses",
       {volume},
       "metal_over_explosive",
       "cylinder_km_s",
       gurney_table,
       nullptr,
       "whipple eos gurney composition_b --points 5"},
      {"cylinder",
       "Explosives: wall of the copper cylinder test, by steady flow",
       {from, to},
       "R_R0_mm",
       "radial_km_s",
       cylinder_table,
       nullptr,
       "whipple eos cylinder tnt --from '6 mm' --to '19 mm' --points 2"},
  };
  return all;
}

void add_quantities(CLI::App& sub, const std::vector<EosQuantity>& takes, EosOptions& options) {
  for (const auto& [quantity, name, text, help] : quantity_options) {
    if (std::ranges::find(takes, quantity) != takes.end()) sub.add_option(name, options.*text, help);
  }
}

}  // namespace whipple::app
