// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "tests/unit/fit_support.hpp"

/// What the tests of corrected free energies share.
namespace whipple::fit::testing {

/// What the crystal of the tests has beside GRAY: a cold part in x^3 and an anharmonic one in x T^2, x = 1 - V/V0, of
/// one free energy W = C^2 (0.04 x^3 - 2e-9 x T^2).
struct Deviation {
  double energy, volume;    ///< C^2, V0
  double anharmonic, cold;  ///< multiples

  [[nodiscard]] double x(double V) const { return 1.0 - V / volume; }
  [[nodiscard]] double pressure(double V, double T) const {
    return energy * (cold * 0.12 * x(V) * x(V) - anharmonic * 2e-9 * T * T) / volume;
  }
  [[nodiscard]] double internal_energy(double V, double T) const {
    return energy * (cold * 0.04 * std::pow(x(V), 3) + anharmonic * 2e-9 * x(V) * T * T);
  }
};
inline Deviation deviation(const eos::GrayConstants& c, double anharmonic = 1.0, double cold = 1.0) {
  return {c.hugoniot_intercept * c.hugoniot_intercept, c.reference_specific_volume, anharmonic, cold};
}

/// Returns the states of a crystal with a multiple of the deviation; melting is that of GRAY, and left out.
inline std::vector<md::PointRecord> crystal(unsigned seed, double anharmonic = 1.0, double cold = 1.0) {
  const eos::GrayConstants constants = true_constants();
  const Deviation extra = deviation(constants, anharmonic, cold);
  std::vector<md::PointRecord> points;
  for (md::PointRecord point : SyntheticStore(constants, {}, seed).points) {
    if (point.protocol != "isochore" && point.protocol != "isotherm") continue;
    const double V = point.conditions.at("specific_volume"), T = point.conditions.at("temperature");
    point.results.at("pressure").value += extra.pressure(V, T);
    point.results.at("specific_internal_energy").value += extra.internal_energy(V, T);
    points.push_back(std::move(point));
  }
  return points;
}

/// States that the store does not hold.
inline std::vector<std::pair<double, double>> unseen_states(const eos::GrayConstants& c) {
  std::vector<std::pair<double, double>> states;
  for (const double ratio : {1.01, 0.97, 0.92, 0.87, 0.82}) {
    for (const double T : {400.0, 800.0, 1100.0}) states.emplace_back(ratio * c.reference_specific_volume, T);
  }
  return states;
}

}  // namespace whipple::fit::testing
