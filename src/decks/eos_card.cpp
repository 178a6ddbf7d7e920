// SPDX-License-Identifier: BSD-3-Clause
#include "src/decks/eos_card.hpp"

#include <fmt/format.h>

#include <utility>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/jwl.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "src/core/base/error.hpp"

namespace whipple::decks {
namespace {

using eos::JwlConstants;
using eos::MieGruneisenConstants;

/// Holds the differences between the formats.
struct Layout {
  char comment;
  std::size_t width;  ///< of a field
};
constexpr Layout layout(CardFormat format) {
  return format == CardFormat::ls_dyna ? Layout{'$', 10} : Layout{'#', 20};
}

/// Formats a value with as many digits, at most twelve, as fit into a field.
std::string field(double value, std::size_t width) {
  std::string text;
  for (int digits = 12; digits > 0 && (text.empty() || text.size() >= width); --digits)
    text = fmt::format("{:.{}g}", value == 0.0 ? 0.0 : value, digits);
  return fmt::format("{:>{}}", text, width);
}

/// Returns a comment with the names of fields, and the line of their values.
std::string line(CardFormat format, const std::vector<std::pair<std::string, double>>& fields) {
  const auto [comment, width] = layout(format);
  std::string names, values;
  for (const auto& [name, value] : fields) {
    names += fmt::format("{:>{}}", name, width);
    values += field(value, width);
  }
  names.front() = comment;
  return names + "\n" + values + "\n";
}

std::string heading(const std::string& material, std::string_view model, CardFormat format,
                    const UnitSystem& units, double density) {
  const char comment = layout(format).comment;
  const std::string density_unit = units.unit(dimension::density);
  return fmt::format(
      "{0} {1} ({2}), written by whipple eos card\n"
      "{0} units: {3}, {4}, {5}; pressure and energy per initial volume {6}, velocity {7}, density {8}\n"
      "{0} reference density {9} {8}: the material of the card needs it\n",
      comment, material, model, units.length, units.mass, units.time, units.unit(dimension::pressure),
      units.unit(dimension::velocity), density_unit, number(density));
}

std::string gruneisen_card(const std::string& material, const MieGruneisenConstants& k, CardFormat format,
                           const UnitSystem& units, int id) {
  const auto in_units = [&](double value, const Dimension& of) { return value / units.in_si(1.0, of); };
  // The thermal pressure of the card is (gamma0 + a mu) E, E per initial volume; rho Gamma = rho0 (gamma0 + a mu).
  double a = 0.0;
  if (k.gruneisen_law == eos::CompressedGruneisenLaw::constant) a = k.gruneisen;
  if (k.gruneisen_law == eos::CompressedGruneisenLaw::linear) a = k.gruneisen_slope;
  const double velocity = in_units(k.hugoniot_intercept, dimension::velocity);
  const double density = in_units(k.reference_density, dimension::density);
  std::string card = heading(material, "mie_gruneisen", format, units, density);
  const char comment = layout(format).comment;
  if (a != k.gruneisen) {
    card += fmt::format(
        "{} compressed states are those of the material; expanded ones have (gamma0 + a mu) E for (gamma0 + "
        "gamma0 mu) "
        "E\n",
        comment);
  }
  card += fmt::format("{} temperatures need the heat capacity {:.6g} J/(kg K) in the material\n", comment,
                      k.heat_capacity);
  switch (format) {
    case CardFormat::ls_dyna:
      card += "*EOS_GRUNEISEN\n" +
              line(format, {{"eosid", id},
                            {"c", velocity},
                            {"s1", k.hugoniot_slope},
                            {"s2", k.hugoniot_quadratic},
                            {"s3", k.hugoniot_cubic},
                            {"gamma0", k.gruneisen},
                            {"a", a},
                            {"e0", 0.0}}) +
              line(format, {{"v0", 1.0}});
      break;
    case CardFormat::openradioss:
      card += fmt::format("/EOS/GRUNEISEN/{}\n{}\n", id, material) +
              line(format, {{"C", velocity},
                            {"S1", k.hugoniot_slope},
                            {"S2", k.hugoniot_quadratic},
                            {"S3", k.hugoniot_cubic}}) +
              line(format, {{"gamma0", k.gruneisen}, {"a", a}, {"E0", 0.0}, {"rho0", density}});
      break;
  }
  return card;
}

std::string jwl_card(const std::string& material, const JwlConstants& k, CardFormat format,
                     const UnitSystem& units, int id) {
  if (format != CardFormat::ls_dyna)
    throw InputError(fmt::format("{}: no card of openradioss is written for jwl; ls-dyna has one", material));
  const double pressure = units.in_si(1.0, dimension::pressure);
  const double density = k.reference_density / units.in_si(1.0, dimension::density);
  return heading(material, "jwl", format, units, density) +
         fmt::format(
             "{} detonation velocity and pressure belong into the material (*MAT_HIGH_EXPLOSIVE_BURN)\n",
             layout(format).comment) +
         "*EOS_JWL\n" +
         line(format, {{"eosid", id},
                       {"a", k.pressure_1 / pressure},
                       {"b", k.pressure_2 / pressure},
                       {"r1", k.exponent_1},
                       {"r2", k.exponent_2},
                       {"omega", k.gruneisen},
                       {"e0", k.detonation_energy / pressure},
                       {"v0", 1.0}});
}

}  // namespace

std::string eos_card(const std::string& material, const eos::EquationOfState& eos, CardFormat format,
                     const UnitSystem& units, int number) {
  if (const auto* solid = dynamic_cast<const eos::ModelEquationOfState<eos::MieGruneisen>*>(&eos))
    return gruneisen_card(material, solid->underlying().constants(), format, units, number);
  if (const auto* products = dynamic_cast<const eos::ModelEquationOfState<eos::Jwl>*>(&eos))
    return jwl_card(material, products->underlying().constants(), format, units, number);
  throw InputError(fmt::format(
      "{}: the equation of state is {}; cards are written of mie_gruneisen and jwl. 'whipple eos table "
      "MATERIAL --sesame FILE' writes a table of any",
      material, eos.model()));
}

}  // namespace whipple::decks
