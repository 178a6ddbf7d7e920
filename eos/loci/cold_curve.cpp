// SPDX-License-Identifier: BSD-3-Clause
#include "eos/loci/cold_curve.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

/// Maximum compression of the search for the limit in a model without one.
constexpr double greatest_compression = 100;
constexpr double least_expansion = 1e-6;
constexpr int steps_to_limit = 400;

/// Finds the extremum of the pressure between two densities, by ternary section.
State turning_point(const EquationOfState& eos, double from, double to, double sign) {
  for (int i = 0; i < 80 && std::abs(to - from) > 1e-10 * to; ++i) {
    const double third = (to - from) / 3;
    const double a = sign * cold_state(eos, from + third).pressure;
    const double b = sign * cold_state(eos, to - third).pressure;
    (a < b ? from : to) = a < b ? from + third : to - third;
  }
  return cold_state(eos, 0.5 * (from + to));
}

}  // namespace

State cold_state(const EquationOfState& eos, double density) {
  return eos.state(density, eos.minimum_energy(density));
}

ColdCurve cold_curve(const EquationOfState& eos) {
  const double rho0 = eos.reference_density();
  ColdCurve curve;
  State before = cold_state(eos, rho0);
  // Compression: as far as the pressure increases.
  const double last = std::min(eos.maximum_density(), greatest_compression * rho0) * (1 - 1e-9);
  curve.compression_limit = before;
  double last_density = rho0;
  for (int i = 1; i <= steps_to_limit; ++i) {
    const double density = rho0 * std::pow(last / rho0, static_cast<double>(i) / steps_to_limit);
    const State s = cold_state(eos, density);
    // A mixture of two phases has one pressure.
    if (!(s.pressure > curve.compression_limit.pressure) && s.isothermal_bulk_modulus != 0) {
      curve.compression_limit = turning_point(eos, last_density, density, 1);
      break;
    }
    last_density = curve.compression_limit.density;
    curve.compression_limit = s;
  }
  // Zero pressure, then expansion to the minimum pressure.
  const auto pressure = [&](double density) { return cold_state(eos, density).pressure; };
  if (before.pressure < 0) {
    curve.at_rest =
        cold_state(eos, find_root(pressure, rho0, curve.compression_limit.density, "cold density at rest"));
    before = curve.at_rest;
  }
  constexpr double step = 0.99;
  double denser = before.density;
  for (;;) {
    const State s = cold_state(eos, before.density * step);
    if (curve.at_rest.phase.empty() && s.pressure <= 0) {
      curve.at_rest = cold_state(eos, find_root(pressure, s.density, before.density, "cold density at rest"));
    }
    if (!(s.pressure < before.pressure)) {
      if (curve.at_rest.phase.empty()) break;
      curve.tension_limit = turning_point(eos, s.density, denser, -1);
      break;
    }
    if (s.density < least_expansion * rho0) break;
    denser = before.density;
    before = s;
  }
  if (curve.at_rest.phase.empty()) {
    throw StateError(
        fmt::format("model {} has no state of zero pressure on its cold curve: it is a gas", eos.model()));
  }
  curve.cohesive_energy = State::unknown;
  if (curve.tension_limit.phase.empty()) return curve;
  try {
    curve.cohesive_energy = cold_state(eos, least_expansion * rho0).specific_internal_energy -
                            curve.at_rest.specific_internal_energy;
  } catch (const StateError&) {
    // Outside the model: unknown.
  }
  return curve;
}

}  // namespace whipple::eos
