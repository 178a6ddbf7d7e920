// SPDX-License-Identifier: BSD-3-Clause
// Evaluation of GRAY. Equation numbers: docs/theory/gray.md.
#include "eos/models/gray.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "src/base/error.hpp"
#include "src/base/log.hpp"

namespace whipple::eos {
/// One point: what a batch needs, and where it was found.
struct Gray::Point {
  double V = 0, E = 0, T = 0, P = 0;
  double squared_sound_speed = 0;
  double melted_fraction = 0;
  double gruneisen = 0;      ///< V (dP/dE)_V
  double heat_capacity = 0;  ///< infinite while melting isochorically
  Phase phase = Phase::solid;
  bool tangent = false;     ///< melting on the equilibrium curve
  bool cold = false;        ///< T was held at the least temperature
  std::string_view broken;  ///< bound that the state broke; empty: none
};

Gray::Gray(const Constants& constants)
    : surface_(constants),
      dome_(surface_.dome_search()),
      least_volume_(surface_.least_volume()),
      least_squared_sound_speed_(std::pow(least_sound_speed_ratio * constants.hugoniot_intercept, 2)) {
  if (constants.melting == "equilibrium") {
    melting_curve_.emplace(surface_);
    // At the limit of the solid the liquid in equilibrium with it is the densest one that the curve knows.
    least_volume_ = melting_curve_->hottest().liquid_volume;
  }
  const double T = surface_.vapour_branch_temperature();
  const GrayBranch thin = surface_.vapour_branch(1e6 * surface_.join_volume(), false);
  if (thin.heat_capacity(T) <= 0) {
    log::warning(
        "gray: the heat capacity of the thin vapour vanishes at {:.0f} K, below T_G(V_J) = {:.0f} K; its "
        "temperature jumps there. More electronic_heat_coefficient or a smaller join_volume_ratio avoids it",
        -thin.e1 / (2 * thin.e2), T);
  }
}

double Gray::sound_speed(double squared) const {
  return std::sqrt(std::max(squared, least_squared_sound_speed_));
}

double Gray::fluid_melted_fraction(double T) const {
  const GrayBand& band = surface_.join_band();
  if (T >= band.T2) return 1.0;
  return T <= band.T1 ? 0.0 : (T - band.T1) / (band.T2 - band.T1);
}

namespace {

/// State on one branch, with T known.
template <class Point>
void fill_from_branch(Point& p, const GrayBranch& branch) {
  p.P = branch.pressure(p.T);
  p.squared_sound_speed = branch.squared_sound_speed(p.V, p.T);
  p.heat_capacity = branch.heat_capacity(p.T);
  p.gruneisen = p.V * branch.pressure_by_temperature(p.T) / p.heat_capacity;
}

/// State in the melting band at the liquid fraction nu: P, and c^2 = V^2 [P (dP/dE)_V - (dP/dV)_E]  (G28)
/// from the closed forms of (G31).
template <class Point>
void fill_from_band(Point& p, const GrayBand& band, const GrayBandSlopes& d, double nu) {
  const double dE = band.E2 - band.E1, dP = band.P2 - band.P1;
  p.P = band.P1 + nu * dP;
  const double nu_by_volume = -(d.E1 + nu * (d.E2 - d.E1)) / dE;  // at constant E
  const double pressure_by_volume = d.P1 + nu * (d.P2 - d.P1) + dP * nu_by_volume;
  p.squared_sound_speed = p.V * p.V * (p.P * dP / dE - pressure_by_volume);
  p.gruneisen = p.V * dP / dE;
  p.heat_capacity = dE / (band.T2 - band.T1);
  p.melted_fraction = nu;
}

}  // namespace

namespace {

/// State of solid and liquid in equilibrium: (dP/dV)_T = 0, hence c^2 = V^2 T P'^2/C_v.
template <class Point>
void fill_from_tangent(Point& p, const GrayMeltingCurve& curve) {
  const GrayMeltingCurve::Mixture m = curve.mixture(p.V, p.T);
  p.P = m.pressure;
  p.squared_sound_speed =
      p.V * p.V * p.T * m.pressure_by_temperature * m.pressure_by_temperature / m.heat_capacity;
  p.heat_capacity = m.heat_capacity;
  p.gruneisen = p.V * m.pressure_by_temperature / m.heat_capacity;
  p.melted_fraction = curve.liquid_fraction(p.V, p.T);
  p.tangent = true;
}

}  // namespace

template <class Above>
Gray::Edges Gray::melting_edges(const GrayIsochore& iso, const Above& above) const {
  if (melting_curve_) {
    const GrayMeltingCurve& curve = *melting_curve_;
    Edges edges;
    edges.tangent = true;
    edges.T2 = curve.liquidus(iso.V);
    edges.E2 = surface_.liquid_branch(iso).energy(edges.T2);
    if (iso.V <= curve.coldest().solid_volume) {
      edges.T1 = curve.solidus(iso.V);
      edges.E1 = iso.solid.energy(edges.T1);
      return edges;
    }
    // Beyond the solid of the last tie line: that is the lower edge, below it melting is isochoric.
    edges.T1 = curve.coldest().temperature;
    edges.E1 = curve.mixture(iso.V, edges.T1).energy;
    if (above(edges)) return edges;
  }
  return {surface_.band(iso), false};
}

Gray::Point Gray::point(double V, double E) const {
  Point p;
  p.V = V;
  p.E = E;
  if (!(V > 0) || !std::isfinite(V)) {
    p.broken = "density must be positive and finite";
    return p;
  }
  if (!std::isfinite(E)) {
    p.broken = "specific internal energy must be finite";
    return p;
  }
  if (V < least_volume_) {
    p.broken = "density above the compression limit of the cold curve";
    return p;
  }
  GrayBranch branch;
  if (V > surface_.join_volume()) {
    p.phase = Phase::vapour;
    const double T = surface_.vapour_branch_temperature();
    branch = surface_.vapour_branch(V, false);
    if (E > branch.energy(T)) branch = surface_.vapour_branch(V, true);
  } else {
    const GrayIsochore iso = surface_.isochore(V);
    branch = iso.solid;
    // The band never begins below half the melting temperature (G32): most solid points need no more than
    // this.
    if (E > branch.energy(0.5 * iso.melting_temperature)) {
      const Edges band = melting_edges(iso, [&](const Edges& edges) { return E > edges.E1; });
      if (E >= band.E2) {
        branch = surface_.liquid_branch(iso);
        p.phase = Phase::liquid;
        if (E > branch.energy(constants().hot_liquid_ratio * iso.melting_temperature)) {
          branch = surface_.hot_liquid_branch(iso);
          p.phase = Phase::hot_liquid;
        }
        p.melted_fraction = 1.0;
      } else if (E > band.E1) {
        p.phase = Phase::melting;
        if (band.tangent) {
          p.T = melting_curve_->temperature(V, E, band.T1, band.T2);
          fill_from_tangent(p, *melting_curve_);
          return p;
        }
        const double nu = (E - band.E1) / (band.E2 - band.E1);
        p.T = band.T1 + nu * (band.T2 - band.T1);
        fill_from_band(p, band, surface_.band_slopes(iso, band), nu);
        return p;
      }
    }
  }
  if (E < branch.energy(least_temperature)) {
    p.T = least_temperature;
    p.cold = true;
  } else {
    p.T = branch.temperature(E);
    if (!std::isfinite(p.T)) {
      p.broken = "energy above that at which the heat capacity vanishes";
      return p;
    }
  }
  fill_from_branch(p, branch);
  if (p.phase == Phase::vapour) p.melted_fraction = fluid_melted_fraction(p.T);
  return p;
}

Gray::Point Gray::point_at_temperature(double V, double T) const {
  Point p;
  p.V = V;
  p.T = T;
  if (!(V > 0) || !std::isfinite(V) || V < least_volume_) {
    p.broken = "density must be positive and below the compression limit of the cold curve";
    return p;
  }
  if (!(T >= least_temperature) || !std::isfinite(T)) {
    p.broken = "temperature must be finite and not below 1 K";
    return p;
  }
  GrayBranch branch;
  if (V > surface_.join_volume()) {
    p.phase = Phase::vapour;
    branch = surface_.vapour_branch(V, T > surface_.vapour_branch_temperature());
    p.melted_fraction = fluid_melted_fraction(T);
  } else {
    const GrayIsochore iso = surface_.isochore(V);
    const Edges band = melting_edges(iso, [&](const Edges& edges) { return T > edges.T1; });
    branch = iso.solid;
    if (T > band.T1 && T < band.T2) {
      p.phase = Phase::melting;
      if (band.tangent) {
        p.E = melting_curve_->mixture(V, T).energy;
        fill_from_tangent(p, *melting_curve_);
        return p;
      }
      const double nu = (T - band.T1) / (band.T2 - band.T1);
      p.E = band.E1 + nu * (band.E2 - band.E1);
      fill_from_band(p, band, surface_.band_slopes(iso, band), nu);
      return p;
    }
    if (T > band.T1) {
      const bool hot = T > constants().hot_liquid_ratio * iso.melting_temperature;
      branch = hot ? surface_.hot_liquid_branch(iso) : surface_.liquid_branch(iso);
      p.phase = hot ? Phase::hot_liquid : Phase::liquid;
      p.melted_fraction = 1.0;
    }
  }
  p.E = branch.energy(T);
  fill_from_branch(p, branch);
  return p;
}

RangeReport Gray::evaluate(const Batch& batch) const {
  RangeReport report;
  const bool melted = !batch.melted_fraction.empty(), vaporised = !batch.vaporised_fraction.empty();
  const double coldest_dome_volume = dome_.rows().front().liquid_volume;
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const Point p = point(1.0 / batch.density[i], batch.specific_internal_energy[i]);
    if (!p.broken.empty()) {
      if (report.out_of_range++ == 0) {
        report.first = i;
        report.bound = p.broken;
      }
      batch.pressure[i] = batch.temperature[i] = batch.sound_speed[i] = State::unknown;
      if (melted) batch.melted_fraction[i] = State::unknown;
      if (vaporised) batch.vaporised_fraction[i] = State::unknown;
      continue;
    }
    report.below_cold_curve += p.cold ? 1 : 0;
    batch.pressure[i] = p.P;
    batch.temperature[i] = p.T;
    batch.sound_speed[i] = sound_speed(p.squared_sound_speed);
    double vapour = 0;
    if ((melted || vaporised) && p.V > coldest_dome_volume && p.phase != Phase::solid) {
      vapour = dome_.vaporised_fraction(p.V, p.E);
    }
    if (melted) batch.melted_fraction[i] = std::max(p.melted_fraction, vapour);
    if (vaporised) batch.vaporised_fraction[i] = vapour;
  }
  return report;
}

State Gray::full_state(const Point& p) const {
  if (!p.broken.empty()) {
    throw StateError(
        fmt::format("gray: {} (density {:.6g} kg/m^3, compression limit {:.6g} kg/m^3, specific internal "
                    "energy {:.6g} J/kg, temperature {:.6g} K)",
                    p.broken, 1 / p.V, maximum_density(), p.E, p.T));
  }
  State s;
  s.density = 1 / p.V;
  s.specific_internal_energy = p.E;
  s.temperature = p.T;
  s.pressure = p.P;
  s.sound_speed = sound_speed(p.squared_sound_speed);
  s.heat_capacity = p.heat_capacity;
  s.gruneisen = p.gruneisen;
  if (p.phase == Phase::vapour) {
    s.isothermal_bulk_modulus =
        -p.V *
        surface_.vapour_branch(p.V, p.T > surface_.vapour_branch_temperature()).pressure_by_volume(p.T);
    s.specific_entropy = surface_.vapour_entropy(p.V, p.T);
  } else {
    const GrayIsochore iso = surface_.isochore(p.V);
    const double tau = p.T / iso.melting_temperature;
    switch (p.phase) {
      case Phase::melting: {
        if (p.tangent) {
          s.specific_entropy = melting_curve_->mixture(p.V, p.T).entropy;
          s.isothermal_bulk_modulus = 0.0;
          break;
        }
        // The isochore's mean of 1/T between the edges, scaled so that S meets both phases (G33).
        const GrayBand band = surface_.band(iso);
        const double S1 = surface_.solid_entropy(iso, band.T1);
        const double S2 = surface_.solid_entropy(iso, band.T2) +
                          surface_.liquid_entropy_excess(band.T2 / iso.melting_temperature);
        const double share =
            band.T2 > band.T1 ? std::log(p.T / band.T1) / std::log(band.T2 / band.T1) : p.melted_fraction;
        s.specific_entropy = S1 + share * (S2 - S1);
        // K_T = rho c^2 - Gamma^2 C_v T rho; not defined where T is a function of V alone.
        if (band.T2 > band.T1) {
          s.isothermal_bulk_modulus =
              (p.squared_sound_speed - p.gruneisen * p.gruneisen * p.heat_capacity * p.T) / p.V;
        }
        break;
      }
      case Phase::solid:
        s.specific_entropy = surface_.solid_entropy(iso, p.T);
        s.isothermal_bulk_modulus = -p.V * iso.solid.pressure_by_volume(p.T);
        break;
      default: {
        const GrayBranch branch =
            p.phase == Phase::hot_liquid ? surface_.hot_liquid_branch(iso) : surface_.liquid_branch(iso);
        s.specific_entropy = surface_.solid_entropy(iso, p.T) + surface_.liquid_entropy_excess(tau);
        s.isothermal_bulk_modulus = -p.V * branch.pressure_by_volume(p.T);
      }
    }
  }
  static constexpr std::string_view names[] = {"solid", "melting", "liquid", "hot liquid", "vapour"};
  s.phase = names[static_cast<int>(p.phase)];
  s.vaporised_fraction = p.phase == Phase::solid ? 0.0 : dome_.vaporised_fraction(p.V, p.E);
  s.melted_fraction = std::max(p.melted_fraction, s.vaporised_fraction);
  return s;
}

State Gray::state(double density, double specific_internal_energy) const {
  return full_state(point(1.0 / density, specific_internal_energy));
}

State Gray::state_at_temperature(double density, double temperature) const {
  return full_state(point_at_temperature(1.0 / density, temperature));
}

}  // namespace whipple::eos
