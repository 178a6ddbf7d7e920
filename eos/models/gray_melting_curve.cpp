// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/gray_melting_curve.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr int intervals = 512;
/// Minimum extent of a curve relative to the melting temperature.
constexpr double least_reach = 1.05;
/// Maximum relative change of the slope dP/dT within an interval. Where the volumes of solid and liquid approach
/// each other the slope is unbounded, and a table across that end would contain arbitrary pressures.
constexpr double most_bending = 1.0;

/// Holds the common tangent at one temperature, with its derivatives along the curve.
struct Node {
  double T = 0, Vs = 0, Vl = 0, P = 0, g = 0;
  double Vs1 = 0, Vl1 = 0;  // dV/dT
  double P1 = 0, P2 = 0;    // dP/dT, d^2P/dT^2
  double g1 = 0, g2 = 0;
};

/// Solves P_s = P_l and G_s = G_l by Newton's method from a close guess; nothing if it leaves the stable branches.
std::optional<Node> tangent(const SolidLiquidSurfaces& f, double T, double Vs, double Vl) {
  for (int i = 0; i < 40; ++i) {
    const GrayPoint s = f.solid(Vs, T), l = f.liquid(Vl, T);
    // d(P_s - P_l) = Q_s dV_s - Q_l dV_l,  d(G_s - G_l) = V_s Q_s dV_s - V_l Q_l dV_l,  Q = (dP/dV)_T
    const double dP = s.pressure - l.pressure, dG = s.gibbs(Vs, T) - l.gibbs(Vl, T);
    const double width = Vl - Vs;
    if (!(width > 0) || !(s.pressure_by_volume < 0) || !(l.pressure_by_volume < 0)) return std::nullopt;
    const double step_s = -(Vl * dP - dG) / (s.pressure_by_volume * width);
    const double step_l = -(Vs * dP - dG) / (l.pressure_by_volume * width);
    Vs += step_s;
    Vl += step_l;
    if (!(Vs > 0.5 * f.least_volume) || !(Vl < 2 * f.join_volume)) return std::nullopt;
    if (std::abs(step_s) + std::abs(step_l) > 1e-12 * Vs) continue;

    const GrayPoint solid = f.solid(Vs, T), liquid = f.liquid(Vl, T);
    Node n{.T = T, .Vs = Vs, .Vl = Vl, .P = solid.pressure, .g = solid.gibbs(Vs, T)};
    n.P1 = (liquid.entropy - solid.entropy) / (Vl - Vs);  // Clausius and Clapeyron
    n.Vs1 = (n.P1 - solid.pressure_by_temperature) / solid.pressure_by_volume;
    n.Vl1 = (n.P1 - liquid.pressure_by_temperature) / liquid.pressure_by_volume;
    const double solid_slope = solid.heat_capacity / T + solid.pressure_by_temperature * n.Vs1;  // dS/dT
    const double liquid_slope = liquid.heat_capacity / T + liquid.pressure_by_temperature * n.Vl1;
    n.P2 = (liquid_slope - solid_slope - n.P1 * (n.Vl1 - n.Vs1)) / (Vl - Vs);
    n.g1 = Vs * n.P1 - solid.entropy;
    n.g2 = n.Vs1 * n.P1 + Vs * n.P2 - solid_slope;
    return n;
  }
  return std::nullopt;
}

/// Follows the curve from a node to a nearby temperature.
std::optional<Node> follow(const SolidLiquidSurfaces& f, const Node& from, double T) {
  return tangent(f, T, from.Vs + from.Vs1 * (T - from.T), from.Vl + from.Vl1 * (T - from.T));
}

/// Follows the curve in tension, where it bends, by halved steps if one is too long.
std::optional<Node> follow_closely(const SolidLiquidSurfaces& f, const Node& from, double T) {
  for (int steps = 1; steps <= 64; steps *= 2) {
    std::optional<Node> at = from;
    for (int i = 1; i <= steps && at; ++i)
      at = follow(f, *at, i == steps ? T : from.T + (T - from.T) * i / steps);
    if (at) return at;
  }
  return std::nullopt;
}

/// Marches from a node by steps of a factor in T until `past` holds; returns the last point before it, to 1e-12 in T.
Node march(const SolidLiquidSurfaces& f, Node at, double factor,
           const std::function<bool(const Node&)>& past) {
  constexpr int most_steps = 10000;  // 2 % each: longer than the curve of any material
  for (int i = 0; i < most_steps && std::abs(factor - 1) > 1e-12; ++i) {
    const std::optional<Node> next = follow(f, at, at.T * factor);
    if (next && !past(*next)) {
      at = *next;
    } else {
      factor = 1 + 0.5 * (factor - 1);
    }
  }
  return at;
}

/// Computes curvatures from exact slopes on a uniform grid, by fourth-order differences.
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

/// Inverts a decreasing volume table V(T) to T(V) at uniform volumes.
HermiteTable inverse(const HermiteTable& volume, double T_low, double T_high, double V_low, double V_high) {
  const double step = (V_high - V_low) / intervals;
  std::vector<HermiteTable::Node> nodes;
  for (int i = 0; i <= intervals; ++i) {
    const double V = V_low + i * step;
    double low = T_low, high = T_high, T = i == 0 ? T_high : nodes.back().value;
    HermiteTable::Node v;
    for (int k = 0; k < 100; ++k) {  // Newton's method within a shrinking bracket
      v = volume.at(T);
      (v.value > V ? low : high) = T;
      double next = T - (v.value - V) / v.slope;
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double change = std::abs(next - T);
      T = next;
      if (change < 1e-14 * T) break;
    }
    v = volume.at(T);
    nodes.push_back({T, 1 / v.slope, -v.curvature / (v.slope * v.slope * v.slope)});
  }
  return HermiteTable(V_low, step, std::move(nodes));
}

SolidLiquidSurfaces melting_surfaces(const GrayFreeEnergy& surface) {
  const GrayConstants& c = surface.constants();
  return {.solid = [&surface](double V, double T) { return surface.solid(V, T); },
          .liquid = [&surface](double V, double T) { return surface.liquid(V, T); },
          .start_volume = c.reference_specific_volume,
          .start_temperature = c.melting_temperature,
          .least_volume = surface.least_volume(),
          .join_volume = surface.join_volume()};
}

}  // namespace

GrayMeltingCurve::GrayMeltingCurve(const GrayFreeEnergy& surface)
    : GrayMeltingCurve(melting_surfaces(surface)) {}

GrayMeltingCurve::GrayMeltingCurve(const SolidLiquidSurfaces& f) {
  const double T0 = f.start_temperature, V0 = f.start_volume;
  // Solid and liquid are on opposite sides of the isochore on which their free energies are equal.
  std::optional<Node> start;
  for (const double width : {0.02, 0.04, 0.08, 0.01}) {
    if ((start = tangent(f, T0, V0 * (1 - width), V0 * (1 + width)))) break;
  }
  if (!start) {
    throw InputError(fmt::format(
        "gray: melting = \"equilibrium\" finds no common tangent of solid and liquid at melting_temperature "
        "({} K); check melting_entropy, melting_gruneisen and gruneisen",
        T0));
  }
  const Node first = march(f, *start, 0.98, [&](const Node& n) { return n.Vl > f.join_volume; });
  Node last = march(f, *start, 1.02, [&](const Node& n) {
    const double step = (n.T - first.T) / intervals;
    return n.Vs < f.least_volume || !(std::abs(n.P2) * step < most_bending * std::abs(n.P1));
  });
  // The curve ends where the common tangent is lost before the compression limit of the solid.
  std::vector<Node> curve;
  for (;;) {
    curve.assign(1, first);
    const double step = (last.T - first.T) / intervals;
    for (int i = 1; i <= intervals; ++i) {
      const double T = i == intervals ? last.T : first.T + i * step;
      const std::optional<Node> next =
          T < start->T ? follow_closely(f, curve.back(), T) : follow(f, curve.back(), T);
      if (!next) break;
      curve.push_back(*next);
    }
    if (curve.size() > intervals) break;
    last = curve.back();
    if (last.T < least_reach * start->T) {
      throw InputError(
          fmt::format("gray: melting = \"equilibrium\" loses the common tangent of solid and liquid above "
                      "{:.6g} K, {:.6g} Pa; melting = \"band\" needs none",
                      last.T, last.P));
    }
  }

  for (const Node& n : curve) {
    if (n.Vs1 < 0 && n.Vl1 < 0) continue;
    throw InputError(
        fmt::format("melting curve: the volume of a phase grows along it at {:.6g} K, {:.6g} Pa", n.T, n.P));
  }
  const double step = (last.T - first.T) / intervals;
  std::vector<HermiteTable::Node> pressure, gibbs, solid, liquid;
  for (const Node& n : curve) {
    pressure.push_back({n.P, n.P1, n.P2});
    gibbs.push_back({n.g, n.g1, n.g2});
    solid.push_back({n.Vs, n.Vs1, 0});
    liquid.push_back({n.Vl, n.Vl1, 0});
  }
  add_curvatures(solid, step);
  add_curvatures(liquid, step);
  pressure_ = HermiteTable(first.T, step, std::move(pressure));
  gibbs_ = HermiteTable(first.T, step, std::move(gibbs));
  solid_volume_ = HermiteTable(first.T, step, std::move(solid));
  liquid_volume_ = HermiteTable(first.T, step, std::move(liquid));
  coldest_ = {first.T, first.P, first.Vs, first.Vl};
  hottest_ = {last.T, last.P, last.Vs, last.Vl};
  solidus_ = inverse(solid_volume_, first.T, last.T, last.Vl, first.Vs);
  liquidus_ = inverse(liquid_volume_, first.T, last.T, last.Vl, first.Vl);
}

GrayMeltingCurve::Tangent GrayMeltingCurve::at_temperature(double T) const {
  return {T, pressure_(T), solid_volume_(T), liquid_volume_(T)};
}

GrayMeltingCurve::Tangent GrayMeltingCurve::at_pressure(double pressure) const {
  return at_temperature(find_root([&](double T) { return pressure_(T) - pressure; }, coldest_.temperature,
                                  hottest_.temperature, "melting temperature at the pressure"));
}

GrayMeltingCurve::Mixture GrayMeltingCurve::mixture(double V, double T) const {
  // F = g - P V, hence S = P' V - g', E = F + T S, C_v = T S'.
  const HermiteTable::Node P = pressure_.at(T), g = gibbs_.at(T);
  const double entropy = V * P.slope - g.slope;
  return {P.value, g.value - V * P.value + T * entropy, entropy, T * (V * P.curvature - g.curvature),
          P.slope};
}

double GrayMeltingCurve::liquid_fraction(double V, double T) const {
  const double Vs = solid_volume_(T), Vl = liquid_volume_(T);
  return std::clamp((V - Vs) / (Vl - Vs), 0.0, 1.0);
}

double GrayMeltingCurve::temperature(double V, double E, const GrayBand& edges) const {
  // The energy is nearly linear in T between the edges, and increases (C_v > 0): Newton's method, kept within them.
  const double T1 = edges.T1, T2 = edges.T2, E1 = edges.E1, E2 = edges.E2;
  double T = std::clamp(T1 + (T2 - T1) * (E - E1) / (E2 - E1), T1, T2);
  for (int i = 0; i < 20; ++i) {
    const Mixture m = mixture(V, T);
    const double next = std::clamp(T - (m.energy - E) / m.heat_capacity, T1, T2);
    const double change = std::abs(next - T);
    T = next;
    if (change < 1e-13 * T) break;
  }
  return T;
}

}  // namespace whipple::eos
