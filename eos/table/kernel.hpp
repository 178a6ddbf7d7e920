// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "eos/table/point_formulas.hpp"
#include "eos/table/table.hpp"

/// Provides the formulas of a table for one point, shared by its evaluation and its construction; Number is double, or a
/// register of four points (eos/table/four_points.hpp).
namespace whipple::eos::table {

constexpr std::string_view density_bound = "density outside the table";
constexpr std::string_view energy_bound = "specific internal energy above the table";

/// Holds values for the curves of a strip, or for its edges from the bottom to the top; the remaining entries are
/// unused.
using CurveNumbers = std::array<double, 12>;
static_assert(std::tuple_size_v<CurveNumbers> > TableData::greatest_regions);

/// Holds values and derivatives with respect to x = ln rho of e_0 and of the edges between the regions of a strip.
struct Curves {
  alignas(32) CurveNumbers value, slope, curvature;
};

/// Returns the edges of the regions, from the bottom to the top of a strip, with their derivatives with respect to x.
inline Curves edges(const TableData::Strip& strip, double x, double bottom, const Curves& curves) {
  const auto last = strip.region_count;
  Curves result = curves;
  result.value[0] = bottom;
  result.slope[0] = result.curvature[0] = 0;
  result.value[last] = strip.top + strip.top_slope * (x - strip.begin);
  result.slope[last] = strip.top_slope;
  result.curvature[last] = 0;
  return result;
}

/// Returns the value of S in a cell.
inline double polynomial_value(const double* cell, double tx, double ty) {
  double value = 0;
  for (int j = 5; j >= 0; --j) {
    double row = 0;
    for (int i = 5; i >= 0; --i) row = row * ty + cell[6 * j + i];
    value = value * tx + row;
  }
  return value;
}

}  // namespace whipple::eos::table
