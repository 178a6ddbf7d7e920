// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "src/core/base/words.hpp"
#include "src/shields/shield.hpp"

/// Ballistic limit equations: the diameter of the sphere that a shield just stops (docs/theory/ballistic_limits.md).
namespace whipple::shields {

/// Selects an equation.
enum class Equation : std::uint8_t {
  single_perforation,
  single_detached_spall,
  single_incipient_spall,
  nno_1993,
  nno_2001,
  jsc_2011,
  srl_2008,
  stuffed_2001,
  foam_2009
};
constexpr std::array<Word<Equation>, 9> words(Equation) {
  return {{{Equation::single_perforation, "single_perforation"},
           {Equation::single_detached_spall, "single_detached_spall"},
           {Equation::single_incipient_spall, "single_incipient_spall"},
           {Equation::nno_1993, "nno_1993"},
           {Equation::nno_2001, "nno_2001"},
           {Equation::jsc_2011, "jsc_2011"},
           {Equation::srl_2008, "srl_2008"},
           {Equation::stuffed_2001, "stuffed_2001"},
           {Equation::foam_2009, "foam_2009"}}};
}

/// Returns subject, source and range of an equation, one line.
std::string_view source_of(Equation equation);

/// Returns why an equation does not apply to an impact; empty: it applies. The diameter of the sphere does not matter.
std::string reason_against(Equation equation, const Impact& impact);

/// Computes the diameter (m) of the sphere that the shield just stops, by an equation.
/// @throws InputError naming the equation and the reason if it does not apply
double critical_diameter(Equation equation, const Impact& impact);

/// Returns why the design equation does not apply to an impact; empty: it applies.
std::string reason_against_design(const Impact& impact);

/// Holds the thicknesses (m) that stop a sphere at speeds beyond 7 km/s.
struct Design {
  double bumper = 0.0, wall = 0.0;
};

/// Computes bumper and wall of a Whipple shield for the sphere, materials and spacing of an impact: t_b = c d rho_p/rho_b,
/// c = 0.25 where S/d < 30, otherwise 0.20; t_w = 0.16 d^(1/2) (rho_p rho_b)^(1/6) M^(1/3) V_n S^(-1/2) (70/sigma)^(1/2)
/// in cm, g/cm^3, g, km/s, ksi (Christiansen, Int. J. Impact Eng. 14 (1993) 145; NASA/TM-2009-214785).
/// @throws InputError if V_n < 7 km/s or there is not exactly one bumper
Design whipple_design(const Impact& impact);

}  // namespace whipple::shields
