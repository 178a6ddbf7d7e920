// SPDX-License-Identifier: BSD-3-Clause
// The equation of state that is simulated when it is asked, with a formula in the place of simulations: it is
// the formula's within the error that it states, asks for no more than it needs, and does not depend on who
// asks first.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

#include "eos/identities.hpp"
#include "eos/models/simulated_crystal.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double v_static = 1.12e-4, molar_mass = 0.0635, modulus = 1.4e11, exponent = 4.5;
constexpr double heat_capacity = 3.0 * 8.31446261815324 / molar_mass, anharmonic = 3e-3;

/// Murnaghan's cold curve, and gamma as a power of the volume, which no straight line is.
double cold_pressure(double v) { return modulus / exponent * (std::pow(v_static / v, exponent) - 1.0); }
double cold_energy(double v) {
  return modulus / exponent * (v * std::pow(v_static / v, exponent) / (exponent - 1.0) + v);
}
double gruneisen(double v) { return 2.0 * std::pow(v / v_static, 1.5); }
double exact_pressure(double v, double t) { return cold_pressure(v) + heat_capacity * gruneisen(v) * t / v; }

class FormulaSource final : public IsochoreSource {
 public:
  explicit FormulaSource(std::atomic<int>& asked, double broken_ratio = 0.0)
      : asked_(asked), broken_ratio_(broken_ratio) {}
  [[nodiscard]] double static_volume() const override { return v_static; }
  [[nodiscard]] double molar_mass() const override { return whipple::eos::molar_mass; }
  std::vector<SimulatedIsochore> isochores(std::span<const double> ratios) override {
    std::vector<SimulatedIsochore> found;
    for (const double ratio : ratios) {
      if (ratio == broken_ratio_) throw StateError("the crystal melted");
      ++asked_;
      const double v = ratio * v_static;
      SimulatedIsochore isochore{v, cold_pressure(v), cold_energy(v), {}};
      for (const double t : {300.0, 900.0, 1500.0}) {
        isochore.states.push_back(
            {t, exact_pressure(v, t), 1e7, cold_energy(v) + t * (heat_capacity + 0.5 * anharmonic * t), 1e3});
      }
      found.push_back(isochore);
    }
    return found;
  }

 private:
  std::atomic<int>& asked_;
  double broken_ratio_;
};

SimulatedConstants constants(double tolerance) {
  SimulatedConstants c;
  c.element = "Cu";
  c.potential = "formula";
  c.temperature = {300.0, 900.0, 1500.0};
  c.tolerance = tolerance;
  c.divisions = 6;
  return c;
}

struct Made {
  explicit Made(double tolerance, double broken_ratio = 0.0)
      : eos(constants(tolerance), std::make_unique<FormulaSource>(asked, broken_ratio)) {}
  std::atomic<int> asked = 0;
  SimulatedCrystal eos;
};

TEST(SimulatedCrystal, IsTheFormulaWithinItsOwnEstimate) {
  double former = 0.0;
  int former_asked = 0;
  for (const double tolerance : {5e8, 2e7}) {
    Made made(tolerance);
    double largest = 0.0;
    for (double ratio = 0.751; ratio < 1.049; ratio += 0.003) {
      for (const double t : {0.0, 293.0, 800.0, 1500.0}) {
        const double v = ratio * v_static;
        const State state = made.eos.state_at_temperature(1.0 / v, t);
        const double error = std::abs(state.pressure - exact_pressure(v, t));
        EXPECT_LE(error, 1.05 * made.eos.pressure_error(1.0 / v)) << ratio << " " << t;
        EXPECT_LE(made.eos.pressure_error(1.0 / v), tolerance);
        largest = std::fmax(largest, error);
      }
    }
    EXPECT_GT(largest, 1e-3 * tolerance) << "the estimate is not idle";
    if (former > 0.0) {
      EXPECT_LT(largest, 0.5 * former);
      EXPECT_GT(made.asked, former_asked);
    }
    former = largest;
    former_asked = made.asked;
  }
}

TEST(SimulatedCrystal, ObeysTheIdentities) {
  const Made made(5e8);
  for (const double ratio : {0.78, 0.83, 0.93, 1.02}) {
    for (const double t : {200.0, 1000.0}) {
      const State state = made.eos.state_at_temperature(1.0 / (ratio * v_static), t);
      EXPECT_LT(check_identities(made.eos, state.density, state.specific_internal_energy).largest(), 1e-7)
          << ratio << " " << t;
    }
  }
  const State rest = made.eos.state(made.eos.reference_density(), made.eos.reference_energy());
  EXPECT_NEAR(rest.pressure, 0.0, 1e-9 * modulus);
  EXPECT_NEAR(rest.temperature, 293.0, 1e-6);
}

std::vector<double> pressures(const SimulatedCrystal& eos, const std::vector<double>& ratios) {
  std::vector<double> density, energy, p(ratios.size()), t(ratios.size()), c(ratios.size());
  for (const double ratio : ratios) {
    density.push_back(1.0 / (ratio * v_static));
    energy.push_back(2e5);
  }
  eos.evaluate({density, energy, p, t, c, {}, {}});
  return p;
}

// Only the intervals that are touched, and the same bits in any order and from any number of threads.
TEST(SimulatedCrystal, SimulatesWhatIsAskedForOnceAndInAnyOrder) {
  Made first(5e8);
  const int at_rest = first.asked;
  EXPECT_LE(at_rest, 3) << "0.95, 1 and 1.05 hold the reference state";
  const std::vector<double> ratios = {0.99, 0.93, 0.88, 0.87, 0.8, 0.97};
  const std::vector<double> expected = pressures(first.eos, ratios);
  const int asked = first.asked;
  pressures(first.eos, ratios);
  EXPECT_EQ(first.asked, asked) << "known states cost nothing";

  Made second(5e8);
  std::vector<double> backwards(ratios.rbegin(), ratios.rend());
  std::vector<double> result = pressures(second.eos, backwards);
  std::reverse(result.begin(), result.end());
  EXPECT_EQ(result, expected);

  Made third(5e8);
  std::vector<std::vector<double>> results(4);
  std::vector<std::thread> threads;
  for (std::vector<double>& mine : results) {
    threads.emplace_back([&third, &mine, &ratios] { mine = pressures(third.eos, ratios); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& mine : results) EXPECT_EQ(mine, expected);
  EXPECT_EQ(third.asked, asked);
}

TEST(SimulatedCrystal, RefusesWhatItCannotKnow) {
  const Made made(5e8, 0.8);
  const auto report = [&](double ratio, double energy) {
    const std::vector<double> density = {1.0 / (ratio * v_static)};
    const std::vector<double> energies = {energy};
    std::vector<double> p(1), t(1), c(1);
    return made.eos.evaluate({density, energies, p, t, c, {}, {}});
  };
  EXPECT_EQ(report(0.99, 1e5).out_of_range, 0u);
  EXPECT_EQ(report(0.7, 1e5).bound, "volume outside of the range that may be simulated");
  EXPECT_EQ(report(0.99, 5e6).bound, "hotter than the temperatures that may be simulated");
  EXPECT_EQ(report(0.99, -1e7).below_cold_curve, 1u);
  EXPECT_EQ(report(0.79, 1e6).bound, "the crystal melted");
  EXPECT_THROW(static_cast<void>(made.eos.state_at_temperature(1.0 / (0.79 * v_static), 300.0)), StateError);
  EXPECT_THROW(static_cast<void>(made.eos.state_at_temperature(1.0 / (0.99 * v_static), 1600.0)), StateError);
  // A tolerance that no division meets is an error with the figures, not a worse surface.
  SimulatedConstants strict = constants(1e5);
  strict.divisions = 1;
  std::atomic<int> asked = 0;
  EXPECT_THROW(SimulatedCrystal(strict, std::make_unique<FormulaSource>(asked)), StateError);
  SimulatedConstants uneven = constants(5e8);
  uneven.spacing = 0.07;
  EXPECT_THROW(SimulatedCrystal(uneven, std::make_unique<FormulaSource>(asked)), InputError);
}

// The seam through which a program brings what simulates: nothing without it, and the constants reach it.
TEST(SimulatedCrystal, IsBuiltOnTheRegisteredSource) {
  set_isochore_source({});
  EXPECT_THROW(simulated_crystal(constants(5e8)), InputError);
  std::atomic<int> asked = 0;
  std::string potential;
  set_isochore_source([&](const SimulatedConstants& c) {
    potential = c.potential;
    return std::make_unique<FormulaSource>(asked);
  });
  const std::unique_ptr<SimulatedCrystal> eos = simulated_crystal(constants(5e8));
  set_isochore_source({});
  EXPECT_EQ(potential, "formula");
  EXPECT_EQ(eos->reference_density(), Made(5e8).eos.reference_density());
  EXPECT_GT(asked, 0);
}

}  // namespace
}  // namespace whipple::eos
