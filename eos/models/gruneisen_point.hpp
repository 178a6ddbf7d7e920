// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "eos/point_state.hpp"
#include "src/core/base/registers.hpp"

/// Evaluation of a GruneisenSolid with a constant heat capacity at one point, from the polynomials of its table: p, T and c
/// of `ConstantHeatCapacity::evaluate`.
namespace whipple::eos {

/// Constants of the evaluation. The polynomials stand in an array of numbers from `cells` on: for each cell the powers of
/// the distance from its centre, and for each power A, C, D and e_c (`FourfoldTable`).
struct GruneisenPoint {
  std::uint32_t cells = 0;
  double first = 0, per_width = 0;  ///< centre of the first cell, kg/m^3, and cells per kg/m^3
  double least_density = 0, maximum_density = 0;
  double density = 0;                                  ///< rho0
  double B0 = 0, linear = 0, quadratic = 0;            ///< rho Gamma in compression, over rho - rho0
  double gruneisen = 0;                                ///< in expansion
  double A0 = 0, A1 = 0;                               ///< A = A0 + A1 rho/rho0 in expansion
  double power = 0, inverse_volume = 0, constant = 0;  ///< of e_c in expansion
  double heat_capacity = 0;                            ///< J/(kg K)
  double least_temperature = 0;                        ///< K
  double least_squared = 0;                            ///< least c^2, m^2/s^2
};

/// Values on the isochore of a point: p = A + B e, c^2 = C + D e.
struct PointIsochore {
  double cold_energy, A, B, C, D;
};

/// Returns the isochore in the range of the table.
WHIPPLE_POINT inline PointIsochore tabulated_isochore(const GruneisenPoint& model, const double* tables,
                                                      double density) {
  constexpr int terms = 6;
  const double place = (density - model.first) * model.per_width, cell = std::rint(place), t = place - cell;
  const double* at = tables + model.cells + static_cast<std::uint32_t>(cell) * (4 * terms);
  double A = at[4 * (terms - 1)], C = at[4 * (terms - 1) + 1], D = at[4 * (terms - 1) + 2],
         cold_energy = at[4 * (terms - 1) + 3];
  for (int i = terms - 1; i-- > 0;) {
    A = A * t + at[4 * i];
    C = C * t + at[4 * i + 1];
    D = D * t + at[4 * i + 2];
    cold_energy = cold_energy * t + at[4 * i + 3];
  }
  const double distance = density - model.density;
  const double slope = distance < 0.0 ? model.gruneisen : model.linear + model.quadratic * distance;
  return {cold_energy, A, model.B0 + distance * slope, C, D};
}

/// Returns the isochore of material that is less dense than the table.
WHIPPLE_POINT inline PointIsochore expanded_isochore(const GruneisenPoint& model, double density) {
  const double inverse_density = 1.0 / model.density, G = model.gruneisen, V = 1.0 / density,
               r = density * inverse_density;
  const double A = model.A0 + model.A1 * r, work = G * V;
  double cold_energy = -model.inverse_volume * model.density * V - model.constant;
  if (G > 0) {
    cold_energy += model.power * std::pow(r, G);
  } else {
    cold_energy += model.power + model.A1 * inverse_density * std::log(r);
  }
  return {cold_energy, A, G * density, model.A1 * inverse_density + A * work, G * (1 + G)};
}

/// Returns the state at a density (kg/m^3) and a specific internal energy (J/kg).
WHIPPLE_POINT inline PointState evaluate_point(const GruneisenPoint& model, const double* tables,
                                               double density, double energy) {
  if (!(density > 0.0) || !std::isfinite(density) || !std::isfinite(energy)) {
    return unknown_point(PointEvent::not_a_number);
  }
  if (density > model.maximum_density) return unknown_point(PointEvent::density);
  const PointIsochore at = density < model.least_density ? expanded_isochore(model, density)
                                                         : tabulated_isochore(model, tables, density);
  const double inverse_heat = 1 / model.heat_capacity;
  double temperature = (energy - at.cold_energy) * inverse_heat;
  std::uint8_t events = 0;
  if (!(temperature >= model.least_temperature)) {
    const double coldest = at.cold_energy + model.heat_capacity * model.least_temperature;
    if (energy < coldest) events = static_cast<std::uint8_t>(PointEvent::below_cold_curve);
    energy = maximum(energy, coldest);
    temperature = maximum((energy - at.cold_energy) * inverse_heat, model.least_temperature);
  }
  // The floor is the first operand: a NaN in the second operand is preserved.
  return {at.A + at.B * energy,
          temperature,
          std::sqrt(maximum(model.least_squared, at.C + at.D * energy)),
          0.0,
          0.0,
          events};
}

}  // namespace whipple::eos
