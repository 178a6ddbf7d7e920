// SPDX-License-Identifier: BSD-3-Clause
#include "eos/inversions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

/// Maximum thermal energy (J/kg) of the searches: far beyond any impact.
constexpr double greatest_energy = 1e15;
/// Minimum density of the searches, relative to the reference density.
constexpr double least_density_ratio = 1e-12;
/// Steps of ln(rho) along an isotherm: the first one, and the limits of all.
constexpr double first_step = 0.01, least_step = 0.002, greatest_step = 0.05;
constexpr int root_digits = 51;

/// Returns the state found, or throws if the search ended at a discontinuity of the model. (Tables of a model may
/// have steps of 1e-6 of the bulk modulus at the edges of phases.)
State checked(const State& state, double found, double asked, double scale, const char* quantity) {
  if (std::abs(found - asked) <= 3e-6 * (std::abs(asked) + std::abs(scale))) return state;
  throw StateError(
      fmt::format("no state of {} {:.8g}: the model jumps over it at {:.6g} kg/m^3, {:.6g} J/kg ({:.8g})",
                  quantity, asked, state.density, state.specific_internal_energy, found));
}

double stiffness(const State& s) { return s.density * s.sound_speed * s.sound_speed; }

/// Returns the energy above `start` at which a function of the energy that is initially negative first crosses zero,
/// with a first step of `scale`. Steps are doubled until the sign changes; a step that leaves the model is halved.
template <class Function>
double rising_root(const Function& residual, double start, double scale, const char* what) {
  double inside = start, outside = std::numeric_limits<double>::infinity(), step = scale;
  std::string bound;
  for (;;) {
    const double next = std::isinf(outside) ? start + step : 0.5 * (inside + outside);
    if (step > greatest_energy || outside - inside < 1e-9 * (outside - start)) {
      throw StateError(fmt::format("no {}: not reached up to {:.6g} J/kg{}{}", what, inside,
                                   bound.empty() ? "" : "; beyond it, ", bound));
    }
    double value = 0;
    try {
      value = residual(next);
    } catch (const StateError& fault) {
      outside = next;
      bound = fault.what();
      continue;
    }
    if (!(value < 0)) return find_root(residual, inside, next, what, root_digits);
    inside = next;
    step *= 2;
  }
}

}  // namespace

State state_at_pressure_and_temperature(const EquationOfState& eos, double pressure, double temperature,
                                        std::optional<double> from) {
  const auto at = [&](double density) { return eos.state_at_temperature(density, temperature); };
  State here = at(from.value_or(eos.reference_density()));
  if (here.pressure == pressure) return here;
  const bool compress = here.pressure < pressure;
  const double direction = compress ? 1 : -1;
  for (double step = first_step;;) {
    const double density = std::min(here.density * std::exp(direction * step), eos.maximum_density());
    const State next = at(density);
    if ((next.pressure - pressure) * direction >= 0) {
      const State found = at(find_root([&](double rho) { return at(rho).pressure - pressure; }, here.density,
                                       density, "density at the pressure", root_digits));
      return checked(found, found.pressure, pressure, stiffness(found), "pressure (Pa)");
    }
    if (!std::isfinite(next.pressure)) {
      throw StateError(
          fmt::format("no state at {:.6g} Pa and {:.6g} K: the pressure of model {} at {:.6g} "
                      "kg/m^3 is not finite",
                      pressure, temperature, eos.model(), density));
    }
    if (compress && density >= eos.maximum_density()) {
      throw StateError(
          fmt::format("{:.6g} Pa at {:.6g} K: beyond the maximum density of model {} ({:.6g} kg/m^3)",
                      pressure, temperature, eos.model(), eos.maximum_density()));
    }
    // Within one phase the pressure follows the density up to a spinodal. Partly molten material may have a
    // plateau.
    const bool mixture = next.melted_fraction > 0 && next.melted_fraction < 1;
    const bool turns = (next.pressure - here.pressure) * direction < 0 || next.isothermal_bulk_modulus < 0;
    if ((turns && next.phase == here.phase && !mixture) ||
        density < least_density_ratio * eos.reference_density()) {
      throw StateError(
          fmt::format("no state at {:.6g} Pa and {:.6g} K on the branch of {:.6g} kg/m^3: the isotherm of "
                      "model {} {} at {:.6g} kg/m^3, {:.6g} Pa",
                      pressure, temperature, from.value_or(eos.reference_density()), eos.model(),
                      turns ? "turns" : "has not reached it", next.density, next.pressure));
    }
    // Use longer steps where the bulk modulus predicts the pressure well, shorter ones towards a spinodal.
    const double foretold = here.isothermal_bulk_modulus * step;
    const bool smooth = std::abs(std::abs(next.pressure - here.pressure) - foretold) < 0.2 * foretold;
    step = smooth ? std::min(1.5 * step, greatest_step) : std::max(0.5 * step, least_step);
    here = next;
  }
}

double density_at_pressure(const EquationOfState& eos, double pressure, double temperature) {
  return state_at_pressure_and_temperature(eos, pressure, temperature).density;
}

State state_at_pressure(const EquationOfState& eos, double density, double pressure) {
  // p increases with e wherever the Grueneisen parameter is positive.
  const double coldest = eos.minimum_energy(density);
  const State cold = eos.state(density, coldest);
  const double scale = std::abs(pressure) + stiffness(cold);
  if (cold.pressure - pressure > 1e-12 * scale) {
    throw StateError(
        fmt::format("{:.6g} Pa at {:.6g} kg/m^3 lies below the coldest state of model {} ({:.6g} Pa)",
                    pressure, density, eos.model(), cold.pressure));
  }
  if (cold.pressure >= pressure) return cold;
  const auto residual = [&](double e) { return eos.state(density, e).pressure - pressure; };
  const State found = eos.state(
      density, rising_root(residual, coldest, std::abs(pressure) / density + 1e3, "energy at the pressure"));
  return checked(found, found.pressure, pressure, stiffness(found), "pressure (Pa)");
}

State state_at_entropy(const EquationOfState& eos, double density, double entropy) {
  // (ds/de)_rho = 1/T > 0.
  const double coldest = eos.minimum_energy(density);
  const State cold = eos.state(density, coldest);
  if (std::isnan(cold.specific_entropy)) {
    throw StateError(fmt::format("model {} has no entropy at {:.6g} kg/m^3", eos.model(), density));
  }
  if (cold.specific_entropy >= entropy) {
    if (cold.specific_entropy - entropy <= 1e-12 * (std::abs(entropy) + 1)) return cold;
    throw StateError(
        fmt::format("{:.6g} J/(kg K) at {:.6g} kg/m^3 lies below the coldest state of model {} ({:.6g} J/(kg "
                    "K))",
                    entropy, density, eos.model(), cold.specific_entropy));
  }
  const auto residual = [&](double e) { return eos.state(density, e).specific_entropy - entropy; };
  const State found = eos.state(density, rising_root(residual, coldest, 1e3, "energy at the entropy"));
  return checked(found, found.specific_entropy, entropy, 1.0, "specific entropy (J/(kg K))");
}

}  // namespace whipple::eos
