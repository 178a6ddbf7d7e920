// SPDX-License-Identifier: BSD-3-Clause
#include "eos/detonation.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

/// Largest compression of the search. Products with a constant adiabatic exponent g are tangent at (g + 1)/g; known
/// ones are below 1.5.
constexpr double greatest_compression = 10;
constexpr double greatest_energy = 1e12;  // J/kg
constexpr int most_doublings = 200;

}  // namespace

ChapmanJouguet chapman_jouguet(const Products& products, const Explosive& explosive, double maximum_density) {
  const double rho0 = explosive.density, e0 = explosive.specific_internal_energy, p0 = explosive.pressure;
  const double released = products(rho0, e0).pressure - p0;  // constant-volume explosion
  if (!(released > 0)) {
    throw StateError(
        fmt::format("no detonation: the products at the density of the explosive ({:.6g} kg/m^3) and {:.6g} "
                    "J/kg are not above its pressure",
                    rho0, e0));
  }
  // State on the Hugoniot at a density: the residual increases with e while Gamma (rho/rho0 - 1) < 2.
  const auto hugoniot = [&](double density) {
    const double half = 0.5 * (1 / rho0 - 1 / density);
    const auto residual = [&](double e) { return e - e0 - (products(density, e).pressure + p0) * half; };
    double upper = e0 + half * released;
    for (int i = 0; residual(upper) < 0; ++i) {
      upper = e0 + 2 * (upper - e0);
      // Unreachable if the step is lost in the round-off of e0, however often it is doubled.
      if (i == most_doublings || upper - e0 > greatest_energy)
        throw StateError("no Hugoniot of the products at this compression");
    }
    return products(density, find_root(residual, e0, upper, "energy on the products' Hugoniot"));
  };
  // > 0 below the tangent point, where the flow behind the wave is supersonic.
  const auto contact = [&](double density) {
    const State s = hugoniot(density);
    return (s.pressure - p0) - (1 / rho0 - 1 / density) * std::pow(density * s.sound_speed, 2);
  };
  const double densest = std::min(maximum_density, greatest_compression * rho0);
  for (double below = rho0; below < densest;) {
    const double density = std::min(1.01 * below, densest);
    if (contact(density) <= 0) {
      const State s = hugoniot(
          find_root(contact, std::max(below, 1.0001 * rho0), density, "contact of the Rayleigh line"));
      const double slope = (s.pressure - p0) / (1 / rho0 - 1 / s.density);
      const double D = std::sqrt(slope) / rho0;
      return {D, (s.pressure - p0) / (rho0 * D), s};
    }
    below = density;
  }
  throw StateError(fmt::format(
      "no detonation: the Rayleigh line touches the products' Hugoniot nowhere up to {:.6g} kg/m^3",
      densest));
}

ChapmanJouguet chapman_jouguet(const EquationOfState& products) {
  return chapman_jouguet([&](double density, double e) { return products.state(density, e); },
                         {products.reference_density(), products.reference_energy(), 0.0},
                         products.maximum_density());
}

}  // namespace whipple::eos
