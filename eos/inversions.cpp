// SPDX-License-Identifier: BSD-3-Clause
#include "eos/inversions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "eos/root.hpp"
#include "src/base/error.hpp"

namespace whipple::eos {
namespace {

/// Greatest thermal energy of the searches: far beyond any impact.
constexpr double greatest_energy = 1e15;

/// Energy above `start` at which a rising function of the energy passes zero, from a first step of `scale`.
template <class Function>
double rising_root(const Function& residual, double start, double scale, const char* what) {
  double step = scale;
  while (residual(start + step) < 0) {
    step *= 2;
    if (step > greatest_energy) {
      throw StateError(fmt::format("no {}: not reached within {:.0e} J/kg", what, greatest_energy));
    }
  }
  return find_root(residual, start, start + step, what);
}

}  // namespace

double density_at_pressure(const EquationOfState& eos, double pressure, double temperature) {
  const auto at = [&](double density) { return eos.state_at_temperature(density, temperature); };
  const auto residual = [&](double density) { return at(density).pressure - pressure; };
  double density = eos.reference_density();
  const bool compress = residual(density) < 0;
  const double factor = compress ? 1.01 : 1 / 1.01;
  for (;;) {
    const double next = std::min(density * factor, eos.maximum_density());
    const State state = at(next);
    if ((state.pressure >= pressure) == compress)
      return find_root(residual, density, next, "density at the pressure");
    if (compress && next >= eos.maximum_density()) {
      throw StateError(
          fmt::format("{:.6g} Pa at {:.6g} K: beyond the greatest density of model {} ({:.6g} kg/m^3)",
                      pressure, temperature, eos.model(), eos.maximum_density()));
    }
    if (!compress && ((state.isothermal_bulk_modulus < 0 && state.phase != "melting") ||
                      next < 0.01 * eos.reference_density())) {
      throw StateError(
          fmt::format("no condensed state at {:.6g} Pa and {:.6g} K: the isotherm of model {} turns at "
                      "{:.6g} kg/m^3, {:.6g} Pa",
                      pressure, temperature, eos.model(), next, state.pressure));
    }
    density = next;
  }
}

State state_at_pressure(const EquationOfState& eos, double density, double pressure) {
  // p rises with e wherever the Grueneisen parameter is positive.
  const auto residual = [&](double e) { return eos.state(density, e).pressure - pressure; };
  const double coldest = eos.minimum_energy(density);
  if (residual(coldest) > 0) {
    throw StateError(
        fmt::format("{:.6g} Pa at {:.6g} kg/m^3 lies below the coldest state of model {} ({:.6g} Pa)",
                    pressure, density, eos.model(), residual(coldest) + pressure));
  }
  return eos.state(
      density, rising_root(residual, coldest, std::abs(pressure) / density + 1e3, "energy at the pressure"));
}

State state_at_entropy(const EquationOfState& eos, double density, double entropy) {
  // (ds/de)_rho = 1/T > 0.
  const auto residual = [&](double e) { return eos.state(density, e).specific_entropy - entropy; };
  const double coldest = eos.minimum_energy(density), least = residual(coldest);
  if (std::isnan(least)) {
    throw StateError(fmt::format("model {} knows no entropy at {:.6g} kg/m^3", eos.model(), density));
  }
  if (least > 0) {
    throw StateError(fmt::format(
        "{:.6g} J/(kg K) at {:.6g} kg/m^3 lies below the coldest state of model {} ({:.6g} J/(kg K))",
        entropy, density, eos.model(), least + entropy));
  }
  return eos.state(density, rising_root(residual, coldest, 1e3, "energy at the entropy"));
}

}  // namespace whipple::eos
