// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/loci/hugoniot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr int scan_points = 96;
constexpr int root_digits = 52;
/// Particle velocity, relative to the sound speed, below which there is no shock.
constexpr double least_strength = 1e-6;

/// Returns the first root of f(eta) on 0 < eta <= greatest compression, starting from eta = 0, where f < 0.
double first_compression(const EquationOfState& eos, double initial_density,
                         const std::function<double(double)>& f, const char* what) {
  const double greatest = (1 - initial_density / eos.maximum_density()) * (1 - 1e-9);
  double before = 1e-13;
  for (int i = 1; i <= scan_points; ++i) {
    const double eta = greatest * i / scan_points;
    if (f(eta) >= 0) return find_root(f, before, eta, what, root_digits);
    before = eta;
  }
  throw StateError(fmt::format("{}: beyond the maximum density of model {} ({:.6g} kg/m^3)", what,
                               eos.model(), eos.maximum_density()));
}

}  // namespace

Hugoniot::Hugoniot(const EquationOfState& eos)
    : Hugoniot(eos, eos.reference_density(), eos.reference_energy()) {}

Hugoniot::Hugoniot(const EquationOfState& eos, double density, double specific_internal_energy)
    : eos_(&eos), initial_(eos.state(density, specific_internal_energy)) {
  stiffness_ = initial_.density * initial_.sound_speed * initial_.sound_speed;
}

Hugoniot::Hugoniot(const EquationOfState& eos, const State& initial, double stiffness)
    : eos_(&eos), initial_(initial), stiffness_(stiffness) {}

Hugoniot Hugoniot::porous(const EquationOfState& eos, double density) {
  const State grains = eos.state(eos.reference_density(), eos.reference_energy());
  if (!(density > 0 && density < grains.density)) {
    throw StateError(
        fmt::format("porous Hugoniot: the initial density must be positive and below the reference density "
                    "of model {} ({:.6g} kg/m^3), not {:.6g} kg/m^3",
                    eos.model(), grains.density, density));
  }
  State initial;
  initial.density = density;
  initial.specific_internal_energy = grains.specific_internal_energy;
  initial.temperature = grains.temperature;
  initial.pressure = grains.pressure;
  initial.specific_entropy = grains.specific_entropy;
  initial.melted_fraction = grains.melted_fraction;
  initial.vaporised_fraction = grains.vaporised_fraction;
  initial.phase = "porous";
  return {eos, initial, grains.density * grains.sound_speed * grains.sound_speed};
}

ShockState Hugoniot::shock(double density, double energy) const {
  ShockState s;
  s.state = eos_->state(density, energy);
  const double jump = s.state.pressure - initial_.pressure, eta = 1 - initial_.density / density;
  s.particle_velocity = std::sqrt(std::max(0.0, jump * eta / initial_.density));
  s.shock_velocity = std::sqrt(std::max(0.0, jump / (initial_.density * eta)));
  return s;
}

ShockState Hugoniot::at_rest() const {
  ShockState s;
  s.state = initial_;
  // A weak shock in porous material closes the voids at zero pressure and zero velocity.
  s.shock_velocity = std::isnan(initial_.sound_speed) ? 0.0 : initial_.sound_speed;
  return s;
}

ShockState Hugoniot::at_particle_velocity(double up) const {
  if (!(up >= 0))
    throw StateError(fmt::format("Hugoniot: the particle velocity must not be negative, not {} m/s", up));
  const double V0 = 1 / initial_.density;
  if (up < least_strength * std::sqrt(stiffness_ * V0)) return at_rest();
  // Momentum p - p0 = rho0 up^2/eta and energy e - e0 = up^2/2 + p0 V0 eta  (L1).
  const auto energy = [&](double eta) {
    return initial_.specific_internal_energy + 0.5 * up * up + initial_.pressure * V0 * eta;
  };
  const auto residual = [&](double eta) {
    return eos_->state(initial_.density / (1 - eta), energy(eta)).pressure - initial_.pressure -
           initial_.density * up * up / eta;
  };
  const double eta =
      first_compression(*eos_, initial_.density, residual, "Hugoniot at the particle velocity");
  return shock(initial_.density / (1 - eta), energy(eta));
}

ShockState Hugoniot::at_pressure(double pressure) const {
  if (!(pressure >= initial_.pressure)) {
    throw StateError(
        fmt::format("Hugoniot: the pressure must not be below that ahead of the shock ({:.6g} Pa), not {} Pa",
                    initial_.pressure, pressure));
  }
  if (pressure - initial_.pressure < least_strength * least_strength * stiffness_) return at_rest();
  const double V0 = 1 / initial_.density;
  const auto energy = [&](double eta) {
    return initial_.specific_internal_energy + 0.5 * (pressure + initial_.pressure) * V0 * eta;
  };
  const auto residual = [&](double eta) {
    return eos_->state(initial_.density / (1 - eta), energy(eta)).pressure - pressure;
  };
  const double eta = first_compression(*eos_, initial_.density, residual, "Hugoniot at the pressure");
  return shock(initial_.density / (1 - eta), energy(eta));
}

ShockState Hugoniot::at_density(double density) const {
  if (!(density >= initial_.density)) {
    throw StateError(
        fmt::format("Hugoniot: the density must not be below that ahead of the shock ({:.6g} kg/m^3), not "
                    "{:.6g} kg/m^3",
                    initial_.density, density));
  }
  const double change = 1 / initial_.density - 1 / density;
  if (change == 0) return at_rest();
  const double e0 = initial_.specific_internal_energy;
  const auto residual = [&](double e) {
    return e - e0 - 0.5 * (eos_->state(density, e).pressure + initial_.pressure) * change;
  };
  // At e0 the residual is negative if the material is compressed there (the cold pressure does work), and increases
  // with e until Gamma rho change/2 = 1, the greatest compression of any shock. Expanded, closed-up porous material
  // is in tension at e0: the residual is initially positive and decreases.
  const double sign = residual(e0) < 0 ? 1 : -1;
  const double scale = stiffness_ / initial_.density;
  double before = e0, step = 1e-6 * scale;
  for (; sign * residual(e0 + step) < 0; step *= 2) {
    before = e0 + step;
    if (step > 1e4 * scale) {
      throw StateError(fmt::format("Hugoniot: no shock compresses from {:.6g} to {:.6g} kg/m^3 (model {})",
                                   initial_.density, density, eos_->model()));
    }
  }
  return shock(density, find_root(residual, before, e0 + step, "Hugoniot at the density", root_digits));
}

ShockState reflected_at_wall(const EquationOfState& eos, const ShockState& shocked) {
  return Hugoniot(eos, shocked.state.density, shocked.state.specific_internal_energy)
      .at_particle_velocity(shocked.particle_velocity);
}

}  // namespace whipple::eos
