// SPDX-License-Identifier: BSD-3-Clause
// Equations: docs/theory/equations_of_state.md, section 2.5.
#include "eos/loci/detonation_products.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

/// Threshold of the constant-volume explosion pressure; that of explosives is several GPa.
constexpr double least_explosion = 1e8;  // Pa

ChapmanJouguet wave_of(const EquationOfState& eos) {
  // Air has a pressure in its reference state and would expand, but it has no energy to release.
  if (eos.condensed() ||
      eos.state(eos.reference_density(), eos.reference_energy()).pressure < least_explosion) {
    throw InputError(
        fmt::format("model {} describes no explosive: expected detonation products (jwl)", eos.model()));
  }
  return chapman_jouguet(eos);
}

double square(double x) { return x * x; }

}  // namespace

DetonationProducts::DetonationProducts(const EquationOfState& eos) : eos_(&eos), cj_(wave_of(eos)) {}

double DetonationProducts::adiabatic_exponent() const {
  return cj_.state.density * square(cj_.state.sound_speed) / cj_.state.pressure;
}

std::vector<IsentropeState> DetonationProducts::expansion(const std::vector<double>& volumes) const {
  std::vector<double> densities;
  double last = chapman_jouguet_volume() * (1 - 1e-9);
  for (const double v : volumes) {
    if (!(v >= last)) {
      throw InputError(
          fmt::format("the products' relative volume {:.6g} is below {:.6g}: expected rising volumes from "
                      "that of the Chapman-Jouguet state on",
                      v, last));
    }
    densities.push_back(eos_->reference_density() / v);
    last = v;
  }
  return isentrope(*eos_, cj_.state, densities);
}

double DetonationProducts::gurney_velocity(double volume) const {
  const double energy = energy_given_off(expansion({volume}).front().state);
  if (!(energy > 0)) {
    throw InputError(
        fmt::format("products at the relative volume {:.6g} have given off no energy yet", volume));
  }
  return std::sqrt(2 * energy);
}

ImpedanceMatch DetonationProducts::contact(const Hugoniot& inert) const {
  const ShockState incident = wave();
  if (inert.at_particle_velocity(incident.particle_velocity).state.pressure >= incident.state.pressure) {
    return match_shock(*eos_, incident, inert);
  }
  // Expansion: gases do not reach zero pressure, so the search follows the isentrope down instead of starting there.
  const auto products = [&](double p) { return isentrope_at_pressure(*eos_, incident.state, p); };
  const auto residual = [&](double p) {
    return inert.at_pressure(p).particle_velocity -
           (incident.particle_velocity - products(p).riemann_velocity);
  };
  double upper = incident.state.pressure, lower = 0.5 * upper;
  while (residual(lower) > 0) {
    upper = lower;
    lower *= 0.5;
    if (lower <= inert.initial().pressure)
      throw StateError("products and inert material agree at no pressure");
  }
  const double p = find_root(residual, lower, upper, "pressure of the interface");
  const ShockState right = inert.at_pressure(p);
  return {p, right.particle_velocity, products(p).state, right.state, right.shock_velocity, State::unknown};
}

double gurney_speed(GurneyShape shape, double gurney_velocity, double m) {
  if (!(gurney_velocity > 0) || !(m > 0)) {
    throw InputError(fmt::format("expected a velocity and a mass ratio above zero, not {:.6g} m/s and {:.6g}",
                                 gurney_velocity, m));
  }
  switch (shape) {
    case GurneyShape::cylinder:
      return gurney_velocity / std::sqrt(m + 0.5);
    case GurneyShape::sphere:
      return gurney_velocity / std::sqrt(m + 0.6);
    case GurneyShape::symmetric_sandwich:
      return gurney_velocity / std::sqrt(m + 1.0 / 3);
    case GurneyShape::open_face:
      break;
  }
  return gurney_velocity / std::sqrt(((1 + 2 * m) * square(1 + 2 * m) + 1) / (6 * (1 + m)) + m);
}

std::vector<CylinderWall> cylinder_test(const DetonationProducts& products, const CylinderTest& test,
                                        const std::vector<double>& displacements) {
  if (!(test.inner_radius > 0 && test.wall > 0 && test.wall_density > 0)) {
    throw InputError("a cylinder test needs a radius, a wall and a density above zero");
  }
  constexpr int points = 2000;
  constexpr double greatest_volume = 100;
  const double rho0 = products.equation_of_state().reference_density();
  const double D = products.chapman_jouguet().detonation_velocity, v0 = products.chapman_jouguet_volume();
  const double ri2 = square(test.inner_radius), ro2 = square(test.inner_radius + test.wall);
  // Per unit length and pi: M + C/2.
  const double mass = test.wall_density * (ro2 - ri2) + 0.5 * rho0 * ri2;

  std::vector<double> volumes;
  for (int i = 0; i <= points; ++i)
    volumes.push_back(v0 * std::pow(greatest_volume / v0, static_cast<double>(i) / points));
  const std::vector<IsentropeState> states = products.expansion(volumes);
  const auto enthalpy = [](const State& s) { return s.specific_internal_energy + s.pressure / s.density; };
  const State& cj = products.chapman_jouguet().state;
  // In the frame of the wave the products leave the front at their sound speed.
  const double head = 0.5 * square(D - products.chapman_jouguet().particle_velocity) + enthalpy(cj);
  std::vector<double> section, turned;  // A/A0, 1 - cos(theta)
  for (const IsentropeState& s : states) {
    const double A = rho0 * D / (s.state.density * std::sqrt(2 * (head - enthalpy(s.state))));
    const double before = section.empty() ? A : section.back(),
                 p_before = section.empty() ? cj.pressure : states[section.size() - 1].state.pressure;
    const double work = 0.5 * (s.state.pressure + p_before) * (A - before) * ri2 / (square(D) * mass);
    turned.push_back(turned.empty() ? 0.0 : turned.back() + work);
    section.push_back(A);
  }
  std::vector<CylinderWall> walls;
  for (const double x : displacements) {
    const double outer2 = square(std::sqrt(ro2) + x), inner2 = outer2 - (ro2 - ri2), A = inner2 / ri2;
    const auto above = std::ranges::upper_bound(section, A);
    if (!(x >= 0) || above == section.end()) {
      throw StateError(fmt::format("the wall of the cylinder test moves from 0 to {:.4g} m, not {:.4g} m",
                                   std::sqrt(section.back() * ri2 + ro2 - ri2) - std::sqrt(ro2), x));
    }
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - section.begin(), 1));
    const double part = std::clamp((A - section[i - 1]) / (section[i] - section[i - 1]), 0.0, 1.0);
    const auto between = [&](double a, double b) { return a + part * (b - a); };
    const double turn = between(turned[i - 1], turned[i]), angle = std::acos(1 - turn);
    walls.push_back({x, D * std::tan(angle) * std::sqrt(inner2 / outer2), 2 * D * std::sin(0.5 * angle),
                     angle, between(volumes[i - 1], volumes[i]),
                     between(states[i - 1].state.pressure, states[i].state.pressure)});
  }
  return walls;
}

}  // namespace whipple::eos
