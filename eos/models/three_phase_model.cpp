// SPDX-License-Identifier: BSD-3-Clause
// Evaluation of free energies with the phases of GRAY. Equation numbers: docs/theory/gray.md.
#include "eos/models/three_phase_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

/// Holds the outcome of a search for the temperature of an energy.
struct Found {
  double temperature = 0;
  GrayPoint state;
};

/// Finds the temperature at which a phase has the energy E, by Newton's method within a shrinking bracket; nothing
/// if its energy does not rise to E.
template <class Surface>
std::optional<Found> temperature_of(const Surface& surface, double E, double low, double high, double guess) {
  double T = std::clamp(guess, low, high);
  for (int i = 0; i < 200; ++i) {
    const GrayPoint p = surface(T);
    if (!(p.heat_capacity > 0)) return std::nullopt;
    (p.energy > E ? high : low) = T;
    double next = T - (p.energy - E) / p.heat_capacity;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double change = std::abs(next - T);
    if (change <= 4 * std::numeric_limits<double>::epsilon() * T) return Found{T, p};
    T = next;
  }
  return Found{T, surface(T)};
}

/// Returns the search of the dome of GRAY on the fluid of other surfaces, to which the result refers.
template <class Surfaces>
VapourDome::Search dome_search(const Surfaces& surfaces) {
  VapourDome::Search search = surfaces.gray().dome_search();
  search.fluid = [&surfaces](double V, double T) {
    const GrayPoint p = surfaces.fluid(V, T);
    return FluidPoint{p.pressure, p.energy, p.entropy};
  };
  search.isotherm = [&surfaces](double V, double T) {
    const GrayPoint p = surfaces.fluid(V, T);
    return IsothermPoint{p.pressure, p.pressure_by_volume};
  };
  return search;
}

}  // namespace

template <class Surfaces>
struct ThreePhaseModel<Surfaces>::Point {
  double V = 0, E = 0, T = 0, P = 0, S = 0;
  double squared_sound_speed = 0, heat_capacity = 0, gruneisen = 0, bulk_modulus = State::unknown;
  double melted_fraction = 0;
  Phase phase = Phase::solid;
  bool cold = false;        ///< T was limited to the lowest temperature
  std::string_view broken;  ///< bound violated by the state; empty: none
};

/// Specifies how an isochore V <= V_J melts.
enum class Melting : std::uint8_t {
  equilibrium,  ///< along the melting curve
  tie,          ///< beyond the last tie line in tension: isochorically below it, in equilibrium above
  isochoric,    ///< beyond the curve in compression
};

/// Holds the edges of melting on an isochore.
template <class Surfaces>
struct ThreePhaseModel<Surfaces>::Edges {
  Melting melting = Melting::equilibrium;
  double solidus = 0, liquidus = 0;  ///< K, of the phases in equilibrium; equal if melting is isochoric
  double isochoric = 0;              ///< K, of equal free energies, unless in equilibrium
  [[nodiscard]] bool tie() const { return melting == Melting::tie; }
};

template <class Surfaces>
ThreePhaseModel<Surfaces>::ThreePhaseModel(const Constants& constants)
    : constants_(constants),
      surfaces_(constants),
      melting_curve_(surfaces_.melting_surfaces()),
      dome_(dome_search(surfaces_)),
      least_volume_(surfaces_.least_volume(melting_curve_)),
      least_squared_sound_speed_(std::pow(least_sound_speed_ratio * constants.gray.hugoniot_intercept, 2)),
      join_melting_temperature_(surfaces_.isochoric_melting_temperature(surfaces_.gray().join_volume())) {
  constants_.gray = surfaces_.gray().constants();
  reference_energy_ =
      surfaces_.solid(constants_.gray.reference_specific_volume, reference_temperature()).energy;
}

template <class Surfaces>
std::vector<double> ThreePhaseModel<Surfaces>::kinks() const {
  std::vector<double> all = surfaces_.kinks();
  all.push_back(1.0 / melting_curve_.coldest().solid_volume);
  if (least_volume_ < melting_curve_.hottest().liquid_volume)
    all.push_back(1.0 / melting_curve_.hottest().liquid_volume);
  return all;
}

template <class Surfaces>
double ThreePhaseModel<Surfaces>::sound_speed(double squared) const {
  return std::sqrt(std::max(squared, least_squared_sound_speed_));
}

template <class Surfaces>
auto ThreePhaseModel<Surfaces>::melting_edges(double V) const -> Edges {
  Edges e;
  if (V < melting_curve_.hottest().liquid_volume) {
    e.melting = Melting::isochoric;
    e.solidus = e.liquidus = e.isochoric = surfaces_.isochoric_melting_temperature(V);
    return e;
  }
  e.liquidus = melting_curve_.liquidus(V);
  if (V > melting_curve_.coldest().solid_volume) {
    e.melting = Melting::tie;
    e.solidus = melting_curve_.coldest().temperature;
    e.isochoric = surfaces_.isochoric_melting_temperature(V);
  } else {
    e.solidus = melting_curve_.solidus(V);
  }
  return e;
}

template <class Surfaces>
void ThreePhaseModel<Surfaces>::fill(Point& p, const GrayPoint& s, Phase phase) const {
  p.phase = phase;
  p.P = s.pressure;
  p.S = s.entropy;
  p.heat_capacity = s.heat_capacity;
  p.gruneisen = p.V * s.pressure_by_temperature / s.heat_capacity;
  p.bulk_modulus = -p.V * s.pressure_by_volume;
  p.squared_sound_speed =
      p.V * p.V *
      (p.T * s.pressure_by_temperature * s.pressure_by_temperature / s.heat_capacity - s.pressure_by_volume);
}

template <class Surfaces>
void ThreePhaseModel<Surfaces>::fill_fluid(Point& p, const GrayPoint& s) const {
  const GrayFreeEnergy& gray = surfaces_.gray();
  if (p.V > gray.join_volume()) {
    fill(p, s, p.T > gray.vapour_branch_temperature() ? Phase::hot_vapour : Phase::vapour);
    p.melted_fraction = p.T > join_melting_temperature_ ? 1.0 : 0.0;
  } else {
    const double hot = gray.constants().hot_liquid_ratio * gray.melting_temperature(p.V);
    fill(p, s, p.T > hot ? Phase::hot_liquid : Phase::liquid);
    p.melted_fraction = 1.0;
  }
}

/// Computes a state of solid and liquid in equilibrium: (dP/dV)_T = 0, hence c^2 = V^2 T P'^2/C_v  (G35).
template <class Surfaces>
void ThreePhaseModel<Surfaces>::fill_mixture(Point& p) const {
  const PhaseMixture m = melting_curve_.mixture(p.V, p.T);
  fill(p, {m.pressure, m.energy, m.entropy, m.heat_capacity, m.pressure_by_temperature, 0.0}, Phase::melting);
  p.melted_fraction = melting_curve_.liquid_fraction(p.V, p.T);
}

/// Computes a state between solid and liquid of one volume at the temperature of equal free energies (G26): with
/// n = dT/dV and dE = E_l - E_s, dP = P_l - P_s of (G34) for equal volumes, P = P_s + nu dP and
/// Gamma = V dP/dE, c^2 = V^2 [P Gamma/V - (dP/dV)_E].
template <class Surfaces>
void ThreePhaseModel<Surfaces>::fill_isochoric(Point& p, double T) const {
  const double V = p.V;
  const auto along = [&](double volume) {  // both phases at the temperature of that volume
    const double at = surfaces_.isochoric_melting_temperature(volume);
    return std::pair(surfaces_.solid(volume, at), surfaces_.fluid(volume, at));
  };
  const auto [s, l] = along(V);
  const double dE = l.energy - s.energy, dP = l.pressure - s.pressure;
  const double nu = (p.E - s.energy) / dE;
  p.T = T;
  p.P = s.pressure + nu * dP;
  p.S = s.entropy + nu * (l.entropy - s.entropy);
  p.melted_fraction = nu;
  p.phase = Phase::isochoric_melting;
  p.heat_capacity = std::numeric_limits<double>::infinity();
  p.gruneisen = V * dP / dE;
  // dP/dV at constant E, by central differences of P(V, E) = P_s + (E - E_s) dP/dE along the transition.
  const double h = 1e-5 * V;
  const auto pressure = [&](double volume) {
    const auto [a, b] = along(volume);
    return a.pressure + (p.E - a.energy) * (b.pressure - a.pressure) / (b.energy - a.energy);
  };
  const double upper = std::min(V + h, surfaces_.gray().join_volume());
  const double by_volume = (pressure(upper) - pressure(V - h)) / (upper - (V - h));
  p.squared_sound_speed = V * V * (p.P * dP / dE - by_volume);
}

template <class Surfaces>
auto ThreePhaseModel<Surfaces>::at_energy(double V, double E) const -> Point {
  Point p;
  p.V = V;
  p.E = E;
  if (!(V > 0) || !std::isfinite(V)) {
    p.broken = "density must be positive and finite";
  } else if (!std::isfinite(E)) {
    p.broken = "specific internal energy must be finite";
  } else if (V < least_volume_) {
    p.broken = "density above the compression limit of the cold curve";
  }
  if (!p.broken.empty()) return p;
  const auto solid = [&](double T) { return surfaces_.solid(V, T); };
  const auto fluid = [&](double T) { return surfaces_.fluid(V, T); };
  const auto search = [&](const auto& surface, double low, double high, double guess) {
    const std::optional<Found> found = temperature_of(surface, E, low, high, guess);
    if (!found) {
      p.broken = "energy above that of the highest temperature, or at which the heat capacity vanishes";
    } else {
      p.T = found->temperature;
    }
    return found;
  };
  const bool thin = V > surfaces_.gray().join_volume();
  const GrayPoint coldest = thin ? fluid(least_temperature) : solid(least_temperature);
  if (E < coldest.energy) {
    p.cold = true;
    p.T = least_temperature;
    thin ? fill_fluid(p, coldest) : fill_solid(p, coldest);
    return p;
  }
  if (thin) {
    if (const auto found =
            search(fluid, least_temperature, surfaces_.greatest_temperature(), join_melting_temperature_))
      fill_fluid(p, found->state);
    return p;
  }
  const Edges edges = melting_edges(V);
  const GrayPoint liquidus = fluid(edges.liquidus);
  if (E >= liquidus.energy) {
    const double guess = edges.liquidus + (E - liquidus.energy) / liquidus.heat_capacity;
    if (const auto found = search(fluid, edges.liquidus, surfaces_.greatest_temperature(), guess))
      fill_fluid(p, found->state);
    return p;
  }
  const double lower_energy =
      edges.tie() ? melting_curve_.mixture(V, edges.solidus).energy : solid(edges.solidus).energy;
  if (edges.melting != Melting::isochoric && E > lower_energy) {
    p.T = melting_curve_.temperature(V, E,
                                     {.T1 = edges.solidus,
                                      .T2 = edges.liquidus,
                                      .E1 = lower_energy,
                                      .E2 = liquidus.energy,
                                      .P1 = 0,
                                      .P2 = 0});
    fill_mixture(p);
    return p;
  }
  if (edges.melting != Melting::equilibrium && E > solid(edges.isochoric).energy) {
    const GrayPoint melted = fluid(edges.isochoric);
    if (E < melted.energy) {
      fill_isochoric(p, edges.isochoric);
    } else if (const auto found =
                   search(fluid, edges.isochoric, surfaces_.greatest_temperature(), edges.isochoric)) {
      fill_fluid(p, found->state);
    }
    return p;
  }
  const double end = edges.melting == Melting::equilibrium ? edges.solidus : edges.isochoric;
  const double guess = least_temperature + (E - coldest.energy) / solid(0.5 * end).heat_capacity;
  if (const auto found = search(solid, least_temperature, end, guess)) fill_solid(p, found->state);
  return p;
}

template <class Surfaces>
auto ThreePhaseModel<Surfaces>::at_temperature(double V, double T) const -> Point {
  Point p;
  p.V = V;
  p.T = T;
  if (!(V > 0) || !std::isfinite(V) || V < least_volume_) {
    p.broken = "density must be positive and below the compression limit of the cold curve";
  } else if (!(T >= least_temperature) || !std::isfinite(T)) {
    p.broken = "temperature must be finite and not below 1 K";
  } else if (T > surfaces_.greatest_temperature()) {
    p.broken = "temperature above the highest of the model";
  }
  if (!p.broken.empty()) return p;
  const auto fill_from = [&](const GrayPoint& state, bool is_fluid) {
    p.E = state.energy;
    if (!(state.heat_capacity > 0)) p.broken = "energy above that at which the heat capacity vanishes";
    is_fluid ? fill_fluid(p, state) : fill_solid(p, state);
  };
  if (V > surfaces_.gray().join_volume()) {
    fill_from(surfaces_.fluid(V, T), true);
    return p;
  }
  const Edges edges = melting_edges(V);
  if (T > edges.solidus && T < edges.liquidus) {
    p.E = melting_curve_.mixture(V, T).energy;
    fill_mixture(p);
  } else if (T >= edges.liquidus || (edges.tie() && T > edges.isochoric)) {
    fill_from(surfaces_.fluid(V, T), true);
  } else {
    fill_from(surfaces_.solid(V, T), false);
  }
  return p;
}

template <class Surfaces>
RangeReport ThreePhaseModel<Surfaces>::evaluate(const Batch& batch) const {
  RangeReport report;
  const bool melted = !batch.melted_fraction.empty(), vaporised = !batch.vaporised_fraction.empty();
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const Point p = at_energy(1.0 / batch.density[i], batch.specific_internal_energy[i]);
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
    if (!melted && !vaporised) continue;
    const double vapour = p.phase == Phase::solid ? 0.0 : dome_.vaporised_fraction(p.V, p.E);
    if (melted) batch.melted_fraction[i] = std::max(p.melted_fraction, vapour);
    if (vaporised) batch.vaporised_fraction[i] = vapour;
  }
  return report;
}

template <class Surfaces>
State ThreePhaseModel<Surfaces>::full_state(const Point& p) const {
  if (!p.broken.empty()) {
    throw StateError(
        fmt::format("{}: {} (density {:.6g} kg/m^3, compression limit {:.6g} kg/m^3, specific "
                    "internal energy {:.6g} J/kg, temperature {:.6g} K)",
                    name, p.broken, 1 / p.V, maximum_density(), p.E, p.T));
  }
  static constexpr std::array<std::string_view, 7> names = {
      "solid", "melting", "isochoric melting", "liquid", "hot liquid", "vapour", "hot vapour"};
  State s;
  s.density = 1 / p.V;
  s.specific_internal_energy = p.E;
  s.temperature = p.T;
  s.pressure = p.P;
  s.specific_entropy = p.S;
  s.sound_speed = sound_speed(p.squared_sound_speed);
  s.heat_capacity = p.heat_capacity;
  s.gruneisen = p.gruneisen;
  s.isothermal_bulk_modulus = p.bulk_modulus;
  s.phase = names[static_cast<std::size_t>(p.phase)];
  s.vaporised_fraction = p.phase == Phase::solid ? 0.0 : dome_.vaporised_fraction(p.V, p.E);
  s.melted_fraction = std::max(p.melted_fraction, s.vaporised_fraction);
  return s;
}

template <class Surfaces>
State ThreePhaseModel<Surfaces>::state(double density, double specific_internal_energy) const {
  return full_state(at_energy(1.0 / density, specific_internal_energy));
}

template <class Surfaces>
State ThreePhaseModel<Surfaces>::state_at_temperature(double density, double temperature) const {
  return full_state(at_temperature(1.0 / density, temperature));
}

template class ThreePhaseModel<CorrectedGraySurfaces>;
template class ThreePhaseModel<WideGraySurfaces>;

}  // namespace whipple::eos
