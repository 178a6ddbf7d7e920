// SPDX-License-Identifier: BSD-3-Clause
// The Hugoniot search on a solid whose Hugoniot is known in closed form, exact and with noise of known size.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "md_fitting/protocols/hugoniot.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Mie-Grueneisen solid that has the straight line Us = C + S up as its Hugoniot, with a constant heat
/// capacity and rho Gamma constant. The Hugoniot itself and the temperature on it are known independently of
/// the search.
class LinearHugoniotSolid : public StateSource {
 public:
  static constexpr double v0 = 1.119e-4, c = 3940.0, s = 1.489, gruneisen = 1.97, cv = 392.0, t0 = 293.0,
                          e0 = -5.25e6;

  static double hugoniot_pressure(double v) {
    const double eta = 1.0 - v / v0;
    return c * c / v0 * eta / ((1.0 - s * eta) * (1.0 - s * eta));
  }
  static double hugoniot_energy(double v) { return e0 + 0.5 * hugoniot_pressure(v) * (v0 - v); }
  /// Integrates cv dT_H = dE_H + P dV - cv Gamma T/V dV along the Hugoniot.
  static double hugoniot_temperature(double v) {
    double t = t0;
    constexpr int steps = 20000;
    const double dv = (v - v0) / steps;
    const auto rate = [](double x, double temperature) {
      const double h = 1e-6 * v0;
      const double energy_slope = (hugoniot_energy(x + h) - hugoniot_energy(x - h)) / (2 * h);
      return (energy_slope + hugoniot_pressure(x)) / cv - temperature * gruneisen / v0;
    };
    for (int i = 0; i < steps; ++i) {
      const double x = v0 + i * dv;
      const double half = t + 0.5 * dv * rate(x, t);
      t += dv * rate(x + 0.5 * dv, half);
    }
    return t;
  }

  State state(double v, double t, Effort effort) override {
    ++calls;
    State result;
    const double energy = hugoniot_energy(v) + cv * (t - hugoniot_temperature(v));
    result.specific_internal_energy = {energy + noise_of(energy_noise, effort), energy_noise};
    result.pressure = {hugoniot_pressure(v) + gruneisen / v0 * (energy - hugoniot_energy(v)) +
                           noise_of(pressure_noise, effort),
                       pressure_noise};
    return result;
  }

  int calls = 0;
  double energy_noise = 0.0;
  double pressure_noise = 0.0;
  std::mt19937_64 generator{17};

 private:
  double noise_of(double sigma, Effort effort) {
    const double scale = effort == Effort::search ? 2.0 : 1.0;
    return scale * sigma * normal_(generator);
  }
  std::normal_distribution<double> normal_;
};

using Solid = LinearHugoniotSolid;

const ReferenceState at_rest{{Solid::v0, 0.0}, {Solid::e0, 0.0}, 0.0};

// The jump conditions must give back Us = C + S up, from good and from bad first guesses.
TEST(Hugoniot, FindsTheLineOfASolidThatHasOne) {
  for (const double ratio : {0.97, 0.9, 0.8, 0.7, 0.65}) {
    const double exact = Solid::hugoniot_temperature(ratio * Solid::v0);
    for (const double guess : {0.3 * exact, exact, 3.0 * exact}) {
      Solid solid;
      const HugoniotState state = solve_hugoniot(solid, at_rest, ratio * Solid::v0,
                                                 {.first_temperature = guess, .specific_heat = 392.0});
      EXPECT_NEAR(state.shock_velocity.value / (Solid::c + Solid::s * state.particle_velocity.value), 1.0,
                  1e-9);
      EXPECT_NEAR(state.temperature.value / exact, 1.0, 1e-6) << "V/V0 = " << ratio << ", guess " << guess;
      EXPECT_NEAR(state.pressure.value / Solid::hugoniot_pressure(ratio * Solid::v0), 1.0, 1e-9);
      EXPECT_LT(state.pressure.error, 1e-12 * state.pressure.value);  // rounding
      EXPECT_EQ(state.runs, solid.calls);
      EXPECT_LE(solid.calls, 6);
    }
  }
}

// With noise the results scatter by what is given as their error: neither more nor less.
TEST(Hugoniot, ErrorsDescribeTheScatter) {
  Solid solid;
  solid.energy_noise = 400.0;
  solid.pressure_noise = 2e7;
  const double v = 0.8 * Solid::v0;
  constexpr int trials = 400;
  double shock_chi = 0.0;
  double temperature_chi = 0.0;
  double pressure_chi = 0.0;
  for (int i = 0; i < trials; ++i) {
    const HugoniotState state =
        solve_hugoniot(solid, at_rest, v, {.first_temperature = 1000.0, .specific_heat = 392.0});
    const double pressure = Solid::hugoniot_pressure(v);
    const double shock = Solid::v0 * std::sqrt(pressure / (Solid::v0 - v));
    shock_chi += std::pow((state.shock_velocity.value - shock) / state.shock_velocity.error, 2) / trials;
    pressure_chi += std::pow((state.pressure.value - pressure) / state.pressure.error, 2) / trials;
    temperature_chi +=
        std::pow((state.temperature.value - Solid::hugoniot_temperature(v)) / state.temperature.error, 2) /
        trials;
  }
  // Mean of 400 squares of normal numbers: 1 +- 0.07; the slope of a noisy secant adds a little.
  EXPECT_NEAR(shock_chi, 1.0, 0.3);
  EXPECT_NEAR(pressure_chi, 1.0, 0.3);
  EXPECT_NEAR(temperature_chi, 1.0, 0.3);
}

// The uncertainty of the state before the shock is part of that behind it.
TEST(Hugoniot, ReferenceErrorsArriveInTheResult) {
  Solid solid;
  ReferenceState uncertain = at_rest;
  uncertain.specific_volume.error = 1e-4 * Solid::v0;
  const auto state =
      solve_hugoniot(solid, uncertain, 0.9 * Solid::v0, {.first_temperature = 500.0, .specific_heat = 392.0});
  EXPECT_GT(state.shock_velocity.error, 0.0);
  EXPECT_GT(state.particle_velocity.error, 0.0);
  ReferenceState shifted = at_rest;
  shifted.specific_volume.value *= 1.0001;
  Solid again;
  const auto moved =
      solve_hugoniot(again, shifted, 0.9 * Solid::v0, {.first_temperature = 500.0, .specific_heat = 392.0});
  EXPECT_NEAR(std::abs(moved.shock_velocity.value - state.shock_velocity.value) / state.shock_velocity.error,
              1.0, 0.05);
}

TEST(Hugoniot, SaysWhyThereIsNoState) {
  Solid solid;
  EXPECT_THROW(
      solve_hugoniot(solid, at_rest, 1.1 * Solid::v0, {.first_temperature = 300, .specific_heat = 392}),
      StateError);
  EXPECT_THROW(solve_hugoniot(solid, at_rest, 0.7 * Solid::v0,
                              {.first_temperature = 3e5, .specific_heat = 392, .most_runs = 2}),
               StateError);
}

}  // namespace
}  // namespace whipple::md
