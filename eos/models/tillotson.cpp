// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/models/tillotson.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "eos/constant_heat_capacity_batch.hpp"

namespace whipple::eos {

template class ConstantHeatCapacity<TillotsonCurve>;

ParameterTable<TillotsonConstants> TillotsonCurve::parameters() {
  using C = TillotsonConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at zero pressure and energy"),
      real("thermal_a", &C::thermal_a, "", range::positive(),
           "a, p/(rho e) of the thin vapour: its heat capacity ratio less 1"),
      real("thermal_b", &C::thermal_b, "", range::non_negative(),
           "b; a + b is the Grueneisen parameter of the cold condensed state"),
      real("bulk_modulus", &C::bulk_modulus, "Pa", range::positive(), "A, of the reference state"),
      real("quadratic_modulus", &C::quadratic_modulus, "Pa", range::non_negative(),
           "B, factor of (rho/rho0 - 1)^2"),
      real("expansion_alpha", &C::expansion_alpha, "", range::non_negative(),
           "alpha, of exp[-alpha (rho0/rho - 1)^2] in the vapour"),
      real("expansion_beta", &C::expansion_beta, "", range::non_negative(),
           "beta, of exp[-beta (rho0/rho - 1)] in the vapour"),
      real("energy_scale", &C::energy_scale, "J/kg", range::positive(), "E0 of 1 + e/(E0 (rho/rho0)^2)"),
      real("incipient_vaporisation_energy", &C::incipient_vaporisation_energy, "J/kg", range::positive(),
           "E_iv"),
      real("complete_vaporisation_energy", &C::complete_vaporisation_energy, "J/kg", range::positive(),
           "E_cv, above E_iv"),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(),
           "c_v, constant; of the temperature only"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

TillotsonCurve::TillotsonCurve(const Constants& constants) : constants_(constants) {
  const Constants& k = constants_;
  if (k.complete_vaporisation_energy <= k.incipient_vaporisation_energy) {
    throw InputError(fmt::format(
        "tillotson: complete_vaporisation_energy ({:.4g} J/kg) must exceed incipient_vaporisation_energy "
        "({:.4g} J/kg)",
        k.complete_vaporisation_energy, k.incipient_vaporisation_energy));
  }
  tabulate_isentrope();
}

double TillotsonCurve::reference_sound_speed() const {
  return std::sqrt(constants_.bulk_modulus / constants_.reference_density);
}

std::string_view TillotsonCurve::phase(double rho, double energy) const {
  if (rho >= constants_.reference_density || energy <= constants_.incipient_vaporisation_energy) {
    return "condensed";
  }
  return energy < constants_.complete_vaporisation_energy ? "liquid and vapour" : "vapour";
}

void TillotsonCurve::tabulate_isentrope() {
  // de_s/dx = p/rho0, d ln T_s/dx = (dp/de)/rho0 along the isentrope of the reference state  (T4): classical
  // fourth-order Runge-Kutta method with small steps, and one more step to intermediate points.
  struct Point {
    double energy, log_temperature;
  };
  const double rho0 = constants_.reference_density, last = 1 - 1 / greatest_compression_ratio;
  const auto slope = [&](double x, const Point& s) {
    const Lanes rho = broadcast(rho0 / (1 - x));
    const Isochore at{&constants_, rho, 1.0 / rho, Lanes{}, rho / rho0 - 1.0, LanesMask{}};
    const Response r = at.response(broadcast(s.energy));
    return Point{r.pressure[0] / rho0, r.by_energy[0] / rho0};
  };
  const auto step_from = [&](double x, const Point& s, double h) {
    const auto moved = [&](const Point& by, double part) {
      return Point{s.energy + part * by.energy, s.log_temperature + part * by.log_temperature};
    };
    const Point k1 = slope(x, s), k2 = slope(x + 0.5 * h, moved(k1, 0.5 * h));
    const Point k3 = slope(x + 0.5 * h, moved(k2, 0.5 * h)), k4 = slope(x + h, moved(k3, h));
    return Point{s.energy + h / 6 * (k1.energy + 2 * k2.energy + 2 * k3.energy + k4.energy),
                 s.log_temperature + h / 6 *
                                         (k1.log_temperature + 2 * k2.log_temperature +
                                          2 * k3.log_temperature + k4.log_temperature)};
  };
  constexpr int steps = 8192;
  const double h = last / steps;
  std::vector<Point> points{{0.0, std::log(constants_.reference_temperature)}};
  for (int i = 0; i < steps; ++i) points.push_back(step_from(i * h, points.back(), h));
  const auto at = [&](double x) {
    const int i = std::clamp(static_cast<int>(x / h), 0, steps);
    return step_from(i * h, points[static_cast<std::size_t>(i)], x - i * h);
  };
  const double heat = constants_.heat_capacity, T0 = constants_.reference_temperature;
  cold_energy_ = CubicTable(
      [&](double x) {
        const Point s = at(x);
        return (s.energy - heat * std::exp(s.log_temperature)) * (1 - x) * (1 - x);
      },
      last, heat * T0);
  isentrope_temperature_ = CubicTable([&](double x) { return std::exp(at(x).log_temperature); }, last, T0);
}

double TillotsonCurve::cold_energy_slope(double rho) const {
  const double rho0 = constants_.reference_density, heat = constants_.heat_capacity;
  if (rho < rho0) return 0.0;
  // e_c = e_s - c_v T_s
  const Isochore here = isochore(broadcast(rho));
  const double temperature = isentrope_temperature_(broadcast(1 - rho0 / rho))[0];
  const Response s = here.response(here.cold_energy + heat * temperature);
  return (s.pressure[0] - heat * temperature * s.by_energy[0]) / (rho * rho);
}

}  // namespace whipple::eos
