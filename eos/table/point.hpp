// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "eos/point_state.hpp"
#include "eos/table/point_formulas.hpp"
#include "src/core/base/registers.hpp"

/// Evaluation of a table (eos/table/table.hpp) at one point from an array of numbers: p, T, c and phases of
/// `Table::evaluate`.
namespace whipple::eos::table {

/// Numbers of the records in the array.
constexpr std::uint32_t slab_numbers = 32, curve_numbers = 24, region_numbers = 8, cell_numbers = 36;

/// Constants of the evaluation, and where its parts begin in the array: slabs with their curves, further curves, regions,
/// the slab of each bin, cells, and phase fractions.
struct Point {
  std::uint32_t slabs = 0, more_curves = 0, regions = 0, slab_of_bin = 0, cells = 0, fractions = 0;
  double begin = 0, end = 0, bins_per_length = 0;  ///< ln rho
  double thermal_energy = 0;                       ///< e - e_0 of the coldest state, J/kg
  double bottom = 0;                               ///< its logarithm
  double least_squared = 0;                        ///< least c^2, m^2/s^2
};

/// Value and derivatives of a curve of a strip over ln rho.
struct CurvePoint {
  double value, slope, half_curvature;
};

/// Returns a curve of a group of four, whose powers stand four numbers apart.
WHIPPLE_POINT inline CurvePoint curve_at(const double* curve, double t) {
  CurvePoint at;
  horner([&](std::size_t i) { return curve[4 * i]; }, t, at.value, at.slope, at.half_curvature);
  return at;
}
WHIPPLE_POINT inline double curve_value(const double* curve, double t) {
  double value = curve[20];
  for (int i = 5; i-- > 0;) value = value * t + curve[4 * i];
  return value;
}

/// Returns the index of the interval, of n equal ones, that contains a position from 0 to n; NaN gives the first.
WHIPPLE_POINT inline double piece_of(double position, double n) {
  return std::trunc(minimum(maximum(position, 0.0), n - 1.0));
}

/// Returns melted and vaporised fraction, interpolated between the corners of a cell.
/// @param x, y  position in the region, from 0 to 1
WHIPPLE_POINT inline void interpolate_fractions(const Point& table, const double* tables,
                                                const double* region, double x, double y, PointState& state) {
  const double nx = region[5], ny = region[6], px = x * nx, py = y * ny;
  const double ix = piece_of(px, nx), iy = piece_of(py, ny), u = px - ix;
  const double v = minimum(maximum(py - iy, 0.0), 1.0);
  const double* corner =
      tables + table.fractions + static_cast<std::uint32_t>(region[7] + ix * (ny + 1.0) + iy);
  const double* next = corner + static_cast<std::uint32_t>(ny + 1.0);
  // Both fractions in units of 1/65535 in one number
  const auto melted = [](double pair) { return static_cast<double>(static_cast<std::uint32_t>(pair) >> 16); };
  const auto vaporised = [](double pair) {
    return static_cast<double>(static_cast<std::uint32_t>(pair) & 0xffffU);
  };
  const auto mixed = [&](double a, double b, double c, double d) {
    const double lower = a + u * (b - a), upper = c + u * (d - c);
    return (lower + v * (upper - lower)) * (1.0 / 65535);
  };
  const double a = corner[0], b = next[0], c = corner[1], d = next[1];
  state.melted = mixed(melted(a), melted(b), melted(c), melted(d));
  state.vaporised = mixed(vaporised(a), vaporised(b), vaporised(c), vaporised(d));
}

/// Returns the state at a density (kg/m^3) and a specific internal energy (J/kg).
WHIPPLE_POINT inline PointState evaluate_point(const Point& table, const double* tables, double density,
                                               double energy) {
  const double x = std::log(density), inside = minimum(maximum(x, table.begin), table.end);
  if (!std::isfinite(x) || !std::isfinite(energy)) return unknown_point(PointEvent::not_a_number);
  if (x != inside) return unknown_point(PointEvent::density);
  const auto bin = static_cast<std::uint32_t>((inside - table.begin) * table.bins_per_length);
  const double* slab =
      tables + table.slabs + slab_numbers * static_cast<std::uint32_t>(tables[table.slab_of_bin + bin]);
  while (inside >= slab[curve_numbers + 1]) slab += slab_numbers;
  const double* const limits =
      slab + curve_numbers;  // begin, end, top, slope of the top, first region, regions, curves
  const double t = inside - limits[0];
  const auto first_region = static_cast<std::uint32_t>(limits[4]), n = static_cast<std::uint32_t>(limits[5]);
  const double* const more =
      tables + table.more_curves + curve_numbers * static_cast<std::uint32_t>(limits[6]);
  const auto curve = [&](std::uint32_t edge) { return edge < 4 ? slab + edge : more + (edge - 4); };
  const CurvePoint top = {limits[2] + limits[3] * t, limits[3], 0.0};

  const CurvePoint base = curve_at(slab, t);
  double thermal = energy - base.value;
  std::uint8_t events = 0;
  if (!(thermal >= table.thermal_energy)) {
    events = static_cast<std::uint8_t>(PointEvent::below_cold_curve);
    thermal = table.thermal_energy;
  }
  const double z = std::log(thermal), inverse_thermal = 1.0 / thermal;
  if (z > top.value) return unknown_point(PointEvent::energy);
  std::uint32_t k = 0;  // region, counted from the bottom
  for (std::uint32_t edge = 1; edge < n; ++edge) k += z > curve_value(curve(edge), t) ? 1 : 0;

  // The lowest edge is the bottom; e_0 is stored in its place.
  const CurvePoint low = k == 0 ? CurvePoint{table.bottom, 0.0, 0.0} : curve_at(curve(k), t);
  const CurvePoint high = k + 1 == n ? top : curve_at(curve(k + 1), t);
  const double inverse = 1.0 / maximum(high.value - low.value, least_width);
  const double y = (z - low.value) * inverse;

  const double* const region = tables + table.regions + region_numbers * (first_region + k);
  const double inverse_length = region[1], nx = region[2], ny = region[3];
  const double strip_x = (inside - region[0]) * inverse_length, px = strip_x * nx, py = y * ny;
  const double ix = piece_of(px, nx), iy = piece_of(py, ny);
  const double* const cell =
      tables + table.cells + cell_numbers * static_cast<std::uint32_t>(region[4] + ix * ny + iy);
  const Polynomial<double> s = polynomial(cell, px - ix, py - iy);
  const double by_x = nx * inverse_length, by_y = ny;
  const Thermal<double> result = eos::table::thermal(
      density,
      slopes<double>({s.x * by_x, s.y * by_y, s.xx * by_x * by_x, s.xy * by_x * by_y, s.yy * by_y * by_y},
                     {y, inverse, inverse_thermal, base.slope, 2.0 * base.half_curvature, low.slope,
                      2.0 * low.half_curvature, high.slope - low.slope,
                      2.0 * (high.half_curvature - low.half_curvature)}));
  // The floor is the first operand: a NaN in the second operand is preserved.
  PointState state = {result.pressure,
                      result.temperature,
                      std::sqrt(maximum(table.least_squared, result.squared_sound_speed)),
                      0.0,
                      0.0,
                      events};
  interpolate_fractions(table, tables, region, strip_x, y, state);
  return state;
}

}  // namespace whipple::eos::table
