// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/loci.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <functional>

#include "eos/root.hpp"
#include "src/base/error.hpp"

namespace whipple::eos {
namespace {

namespace odeint = boost::numeric::odeint;

constexpr int scan_points = 96;

/// First root of f(eta) on 0 < eta <= greatest compression, coming from eta = 0, where f < 0.
double first_compression(const EquationOfState& eos, const State& initial,
                         const std::function<double(double)>& f, const char* what) {
  const double greatest = (1 - initial.density / eos.maximum_density()) * (1 - 1e-9);
  double before = 1e-13;
  for (int i = 1; i <= scan_points; ++i) {
    const double eta = greatest * i / scan_points;
    if (f(eta) >= 0) return find_root(f, before, eta, what, 52);
    before = eta;
  }
  throw StateError(fmt::format("{}: beyond the greatest density of model {} ({:.6g} kg/m^3)", what,
                               eos.model(), eos.maximum_density()));
}

}  // namespace

Hugoniot::Hugoniot(const EquationOfState& eos)
    : Hugoniot(eos, eos.reference_density(), eos.reference_energy()) {}

Hugoniot::Hugoniot(const EquationOfState& eos, double density, double specific_internal_energy)
    : eos_(&eos), initial_(eos.state(density, specific_internal_energy)) {}

ShockState Hugoniot::shock(double density, double energy) const {
  ShockState s;
  s.state = eos_->state(density, energy);
  const double jump = s.state.pressure - initial_.pressure, eta = 1 - initial_.density / density;
  s.particle_velocity = std::sqrt(std::max(0.0, jump * eta / initial_.density));
  s.shock_velocity =
      eta > 0 ? std::sqrt(std::max(0.0, jump / (initial_.density * eta))) : initial_.sound_speed;
  return s;
}

ShockState Hugoniot::at_particle_velocity(double up) const {
  if (!(up >= 0))
    throw StateError(fmt::format("Hugoniot: the particle velocity must not be negative, not {} m/s", up));
  const double V0 = 1 / initial_.density;
  if (up < 1e-6 * initial_.sound_speed) return shock(initial_.density, initial_.specific_internal_energy);
  // Momentum p - p0 = rho0 up^2/eta and energy e - e0 = up^2/2 + p0 V0 eta  (L1)
  const auto energy = [&](double eta) {
    return initial_.specific_internal_energy + 0.5 * up * up + initial_.pressure * V0 * eta;
  };
  const auto residual = [&](double eta) {
    return eos_->state(initial_.density / (1 - eta), energy(eta)).pressure - initial_.pressure -
           initial_.density * up * up / eta;
  };
  const double eta = first_compression(*eos_, initial_, residual, "Hugoniot at the particle velocity");
  return shock(initial_.density / (1 - eta), energy(eta));
}

ShockState Hugoniot::at_pressure(double pressure) const {
  if (!(pressure >= initial_.pressure)) {
    throw StateError(
        fmt::format("Hugoniot: the pressure must not be below that ahead of the shock ({:.6g} Pa), not {} Pa",
                    initial_.pressure, pressure));
  }
  if (pressure - initial_.pressure <
      1e-6 * initial_.density * initial_.sound_speed * initial_.sound_speed * 1e-6) {
    return shock(initial_.density, initial_.specific_internal_energy);
  }
  const double V0 = 1 / initial_.density;
  const auto energy = [&](double eta) {
    return initial_.specific_internal_energy + 0.5 * (pressure + initial_.pressure) * V0 * eta;
  };
  const auto residual = [&](double eta) {
    return eos_->state(initial_.density / (1 - eta), energy(eta)).pressure - pressure;
  };
  const double eta = first_compression(*eos_, initial_, residual, "Hugoniot at the pressure");
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
  const auto residual = [&](double e) {
    return e - initial_.specific_internal_energy -
           0.5 * (eos_->state(density, e).pressure + initial_.pressure) * change;
  };
  if (change == 0) return shock(density, initial_.specific_internal_energy);
  // The residual is negative at e0 (the cold pressure does work) and rises with e until Gamma rho change/2 =
  // 1: the greatest compression of any shock.
  const double scale = initial_.sound_speed * initial_.sound_speed;
  double step = 1e-6 * scale, e = initial_.specific_internal_energy;
  while (residual(e + step) < 0) {
    step *= 2;
    if (step > 1e4 * scale) {
      throw StateError(fmt::format("Hugoniot: no shock reaches {:.6g} kg/m^3", density));
    }
  }
  return shock(density, find_root(residual, e, e + step, "Hugoniot at the density", 52));
}

namespace {

/// Along w = ln V: de/dw = -p V, du/dw = -c  (L2).
using IsentropeVector = std::array<double, 2>;

class IsentropeIntegrator {
 public:
  IsentropeIntegrator(const EquationOfState& eos, const State& start)
      : eos_(&eos), log_volume_(-std::log(start.density)), y_{start.specific_internal_energy, 0.0} {}

  void slope(const IsentropeVector& y, IsentropeVector& dydw, double w) const {
    const State s = at(w, y);
    dydw = {-s.pressure / s.density, -s.sound_speed};
  }
  [[nodiscard]] State at(double w, const IsentropeVector& y) const { return eos_->state(std::exp(-w), y[0]); }
  [[nodiscard]] State state() const { return at(log_volume_, y_); }
  [[nodiscard]] double log_volume() const { return log_volume_; }
  [[nodiscard]] const IsentropeVector& vector() const { return y_; }

  /// One step of at most `limit` (signed) with error control; returns the step made.
  double advance(double limit) {
    const auto system = [this](const IsentropeVector& y, IsentropeVector& d, double w) { slope(y, d, w); };
    constexpr double greatest = 0.01;
    const double sign = limit < 0 ? -1.0 : 1.0;
    double h = sign * std::min({std::abs(limit), std::abs(step_), greatest});
    const double before = log_volume_;
    const double scale = std::abs(y_[0]) + 1.0;
    auto stepper =
        odeint::make_controlled(1e-12 * scale, 1e-10, odeint::runge_kutta_dopri5<IsentropeVector>());
    // At a kink (edge of a phase) the error estimate can refuse for long: a step of 1e-9 is accepted as it
    // is.
    while (stepper.try_step(system, y_, log_volume_, h) != odeint::success) {
      if (std::abs(h) < 1e-9) {
        y_ = single_step(h);
        log_volume_ += h;
        break;
      }
    }
    step_ = std::max(std::abs(h), 1e-8);
    return log_volume_ - before;
  }
  /// Result of one step h from the present point, which stays.
  [[nodiscard]] IsentropeVector single_step(double h) const {
    const auto system = [this](const IsentropeVector& y, IsentropeVector& d, double w) { slope(y, d, w); };
    IsentropeVector y = y_;
    odeint::runge_kutta_dopri5<IsentropeVector> stepper;
    stepper.do_step(system, y, log_volume_, h);
    return y;
  }

 private:
  const EquationOfState* eos_;
  double log_volume_;
  IsentropeVector y_;
  double step_ = 1e-4;
};

}  // namespace

std::vector<IsentropeState> isentrope(const EquationOfState& eos, const State& start,
                                      const std::vector<double>& densities) {
  IsentropeIntegrator integrator(eos, start);
  std::vector<IsentropeState> result;
  for (const double density : densities) {
    const double target = -std::log(density);
    for (double left = target - integrator.log_volume(); std::abs(left) > 1e-15;
         left = target - integrator.log_volume()) {
      integrator.advance(left);
    }
    result.push_back({integrator.state(), integrator.vector()[1]});
  }
  return result;
}

Release release(const EquationOfState& eos, const State& start, double pressure) {
  const VapourDome* dome = eos.vapour_dome();
  const auto saturation = dome != nullptr ? dome->at_pressure(pressure) : std::nullopt;
  if (saturation && start.specific_entropy > saturation->liquid_entropy &&
      start.specific_entropy < saturation->vapour_entropy) {
    // Two phases in equilibrium: lever rule on the entropy (L4).
    const Saturation& s = *saturation;
    const double x = (start.specific_entropy - s.liquid_entropy) / (s.vapour_entropy - s.liquid_entropy);
    Release result;
    result.in_equilibrium = true;
    State& end = result.end.state;
    end.density = 1 / (s.liquid_volume + x * (s.vapour_volume - s.liquid_volume));
    end.specific_internal_energy = s.liquid_energy + x * (s.vapour_energy - s.liquid_energy);
    end.temperature = s.temperature;
    end.pressure = s.pressure;
    end.specific_entropy = start.specific_entropy;
    end.melted_fraction = 1.0;
    end.vaporised_fraction = x;
    end.phase = "liquid and vapour";
    result.end.riemann_velocity = State::unknown;
    return result;
  }
  IsentropeIntegrator integrator(eos, start);
  const double direction = pressure < start.pressure ? 1.0 : -1.0;
  double last_pressure = start.pressure;
  if (pressure == start.pressure) return {{start, 0.0}, false};
  for (;;) {
    const IsentropeIntegrator before = integrator;
    const double h = integrator.advance(direction);
    const State state = integrator.state();
    if ((state.pressure - pressure) * direction <= 0) {
      const auto residual = [&](double part) {
        return before.at(before.log_volume() + part, before.single_step(part)).pressure - pressure;
      };
      const double part = find_root(residual, 0.0, h, "release to the pressure");
      const IsentropeVector y = before.single_step(part);
      return {{before.at(before.log_volume() + part, y), y[1]}, false};
    }
    if ((state.pressure - last_pressure) * direction > 0) {
      throw StateError(
          fmt::format("the isentrope does not reach {:.6g} Pa: it turns at {:.6g} Pa, {:.6g} kg/m^3",
                      pressure, state.pressure, state.density));
    }
    if (state.density < 1e-9 * eos.reference_density()) {
      throw StateError(fmt::format(
          "the isentrope does not reach {:.6g} Pa above 1e-9 of the reference density", pressure));
    }
    last_pressure = state.pressure;
  }
}

std::optional<ShockMelting> shock_melting(const EquationOfState& eos, double highest_pressure) {
  const Hugoniot hugoniot(eos);
  const auto melted = [&](double pressure) { return hugoniot.at_pressure(pressure).state.melted_fraction; };
  double solid = 0, liquid = 1e9;
  try {
    while (melted(liquid) < 1.0) {
      liquid *= 1.25;
      if (liquid > highest_pressure) return std::nullopt;
    }
  } catch (const StateError&) {
    return std::nullopt;  // the model ends before the metal has molten
  }
  // Both edges by bisection on "the fraction has left its limit": it is constant beyond them.
  const auto edge = [&](auto beyond) {
    double lower = solid, upper = liquid;
    for (int i = 0; i < 60 && upper - lower > 1e-9 * upper; ++i) {
      const double middle = 0.5 * (lower + upper);
      (beyond(melted(middle)) ? upper : lower) = middle;
    }
    return hugoniot.at_pressure(0.5 * (lower + upper));
  };
  return ShockMelting{edge([](double fraction) { return fraction > 0.0; }),
                      edge([](double fraction) { return fraction >= 1.0; })};
}

}  // namespace whipple::eos
