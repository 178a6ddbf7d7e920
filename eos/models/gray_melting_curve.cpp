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

using Node = CommonTangent;

/// Solves P_s = P_l and G_s = G_l from a close guess.
std::optional<Node> tangent(const SolidLiquidSurfaces& f, double T, double Vs, double Vl) {
  return common_tangent(f.solid, f.liquid, T, Vs, Vl, {0.5 * f.least_volume, 2 * f.join_volume});
}

/// Follows the curve from a node to a nearby temperature.
std::optional<Node> follow(const SolidLiquidSurfaces& f, const Node& from, double T) {
  return tangent(f, T, from.dense + from.dense1 * (T - from.T), from.thin + from.thin1 * (T - from.T));
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
  for (const double width : {0.02, 0.04, 0.08, 0.01, 0.005, 0.03, 0.06, 0.1, 0.14}) {
    if ((start = tangent(f, T0, V0 * (1 - width), V0 * (1 + width)))) break;
  }
  if (!start) {
    throw InputError(fmt::format(
        "gray: melting = \"equilibrium\" finds no common tangent of solid and liquid at melting_temperature "
        "({} K); check melting_entropy, melting_gruneisen and gruneisen",
        T0));
  }
  const Node first = march(f, *start, 0.98, [&](const Node& n) { return n.thin > f.join_volume; });
  Node last = march(f, *start, 1.02, [&](const Node& n) {
    const double step = (n.T - first.T) / intervals;
    return n.dense < f.least_volume || !(std::abs(n.P2) * step < most_bending * std::abs(n.P1));
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
    if (n.dense1 < 0 && n.thin1 < 0) continue;
    throw InputError(
        fmt::format("melting curve: the volume of a phase grows along it at {:.6g} K, {:.6g} Pa", n.T, n.P));
  }
  const double step = (last.T - first.T) / intervals;
  std::vector<HermiteTable::Node> pressure, gibbs, solid, liquid;
  for (const Node& n : curve) {
    pressure.push_back({n.P, n.P1, n.P2});
    gibbs.push_back({n.g, n.g1, n.g2});
    solid.push_back({n.dense, n.dense1, 0});
    liquid.push_back({n.thin, n.thin1, 0});
  }
  add_curvatures(solid, step);
  add_curvatures(liquid, step);
  pressure_ = HermiteTable(first.T, step, std::move(pressure));
  gibbs_ = HermiteTable(first.T, step, std::move(gibbs));
  solid_volume_ = HermiteTable(first.T, step, std::move(solid));
  liquid_volume_ = HermiteTable(first.T, step, std::move(liquid));
  coldest_ = {first.T, first.P, first.dense, first.thin};
  hottest_ = {last.T, last.P, last.dense, last.thin};
  solidus_ = inverse(solid_volume_, first.T, last.T, last.thin, first.dense);
  liquidus_ = inverse(liquid_volume_, first.T, last.T, last.thin, first.thin);
}

GrayMeltingCurve::Tangent GrayMeltingCurve::at_temperature(double T) const {
  return {T, pressure_(T), solid_volume_(T), liquid_volume_(T)};
}

GrayMeltingCurve::Tangent GrayMeltingCurve::at_pressure(double pressure) const {
  return at_temperature(find_root([&](double T) { return pressure_(T) - pressure; }, coldest_.temperature,
                                  hottest_.temperature, "melting temperature at the pressure"));
}

PhaseMixture GrayMeltingCurve::mixture(double V, double T) const {
  const HermiteTable::Node P = pressure_.at(T), g = gibbs_.at(T);
  return phase_mixture(P, g, V, T);
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
    const PhaseMixture m = mixture(V, T);
    const double next = std::clamp(T - (m.energy - E) / m.heat_capacity, T1, T2);
    const double change = std::abs(next - T);
    T = next;
    if (change < 1e-13 * T) break;
  }
  return T;
}

}  // namespace whipple::eos
