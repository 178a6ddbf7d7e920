// SPDX-License-Identifier: BSD-3-Clause
#include "src/shields/equations.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/shields/equation_forms.hpp"

namespace whipple::shields {
namespace {

constexpr double foam_thinnest = 12.0e-3, foam_thickest = 52.0e-3;  // m, panels of 0.5 to 2 inch

bool is_single(Equation equation) {
  return equation == Equation::single_perforation || equation == Equation::single_detached_spall ||
         equation == Equation::single_incipient_spall;
}

std::size_t bumpers_of(Equation equation) {
  if (is_single(equation)) return 0;
  return equation == Equation::srl_2008 ? 2 : 1;
}

}  // namespace

std::string_view source_of(Equation equation) {
  switch (equation) {
    case Equation::single_perforation:
      return "single wall, perforation: Cour-Palais (1987), NASA/TM-2009-214785; no bumper";
    case Equation::single_detached_spall:
      return "single wall, detached spall: Cour-Palais (1987), NASA/TM-2009-214785; no bumper";
    case Equation::single_incipient_spall:
      return "single wall, incipient spall: Cour-Palais (1987), NASA/TM-2009-214785; no bumper";
    case Equation::nno_1993:
      return "Whipple shield: Christiansen (1993); one bumper, angles above 65 degrees count as 65";
    case Equation::nno_2001:
      return "Whipple shield: Christiansen and Kerr (2001); one bumper, angles above 65 degrees count as 65";
    case Equation::jsc_2011:
      return "Whipple shield with thin bumpers: Ryan and Christiansen (2011); one bumper, angles above 65 "
             "degrees "
             "count as 65";
    case Equation::srl_2008:
      return "three sheets: Schaefer, Ryan, Lambert and Putzar (2008); two bumpers, angles above 65 degrees "
             "count "
             "as 65";
    case Equation::stuffed_2001:
      return "stuffed Whipple shield: Christiansen and Kerr (2001); one bumper and fabric";
    case Equation::foam_2009:
      return "foam panel: Ryan, Ordonez, Christiansen and Lear (2009); two sheets, 12 to 52 mm of foam "
             "between them";
  }
  throw InternalError("no such equation");
}

std::string reason_against(Equation equation, const Impact& impact) {
  const Shield& shield = impact.shield;
  const std::size_t bumpers = bumpers_of(equation);
  if (shield.bumpers.size() != bumpers)
    return fmt::format("it is for {} bumper{}, the shield has {}", bumpers, bumpers == 1 ? "" : "s",
                       shield.bumpers.size());
  const bool stuffed = shield.stuffing.areal_density > 0.0, foam = shield.foam.density > 0.0;
  if (stuffed != (equation == Equation::stuffed_2001))
    return stuffed ? "the shield is stuffed" : "the shield has no stuffing";
  if (foam != (equation == Equation::foam_2009))
    return foam ? "the shield has foam" : "the shield has no foam";
  if (foam) {
    const double thickness = shield.bumpers[0].spacing;
    if (thickness < foam_thinnest || thickness > foam_thickest)
      return fmt::format("it is for 12 to 52 mm of foam, the shield has {:.4g} mm", 1e3 * thickness);
  }
  return {};
}

double critical_diameter(Equation equation, const Impact& impact) {
  const std::string reason = reason_against(equation, impact);
  if (!reason.empty())
    throw InputError(fmt::format("the equation {} does not apply: {}", word_of(equation), reason));
  const forms::Input in = forms::input_of(impact);
  const auto in_metres = [](double cm) { return 0.01 * cm; };
  switch (equation) {
    case Equation::single_perforation:
      return in_metres(forms::single_wall(in, 1.8));
    case Equation::single_detached_spall:
      return in_metres(forms::single_wall(in, 2.2));
    case Equation::single_incipient_spall:
      return in_metres(forms::single_wall(in, 3.0));
    case Equation::nno_1993:
      return in_metres(forms::nno_1993(in));
    case Equation::nno_2001:
      return in_metres(forms::nno_2001(in));
    case Equation::jsc_2011:
      return in_metres(forms::jsc_2011(in));
    case Equation::srl_2008:
      return in_metres(forms::srl_2008(in));
    case Equation::stuffed_2001:
      return in_metres(forms::stuffed_2001(in));
    case Equation::foam_2009:
      return in_metres(forms::foam_2009(in));
  }
  throw InternalError("no such equation");
}

std::string reason_against_design(const Impact& impact) {
  const std::string reason = reason_against(Equation::nno_1993, impact);
  if (!reason.empty()) return reason;
  const double v_n = 1e-3 * impact.projectile.velocity * std::cos(impact.projectile.angle);
  if (v_n < 7.0) return fmt::format("it is for 7 km/s along the normal and more, this is {:.4g}", v_n);
  return {};
}

Design whipple_design(const Impact& impact) {
  const std::string reason = reason_against_design(impact);
  if (!reason.empty())
    throw InputError(fmt::format("the design of a Whipple shield does not apply: {}", reason));
  const forms::Input in = forms::input_of(impact);
  const double v_n = in.v * std::cos(impact.projectile.angle), d = 100.0 * impact.projectile.diameter;
  const double mass = std::numbers::pi / 6.0 * d * d * d * in.rho_p;
  const double share = in.spacing / d < 30.0 ? 0.25 : 0.20;
  const double wall = 0.16 * std::sqrt(d) * std::pow(in.rho_p * in.rho_b, 1.0 / 6.0) * std::cbrt(mass) * v_n /
                      std::sqrt(in.spacing) * std::sqrt(70.0 / in.sigma);
  return {.bumper = 0.01 * share * d * in.rho_p / in.rho_b, .wall = 0.01 * wall};
}

}  // namespace whipple::shields
