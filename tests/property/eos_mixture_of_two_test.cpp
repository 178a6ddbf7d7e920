// SPDX-License-Identifier: BSD-3-Clause
// Batches of two materials at one pressure and temperature, at random states: next to the solver for single
// states, to differences of the solved mixtures, and at their edges.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "eos/closure.hpp"
#include "eos/mixture_of_two.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_impact_constants.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

const ModelEquationOfState<Jwl> products(comp_b());
const ModelEquationOfState<JwlReactant> reactant(comp_b_reactant());
const double store = products.reference_energy() - reactant.reference_energy();

struct Found {
  double pressure = 0, temperature = 0, sound_speed = 0;
  RangeReport report;
};
Found mixture(double density, double energy, double fraction) {
  Found found;
  found.report = MixtureOfTwo{reactant, products, store}.evaluate({{&density, 1},
                                                                   {&energy, 1},
                                                                   {&found.pressure, 1},
                                                                   {&found.temperature, 1},
                                                                   {&found.sound_speed, 1},
                                                                   {},
                                                                   {}},
                                                                  {&fraction, 1});
  return found;
}

/// States of an explosive that burns, from expanded products with a rest of it to what is shocked beyond the
/// detonation.
class MixtureOfTwoMaterials : public testing::Test {
 protected:
  struct Point {
    double density, energy, fraction;
  };
  /// Of states that are warmer than 50 K.
  Point random_point() {
    for (;;) {
      const Point at = any_point();
      if (mixture(at.density, at.energy, at.fraction).temperature > 50.0) return at;
    }
  }

 private:
  Point any_point() {
    const double fraction = std::pow(10.0, -6.0 + 6.0 * uniform_(random_)), x = std::min(fraction, 0.9999);
    const double v = x > 0.3 ? std::exp(std::log(0.65) + uniform_(random_) * std::log(5.0 / 0.65))
                             : 0.65 + 0.34 * uniform_(random_);
    return {comp_b().reference_density / v, store * (0.75 + 0.6 * uniform_(random_)), x};
  }

  std::mt19937 random_{11};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

TEST_F(MixtureOfTwoMaterials, IsWhatTheSolverOfSingleStatesFinds) {
  // The energies of the models count from zeros of their own: the shifted reactant is what the other solver
  // takes.
  class Shifted final : public EquationOfState {
   public:
    [[nodiscard]] std::string_view model() const override { return "shifted"; }
    [[nodiscard]] double reference_density() const override { return reactant.reference_density(); }
    [[nodiscard]] double reference_temperature() const override { return reactant.reference_temperature(); }
    [[nodiscard]] double reference_energy() const override { return store; }
    [[nodiscard]] double maximum_density() const override { return reactant.maximum_density(); }
    [[nodiscard]] double minimum_energy(double density) const override {
      return reactant.minimum_energy(density) + store;
    }
    [[nodiscard]] double least_temperature() const override { return 1.0; }
    RangeReport evaluate(const Batch&) const override { return {}; }
    [[nodiscard]] State state(double density, double e) const override {
      return with(reactant.state(density, e - store));
    }
    [[nodiscard]] State state_at_temperature(double density, double T) const override {
      return with(reactant.state_at_temperature(density, T));
    }
    [[nodiscard]] std::string constants() const override { return ""; }

   private:
    static State with(State state) {
      state.specific_internal_energy += store;
      derive(state);
      return state;
    }
  };
  const Shifted shifted;
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const Point at = random_point();
    const std::vector<Component> parts = {{&shifted, 1.0 - at.fraction}, {&products, at.fraction}};
    State expected;
    try {
      expected = mixture_at_energy(parts, at.density, at.energy).state;
    } catch (const StateError&) {
      continue;
    }
    const Found found = mixture(at.density, at.energy, at.fraction);
    ASSERT_EQ(found.report.out_of_range, 0u) << at.density << " " << at.energy << " " << at.fraction;
    EXPECT_NEAR(found.pressure, expected.pressure, 1e-6 * std::abs(expected.pressure) + 1e3)
        << at.density << " " << at.fraction;
    EXPECT_NEAR(found.temperature, expected.temperature, 1e-6 * expected.temperature);
    EXPECT_NEAR(found.sound_speed, expected.sound_speed, 1e-4 * expected.sound_speed);
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST_F(MixtureOfTwoMaterials, HasTheSoundSpeedOfItsOwnPressure) {
  for (int i = 0; i < 200; ++i) {
    const Point at = random_point();
    const double d = 1e-5 * at.density, e = 1e-5 * at.energy;
    const auto pressure = [&](double rho, double energy) {
      return mixture(rho, energy, at.fraction).pressure;
    };
    const Found found = mixture(at.density, at.energy, at.fraction);
    ASSERT_EQ(found.report.out_of_range, 0u);
    const double by_density =
        (pressure(at.density + d, at.energy) - pressure(at.density - d, at.energy)) / (2 * d);
    const double by_energy =
        (pressure(at.density, at.energy + e) - pressure(at.density, at.energy - e)) / (2 * e);
    const double squared = by_density + found.pressure / (at.density * at.density) * by_energy;
    EXPECT_NEAR(found.sound_speed * found.sound_speed, squared, 1e-4 * std::abs(squared) + 1e2)
        << at.density << " " << at.fraction;
  }
}

/// Specific volume (m^3/kg) and energy (J/kg, from the zero of the model) at a pressure and a temperature; the
/// densest, as cold reactant has a second state, that of a gas.
std::pair<double, double> at_pressure(const EquationOfState& model, double pressure, double temperature) {
  const auto below = [&](double density) {
    return model.state_at_temperature(density, temperature).pressure < pressure;
  };
  double upper = 0.9 * model.maximum_density(), lower = upper;
  while (!below(lower)) upper = std::exchange(lower, 0.97 * lower);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (lower + upper);
    (below(middle) ? lower : upper) = middle;
  }
  const State found = model.state_at_temperature(upper, temperature);
  return {1.0 / found.density, found.specific_internal_energy};
}

// Partly burnt explosive that a release has quenched: the products fill what the reactant, at next to no pressure,
// leaves of the volume. From pressure and temperature of both the mixture follows without a search.
TEST_F(MixtureOfTwoMaterials, HasThePressureAndTemperatureOfBothWhenItSpreads) {
  for (const double fraction : {1e-6, 1e-5, 1e-3, 0.02, 0.1, 0.3, 0.6, 0.95, 0.998}) {
    for (const double pressure : {1e5, 1e6, 1e7, 1e8, 1e9, 1e10}) {
      for (const double temperature : {250.0, 400.0, 1000.0, 2500.0, 4000.0}) {
        const auto [v1, e1] = at_pressure(reactant, pressure, temperature);
        const auto [v2, e2] = at_pressure(products, pressure, temperature);
        const double density = 1.0 / ((1.0 - fraction) * v1 + fraction * v2);
        const double energy = (1.0 - fraction) * (e1 + store) + fraction * e2;
        const Found found = mixture(density, energy, fraction);
        ASSERT_EQ(found.report.out_of_range, 0u) << fraction << " " << pressure << " " << temperature;
        EXPECT_NEAR(found.temperature, temperature, 1e-4 * temperature) << fraction << " " << pressure;
        EXPECT_NEAR(found.pressure, pressure, 1e-3 * pressure + 1e3) << fraction << " " << temperature;
        EXPECT_GT(found.sound_speed, 0.0) << fraction << " " << pressure << " " << temperature;
      }
    }
  }
}

TEST_F(MixtureOfTwoMaterials, EndsInEitherMaterial) {
  const double density = comp_b().reference_density / 0.75, energy = 1.1 * store;
  const State whole = reactant.state(density, energy - store), burnt = products.state(density, energy);
  EXPECT_NEAR(mixture(density, energy, 1e-6).pressure / whole.pressure, 1.0, 1e-4);
  EXPECT_NEAR(mixture(density, energy, 1.0 - 1e-7).pressure / burnt.pressure, 1.0, 1e-6);
  EXPECT_NEAR(mixture(density, energy, 1.0 - 1e-7).sound_speed / burnt.sound_speed, 1.0, 1e-5);
}

TEST_F(MixtureOfTwoMaterials, DoesNotDependOnTheOtherPointsOfABatch) {
  constexpr std::size_t n = 300;  // more than a chunk
  std::vector<double> density(n), energy(n), fraction(n), p(n), T(n), c(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point at = random_point();
    density[i] = at.density, energy[i] = at.energy, fraction[i] = at.fraction;
  }
  density[280] = 20.0 * comp_b().reference_density;  // no room
  const RangeReport report =
      MixtureOfTwo{reactant, products, store}.evaluate({density, energy, p, T, c, {}, {}}, fraction);
  EXPECT_EQ(report.out_of_range, 1u);
  EXPECT_EQ(report.first, 280u);
  EXPECT_NE(report.bound, "");
  for (std::size_t i = 0; i < n; ++i) {
    const Found alone = mixture(density[i], energy[i], fraction[i]);
    if (i == 280) {
      EXPECT_TRUE(std::isnan(p[i]) && std::isnan(T[i]) && std::isnan(c[i]));
      continue;
    }
    EXPECT_EQ(p[i], alone.pressure) << i;
    EXPECT_EQ(T[i], alone.temperature) << i;
    EXPECT_EQ(c[i], alone.sound_speed) << i;
  }
}

}  // namespace
}  // namespace whipple::eos::test
