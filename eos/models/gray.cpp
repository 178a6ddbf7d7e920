// SPDX-License-Identifier: BSD-3-Clause
// Evaluation of GRAY. Equation numbers: docs/theory/gray.md.
#include "eos/models/gray.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"

namespace whipple::eos {
namespace {

/// Holds the results for one point or four, as a batch requires them.
template <class Number>
struct Evaluated {
  Number V{}, E{}, T{}, P{};
  Number squared_sound_speed{};
  Number melted_fraction{};
  Number gruneisen{};      ///< V (dP/dE)_V
  Number heat_capacity{};  ///< infinite while melting isochorically
};

}  // namespace

struct Gray::Point : Evaluated<double> {
  Phase phase = Phase::solid;
  bool tangent = false;     ///< melting on the equilibrium curve
  bool cold = false;        ///< T was limited to the lowest temperature
  std::string_view broken;  ///< bound violated by the state; empty: none
};

struct Gray::FourPoints : Evaluated<Lanes> {
  std::array<Phase, 4> phase{};
  std::array<bool, 4> tangent{};
  unsigned cold = 0, broken = 0;  ///< bit i: point i
};

Gray::Gray(const Constants& constants)
    : surface_(constants),
      dome_(surface_.dome_search()),
      least_volume_(surface_.least_volume()),
      least_squared_sound_speed_(std::pow(least_sound_speed_ratio * constants.hugoniot_intercept, 2)) {
  if (constants.melting == MeltingTransition::equilibrium) {
    melting_curve_.emplace(surface_);
    // At the limit of the solid, the liquid in equilibrium with it is the densest on the curve.
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

/// Computes a state on one branch, with T known.
template <class Point, class Number>
void fill_from_branch(Point& p, const BasicGrayBranch<Number>& branch) {
  p.P = branch.pressure(p.T);
  p.squared_sound_speed = branch.squared_sound_speed(p.V, p.T);
  p.heat_capacity = branch.heat_capacity(p.T);
  p.gruneisen = p.V * branch.pressure_by_temperature(p.T) / p.heat_capacity;
}

/// Computes a state in the melting band at the liquid fraction nu: P, and c^2 = V^2 [P (dP/dE)_V - (dP/dV)_E]
/// (G28) from the closed forms of (G31).
template <class Point, class Number>
void fill_from_band(Point& p, const BasicGrayBand<Number>& band, const BasicGrayBandSlopes<Number>& d,
                    Number nu) {
  const Number dE = band.E2 - band.E1, dP = band.P2 - band.P1;
  p.P = band.P1 + nu * dP;
  const Number nu_by_volume = -(d.E1 + nu * (d.E2 - d.E1)) / dE;  // at constant E
  const Number pressure_by_volume = d.P1 + nu * (d.P2 - d.P1) + dP * nu_by_volume;
  p.squared_sound_speed = p.V * p.V * (p.P * dP / dE - pressure_by_volume);
  p.gruneisen = p.V * dP / dE;
  p.heat_capacity = dE / (band.T2 - band.T1);
  p.melted_fraction = nu;
}

}  // namespace

namespace {

/// Computes a state of solid and liquid in equilibrium: (dP/dV)_T = 0, hence c^2 = V^2 T P'^2/C_v.
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
    // Beyond the solid on the last tie line, which is the lower edge; below it melting is isochoric.
    edges.T1 = curve.coldest().temperature;
    edges.E1 = curve.mixture(iso.V, edges.T1).energy;
    if (above(edges)) return edges;
  }
  return {surface_.band(iso), false};
}

Gray::Point Gray::equilibrium_point(double V, double E) const {
  Point p;
  p.V = V;
  p.E = E;
  const GrayIsochore iso = surface_.isochore(V);
  const Edges edges = melting_edges(iso, [&](const Edges& e) { return E > e.E1; });
  GrayBranch branch = iso.solid;
  if (E >= edges.E2) {
    branch = surface_.liquid_branch(iso);
    p.phase = Phase::liquid;
    if (E > branch.energy(constants().hot_liquid_ratio * iso.melting_temperature)) {
      branch = surface_.hot_liquid_branch(iso);
      p.phase = Phase::hot_liquid;
    }
    p.melted_fraction = 1.0;
  } else if (E > edges.E1) {
    p.phase = Phase::melting;
    if (edges.tangent) {
      p.T = melting_curve_->temperature(V, E, edges);
      fill_from_tangent(p, *melting_curve_);
    } else {
      p.phase = Phase::isochoric_melting;
      p.T = edges.T1;
      fill_from_band(p, edges, surface_.band_slopes(iso, edges), (E - edges.E1) / (edges.E2 - edges.E1));
    }
    return p;
  }
  p.T = branch.temperature(E);
  fill_from_branch(p, branch);
  return p;
}

/// Evaluates four states at once, computing every branch needed by one of them for all. A single point uses the
/// same code, so that it agrees bitwise with a batch. Points out of range are computed at the reference state.
Gray::FourPoints Gray::four_points(Lanes V, Lanes E) const {
  const GrayConstants& c = constants();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  FourPoints p;
  const LanesMask valid = (V >= least_volume_) & (V < infinity) & (E < infinity) & (E > -infinity);
  p.broken = ~bits(valid) & all_lanes;
  V = select(valid, V, broadcast(c.reference_specific_volume));
  E = select(valid, E, broadcast(c.reference_energy));
  p.V = V;
  p.E = E;
  const double join_volume = surface_.join_volume();
  const LanesMask thin = V > join_volume;
  const LanesMask none = V < 0.0;
  LanesMask warm = none, liquid = none, hot = none, melting = none, hot_vapour = none;
  BasicGrayBranch<Lanes> branch;
  BasicGrayIsochore<Lanes> iso;
  BasicGrayBand<Lanes> band;
  if (bits(thin) != all_lanes) {
    iso = surface_.isochore(select(thin, broadcast(join_volume), V));
    branch = iso.solid;
    // No band begins below half the melting temperature (G32): most solid points require only this branch.
    warm = (E > branch.energy(0.5 * iso.melting_temperature)) & ~thin;
    if (any(warm) && !melting_curve_) {
      band = surface_.band(iso);
      liquid = warm & (E >= band.E2);
      melting = warm & (E > band.E1) & ~liquid;
      if (any(liquid)) {
        const BasicGrayBranch<Lanes> cool = surface_.liquid_branch(iso);
        branch = select_branch(liquid, cool, branch);
        hot = liquid & (E > cool.energy(c.hot_liquid_ratio * iso.melting_temperature));
        if (any(hot)) branch = select_branch(hot, surface_.hot_liquid_branch(iso), branch);
      }
    }
  }
  if (any(thin)) {
    const Lanes expanded = select(thin, V, broadcast(2 * join_volume));
    BasicGrayBranch<Lanes> vapour = surface_.vapour_branch(expanded, false);
    hot_vapour = thin & (E > vapour.energy(broadcast(surface_.vapour_branch_temperature())));
    if (any(hot_vapour)) vapour = select_branch(hot_vapour, surface_.vapour_branch(expanded, true), vapour);
    branch = select_branch(thin, vapour, branch);
  }
  const LanesMask cold = E < branch.energy(broadcast(least_temperature));
  p.T = select(cold, broadcast(least_temperature), branch.temperature(E));
  p.cold = bits(cold & valid);
  // NaN occurs above the energy at which the heat capacity vanishes.
  p.broken |= ~bits(p.T == p.T) & all_lanes;
  fill_from_branch(p, branch);
  p.melted_fraction = select(liquid, broadcast(1.0), broadcast(0.0));
  if (any(melting)) {
    Evaluated<Lanes> mixed;
    const Lanes nu = (E - band.E1) / (band.E2 - band.E1);
    mixed.V = V;
    mixed.T = band.T1 + nu * (band.T2 - band.T1);
    fill_from_band(mixed, band, surface_.band_slopes(iso, band), nu);
    p.T = select(melting, mixed.T, p.T);
    p.P = select(melting, mixed.P, p.P);
    p.squared_sound_speed = select(melting, mixed.squared_sound_speed, p.squared_sound_speed);
    p.melted_fraction = select(melting, mixed.melted_fraction, p.melted_fraction);
    p.gruneisen = select(melting, mixed.gruneisen, p.gruneisen);
    p.heat_capacity = select(melting, mixed.heat_capacity, p.heat_capacity);
  }
  // Remaining single-point evaluations: molten fraction of the vapour, equilibrium melting.
  const unsigned thin_bits = bits(thin), melting_bits = bits(melting), liquid_bits = bits(liquid);
  const unsigned hot_bits = bits(hot | hot_vapour), warm_bits = melting_curve_ ? bits(warm) : 0;
  if ((thin_bits | melting_bits | liquid_bits | warm_bits) == 0) return p;  // all solid
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned bit = 1u << i;
    if (thin_bits & bit) {
      p.phase[i] = hot_bits & bit ? Phase::hot_vapour : Phase::vapour;
      p.melted_fraction[i] = fluid_melted_fraction(p.T[i]);
    } else if (warm_bits & bit) {
      const Point single = equilibrium_point(V[i], E[i]);
      p.phase[i] = single.phase;
      p.tangent[i] = single.tangent;
      p.T[i] = single.T;
      p.P[i] = single.P;
      p.squared_sound_speed[i] = single.squared_sound_speed;
      p.melted_fraction[i] = single.melted_fraction;
      p.gruneisen[i] = single.gruneisen;
      p.heat_capacity[i] = single.heat_capacity;
    } else if (melting_bits & bit) {
      p.phase[i] = Phase::melting;
    } else if (liquid_bits & bit) {
      p.phase[i] = hot_bits & bit ? Phase::hot_liquid : Phase::liquid;
    }
  }
  return p;
}

namespace {

/// Returns the bound violated by a state that four_points() did not compute.
std::string_view broken_bound(double V, double E, double least_volume) {
  if (!(V > 0) || !std::isfinite(V)) return "density must be positive and finite";
  if (!std::isfinite(E)) return "specific internal energy must be finite";
  if (V < least_volume) return "density above the compression limit of the cold curve";
  return "energy above that at which the heat capacity vanishes";
}

}  // namespace

Gray::Point Gray::point(double V, double E) const {
  const FourPoints four = four_points(broadcast(V), broadcast(E));
  Point p;
  p.V = V;
  p.E = E;
  if (four.broken & 1u) {
    p.broken = broken_bound(V, E, least_volume_);
    return p;
  }
  p.T = four.T[0];
  p.P = four.P[0];
  p.squared_sound_speed = four.squared_sound_speed[0];
  p.melted_fraction = four.melted_fraction[0];
  p.gruneisen = four.gruneisen[0];
  p.heat_capacity = four.heat_capacity[0];
  p.phase = four.phase[0];
  p.tangent = four.tangent[0];
  p.cold = four.cold & 1u;
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
    const bool hot = T > surface_.vapour_branch_temperature();
    p.phase = hot ? Phase::hot_vapour : Phase::vapour;
    branch = surface_.vapour_branch(V, hot);
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
  const std::size_t size = batch.density.size();
  for (std::size_t first = 0; first < size; first += 4) {
    const std::size_t count = std::min<std::size_t>(4, size - first);
    const Lanes rho = load(&batch.density[first], count, reference_density()),
                E = load(&batch.specific_internal_energy[first], count, reference_energy());
    const FourPoints p = four_points(1.0 / rho, E);
    const Lanes c = whipple::sqrt(maximum(p.squared_sound_speed, broadcast(least_squared_sound_speed_)));
    report.below_cold_curve += static_cast<std::size_t>(std::popcount(p.cold & ((1u << count) - 1u)));
    Lanes vapour{};
    if (melted || vaporised) {
      for (std::size_t i = 0; i < count; ++i) {
        if (!(p.V[i] > coldest_dome_volume) || p.phase[i] == Phase::solid) continue;
        vapour[i] = dome_.vaporised_fraction(p.V[i], p.E[i]);
      }
    }
    store(&batch.pressure[first], p.P, count);
    store(&batch.temperature[first], p.T, count);
    store(&batch.sound_speed[first], c, count);
    if (melted) store(&batch.melted_fraction[first], maximum(p.melted_fraction, vapour), count);
    if (vaporised) store(&batch.vaporised_fraction[first], vapour, count);
    for (unsigned broken = p.broken & ((1u << count) - 1u); broken != 0; broken &= broken - 1u) {
      const auto i = static_cast<std::size_t>(std::countr_zero(broken)), at = first + i;
      if (report.out_of_range++ == 0) {
        report.first = at;
        report.bound = broken_bound(1.0 / rho[i], E[i], least_volume_);
      }
      batch.pressure[at] = batch.temperature[at] = batch.sound_speed[at] = State::unknown;
      if (melted) batch.melted_fraction[at] = State::unknown;
      if (vaporised) batch.vaporised_fraction[at] = State::unknown;
    }
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
  if (p.V > surface_.join_volume()) {
    s.isothermal_bulk_modulus =
        -p.V *
        surface_.vapour_branch(p.V, p.T > surface_.vapour_branch_temperature()).pressure_by_volume(p.T);
    s.specific_entropy = surface_.vapour_entropy(p.V, p.T);
  } else {
    const GrayIsochore iso = surface_.isochore(p.V);
    const double tau = p.T / iso.melting_temperature;
    switch (p.phase) {
      case Phase::melting:
      case Phase::isochoric_melting: {
        if (p.tangent) {
          s.specific_entropy = melting_curve_->mixture(p.V, p.T).entropy;
          s.isothermal_bulk_modulus = 0.0;
          break;
        }
        // Mean of 1/T between the edges on the isochore, scaled so that S is continuous with both phases (G33).
        const GrayBand band = surface_.band(iso);
        const double S1 = surface_.solid_entropy(iso, band.T1);
        const double S2 = surface_.solid_entropy(iso, band.T2) +
                          surface_.liquid_entropy_excess(band.T2 / iso.melting_temperature);
        const double share =
            band.T2 > band.T1 ? std::log(p.T / band.T1) / std::log(band.T2 / band.T1) : p.melted_fraction;
        s.specific_entropy = S1 + share * (S2 - S1);
        // K_T = rho c^2 - Gamma^2 C_v T rho; undefined where T is a function of V alone.
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
  static constexpr std::string_view names[] = {"solid",      "melting", "isochoric melting", "liquid",
                                               "hot liquid", "vapour",  "hot vapour"};
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
