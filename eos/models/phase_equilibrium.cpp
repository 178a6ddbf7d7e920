// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/phase_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace whipple::eos {

std::optional<CommonTangent> common_tangent(const PhaseSurfaceFunction& dense,
                                            const PhaseSurfaceFunction& thin, double T, double Vs, double Vl,
                                            const VolumeRange& range) {
  for (int i = 0; i < 40; ++i) {
    const GrayPoint s = dense(Vs, T), l = thin(Vl, T);
    // d(P_s - P_l) = Q_s dV_s - Q_l dV_l,  d(G_s - G_l) = V_s Q_s dV_s - V_l Q_l dV_l,  Q = (dP/dV)_T
    const double dP = s.pressure - l.pressure, dG = s.gibbs(Vs, T) - l.gibbs(Vl, T);
    const double width = Vl - Vs;
    if (!(width > 0) || !(s.pressure_by_volume < 0) || !(l.pressure_by_volume < 0)) return std::nullopt;
    const double step_s = -(Vl * dP - dG) / (s.pressure_by_volume * width);
    const double step_l = -(Vs * dP - dG) / (l.pressure_by_volume * width);
    Vs += step_s;
    Vl += step_l;
    if (!(Vs > range.least) || !(Vl < range.greatest)) return std::nullopt;
    if (std::abs(step_s) + std::abs(step_l) > 1e-12 * Vs) continue;

    const GrayPoint solid = dense(Vs, T), liquid = thin(Vl, T);
    CommonTangent n{.T = T, .dense = Vs, .thin = Vl, .P = solid.pressure, .g = solid.gibbs(Vs, T)};
    n.P1 = (liquid.entropy - solid.entropy) / (Vl - Vs);  // Clausius and Clapeyron
    n.dense1 = (n.P1 - solid.pressure_by_temperature) / solid.pressure_by_volume;
    n.thin1 = (n.P1 - liquid.pressure_by_temperature) / liquid.pressure_by_volume;
    const double solid_slope = solid.heat_capacity / T + solid.pressure_by_temperature * n.dense1;  // dS/dT
    const double liquid_slope = liquid.heat_capacity / T + liquid.pressure_by_temperature * n.thin1;
    n.P2 = (liquid_slope - solid_slope - n.P1 * (n.thin1 - n.dense1)) / (Vl - Vs);
    n.g1 = Vs * n.P1 - solid.entropy;
    n.g2 = n.dense1 * n.P1 + Vs * n.P2 - solid_slope;
    return n;
  }
  return std::nullopt;
}

void add_curvatures(std::vector<HermiteTable::Node>& nodes, double step) {
  const std::size_t n = nodes.size();
  const auto slope = [&](std::size_t i) { return nodes[i].slope; };
  for (std::size_t i = 0; i < n; ++i) {
    // Centre of the five-point stencil, and the position of the point in it.
    const std::size_t centre = std::clamp<std::size_t>(i, 2, n - 3);
    static constexpr double weights[5][5] = {{-25, 48, -36, 16, -3},
                                             {-3, -10, 18, -6, 1},
                                             {1, -8, 0, 8, -1},
                                             {-1, 6, -18, 10, 3},
                                             {3, -16, 36, -48, 25}};
    double sum = 0;
    for (std::size_t k = 0; k < 5; ++k) sum += weights[i + 2 - centre][k] * slope(centre - 2 + k);
    nodes[i].curvature = sum / (12 * step);
  }
}

}  // namespace whipple::eos
