// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "src/material/reaction/reaction.hpp"

namespace whipple::reaction {

/// Rate of JWL++, dF/dt = G p^b (1 - F), with G = r/p_r^b given by the rate r at a pressure p_r. The step is
/// exact at constant pressure: 1 - F falls by exp(-G p^b dt). Source: P. C. Souers, S. Anderson, J. Mercer,
/// E. McGuire, P. Vitello, Propellants Explos. Pyrotech. 25 (2000) 54; p is here the pressure of the equation
/// of state, without artificial viscosity.
struct JwlPlusPlus {
  double rate = 0.0;               ///< r, 1/s
  double rate_pressure = 1e10;     ///< p_r, Pa
  double pressure_exponent = 0.0;  ///< b
  Closure closure = Closure::volume;

  static ParameterTable<JwlPlusPlus> parameters() {
    using P = JwlPlusPlus;
    return {
        real("rate", &P::rate, "1/s", range::positive(), "r: relative rate of burning at the pressure p_r"),
        real("rate_pressure", &P::rate_pressure, "Pa", range::positive(), "p_r").optional(),
        real("pressure_exponent", &P::pressure_exponent, "", range::between(0.0, 10.0), "b"),
        choice("closure", &P::closure,
               "what reactant and products have in common: the volume, as published, or pressure and "
               "temperature")
            .optional()};
  }
  static constexpr const char* name = "jwl_plus_plus";
  static constexpr const char* summary = "rate by a power of the pressure (JWL++), for non-ideal explosives";
  static constexpr const char* theory =
      "dF/dt = r (p/p_r)^b (1 - F); pressures of reactant and products add with the weights 1 - F and F\n"
      "(closure \"volume\"), or are equal as their temperatures are (closure \"equilibrium\").\n"
      "Source: Souers et al., Propellants Explos. Pyrotech. 25 (2000) 54.";

  void require_consistent() const {}
  void advance(const State& state, std::span<double> burnt) const {
    const double exponent = -rate * state.time_step;
    for (std::size_t i = 0; i < burnt.size(); ++i) {
      if (!(state.pressure[i] > 0.0)) continue;
      burnt[i] = 1.0 - (1.0 - burnt[i]) * std::exp(exponent * std::pow(state.pressure[i] / rate_pressure,
                                                                       pressure_exponent));
    }
  }
};

}  // namespace whipple::reaction
