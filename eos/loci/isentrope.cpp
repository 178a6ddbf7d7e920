// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/loci/isentrope.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

namespace odeint = boost::numeric::odeint;

/// Holds e and u along w = ln V: de/dw = -p V, du/dw = -c  (L2).
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

  /// Makes one step of at most `limit` (signed) with error control; returns the step made.
  double advance(double limit) {
    const auto system = [this](const IsentropeVector& y, IsentropeVector& d, double w) { slope(y, d, w); };
    constexpr double greatest = 0.01;
    const double sign = limit < 0 ? -1.0 : 1.0;
    double h = sign * std::min({std::abs(limit), std::abs(step_), greatest});
    const double before = log_volume_;
    const double scale = std::abs(y_[0]) + 1.0;
    auto stepper =
        odeint::make_controlled(1e-12 * scale, 1e-10, odeint::runge_kutta_dopri5<IsentropeVector>());
    // At a kink (edge of a phase) the error control may reject many steps: a step of 1e-9 is accepted.
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
  /// Returns the result of one step h from the current point, which is not changed.
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
  const bool expands = !densities.empty() && densities.back() < start.density;
  const auto unloading = expands ? eos.unloading(start) : nullptr;  // crushed pores stay closed
  IsentropeIntegrator integrator(unloading ? *unloading : eos, start);
  std::vector<IsentropeState> result;
  for (const double density : densities) {
    const double target = -std::log(density);
    for (double left = target - integrator.log_volume(); std::abs(left) > 1e-14;
         left = target - integrator.log_volume()) {
      integrator.advance(left);
    }
    result.push_back({integrator.state(), integrator.vector()[1]});
  }
  return result;
}

IsentropeState isentrope_at_pressure(const EquationOfState& eos, const State& start, double pressure) {
  // Equal within the round-off of the pressure at this stiffness.
  const double stiffness = start.density * start.sound_speed * start.sound_speed;
  if (std::abs(pressure - start.pressure) <= 1e-12 * (std::abs(pressure) + stiffness)) return {start, 0.0};
  const double direction = pressure < start.pressure ? 1.0 : -1.0;
  const auto unloading = direction > 0 ? eos.unloading(start) : nullptr;  // crushed pores stay closed
  IsentropeIntegrator integrator(unloading ? *unloading : eos, start);
  double last_pressure = start.pressure;
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
      return {before.at(before.log_volume() + part, y), y[1]};
    }
    if ((state.pressure - last_pressure) * direction > 0) {
      throw StateError(
          fmt::format("the isentrope does not reach {:.6g} Pa: it turns at {:.6g} Pa, {:.6g} kg/m^3",
                      pressure, state.pressure, state.density));
    }
    if (!std::isfinite(state.pressure) || state.density > 1e9 * eos.reference_density()) {
      throw StateError(fmt::format("the isentrope does not reach {:.6g} Pa: it ends at {:.6g} kg/m^3",
                                   pressure, state.density));
    }
    if (state.density < 1e-9 * eos.reference_density()) {
      throw StateError(fmt::format(
          "the isentrope does not reach {:.6g} Pa above 1e-9 of the reference density", pressure));
    }
    last_pressure = state.pressure;
  }
}

Release release(const EquationOfState& eos, const State& start, double pressure) {
  const auto unloading = eos.unloading(start);
  const VapourDome* dome = unloading ? unloading->vapour_dome() : eos.vapour_dome();
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
  return {isentrope_at_pressure(eos, start, pressure), false};
}

}  // namespace whipple::eos
