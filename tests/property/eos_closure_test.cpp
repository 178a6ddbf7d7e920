// SPDX-License-Identifier: BSD-3-Clause
// Pressure-temperature equilibrium of mixtures: pure states, random states of metals through melting, gas and
// metal, identities of the mixture by finite differences.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "eos/closure.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

/// Air as an ideal gas with constant heat capacity, written out here to be independent of the library.
class Gas final : public EquationOfState {
 public:
  static constexpr double R = 287.05, cv = 717.6;
  [[nodiscard]] std::string_view model() const override { return "gas of the test"; }
  [[nodiscard]] double reference_density() const override { return 1e5 / (R * 300); }
  [[nodiscard]] double reference_temperature() const override { return 300; }
  [[nodiscard]] double reference_energy() const override { return cv * 300; }
  [[nodiscard]] double maximum_density() const override { return 1e4; }
  [[nodiscard]] double minimum_energy(double) const override { return cv; }
  [[nodiscard]] double least_temperature() const override { return 1; }
  RangeReport evaluate(const Batch&) const override { return {}; }
  [[nodiscard]] State state(double density, double e) const override {
    if (!(density > 0 && density <= maximum_density() && e > 0)) throw StateError("gas out of range");
    State s;
    s.density = density;
    s.specific_internal_energy = e;
    s.temperature = e / cv;
    s.pressure = density * R * s.temperature;
    s.heat_capacity = cv;
    s.gruneisen = R / cv;
    s.isothermal_bulk_modulus = s.pressure;
    s.sound_speed = std::sqrt((1 + R / cv) * R * s.temperature);
    s.specific_entropy = cv * std::log(s.temperature / 300) - R * std::log(density / reference_density());
    s.phase = "gas";
    derive(s);
    return s;
  }
  [[nodiscard]] State state_at_temperature(double density, double T) const override {
    return state(density, cv * T);
  }
  [[nodiscard]] std::string constants() const override { return ""; }
};

void expect_equilibrium(const Mixture& m, std::span<const Component> parts, double density, double e) {
  double V = 0, energy = 0, scale = std::abs(e), volume_fraction = 0, softest = INFINITY, stiffest = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const State& s = m.components[i];
    // The states are those of the models, not of the solver.
    const State again = parts[i].eos->state(s.density, s.specific_internal_energy);
    EXPECT_EQ(again.pressure, s.pressure);
    EXPECT_EQ(again.temperature, s.temperature);
    V += parts[i].mass_fraction / s.density;
    energy += parts[i].mass_fraction * s.specific_internal_energy;
    scale += std::abs(s.specific_internal_energy);
    volume_fraction += m.volume_fractions[i];
    softest = std::min(softest, s.density * s.sound_speed * s.sound_speed);
    stiffest = std::max(stiffest, s.density * s.sound_speed * s.sound_speed);
  }
  for (const State& s : m.components) {
    // The second term is what the last digits of a metal's volume mean beside a gas.
    EXPECT_LT(std::abs(s.pressure - m.state.pressure),
              1e-8 * (std::abs(m.state.pressure) + softest) + 1e-14 * stiffest);
    EXPECT_LT(std::abs(s.temperature - m.state.temperature), 1e-8 * m.state.temperature);
  }
  EXPECT_NEAR(V * density, 1.0, 1e-12);
  EXPECT_NEAR(energy, e, 1e-12 * scale);
  EXPECT_NEAR(volume_fraction, 1.0, 1e-12);
}

struct Statistics {
  int solved = 0, failed = 0, beyond_spinodal = 0;
  std::map<std::string, int> phases;
};

/// Random states of a binary mixture between the energies of two temperatures at equal compression.
Statistics sample(const EquationOfState& a, const EquationOfState& b, double least_ratio,
                  double greatest_ratio, double hottest, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  Statistics result;
  for (int i = 0; i < count; ++i) {
    const double x = 0.02 + 0.96 * uniform(random);
    const Component parts[] = {{&a, x}, {&b, 1 - x}};
    const double ratio = least_ratio * std::pow(greatest_ratio / least_ratio, uniform(random));
    const double density = 1 / (ratio * (x / a.reference_density() + (1 - x) / b.reference_density()));
    const auto energy = [&](double T) {
      return x * a.state_at_temperature(a.reference_density() / ratio, T).specific_internal_energy +
             (1 - x) * b.state_at_temperature(b.reference_density() / ratio, T).specific_internal_energy;
    };
    const double e = energy(200) + std::pow(uniform(random), 2) * (energy(hottest) - energy(200));
    try {
      const Mixture m = mixture_at_energy(parts, density, e);
      expect_equilibrium(m, parts, density, e);
      ++result.solved;
      ++result.phases[std::string(m.components[0].phase) + "+" + std::string(m.components[1].phase)];
    } catch (const StateError& fault) {
      ++result.failed;
      if (std::string(fault.what()).find("beyond its spinodal") != std::string::npos)
        ++result.beyond_spinodal;
    }
  }
  return result;
}

TEST(EosClosure, TwoIdenticalMaterialsAreThePureStateInEveryPhase) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const MeltingTransition melting : {MeltingTransition::band, MeltingTransition::isochoric}) {
    const GrayEos eos(copper(melting));
    std::map<std::string, int> phases;
    for (int i = 0; i < 3000; ++i) {
      const double x = 0.02 + 0.96 * uniform(random), density = 8945 / (0.5 + 0.55 * uniform(random));
      const double e = eos.minimum_energy(density) + 1e4 + 4e6 * uniform(random);
      const State pure = eos.state(density, e);
      if (pure.isothermal_bulk_modulus <= 0 && pure.melted_fraction == 0) continue;
      const Component parts[] = {{&eos, x}, {&eos, 1 - x}};
      const Mixture m = mixture_at_energy(parts, density, e);
      ++phases[std::string(m.state.phase)];
      ASSERT_NEAR(m.state.pressure, pure.pressure, 1e-8 * (std::abs(pure.pressure) + 1.3e11)) << pure.phase;
      ASSERT_NEAR(m.state.temperature, pure.temperature, 1e-8 * pure.temperature);
      ASSERT_NEAR(m.state.sound_speed, pure.sound_speed, 1e-6 * pure.sound_speed) << pure.phase;
      ASSERT_NEAR(m.state.gruneisen, pure.gruneisen, 1e-6 * pure.gruneisen) << pure.phase;
      ASSERT_NEAR(m.state.specific_entropy, pure.specific_entropy, 1e-6 * std::abs(pure.specific_entropy));
      ASSERT_NEAR(m.volume_fractions[0], x, 1e-7);
    }
    for (const char* phase : {"solid", "melting", "liquid"}) EXPECT_GT(phases[phase], 100) << phase;
  }
}

TEST(EosClosure, CopperAndAluminiumThroughMelting) {
  for (const MeltingTransition melting : {MeltingTransition::band, MeltingTransition::isochoric}) {
    GrayConstants al = aluminium();
    al.melting = melting;
    const GrayEos copper_eos(copper(melting)), aluminium_eos(al);
    const Statistics s = sample(copper_eos, aluminium_eos, 0.55, 1.05, 15000, 6000);
    EXPECT_EQ(s.failed, 0) << word_of(melting);
    int melts = 0;
    for (const auto& [phases, states] : s.phases)
      melts += phases.find("melting") != std::string::npos ? states : 0;
    EXPECT_GT(melts, 200) << word_of(melting);
  }
}

TEST(EosClosure, ExpandedMetalsNearAndBeyondTheSpinodal) {
  // In a van der Waals loop one component may have to part into liquid and vapour: no equilibrium of single
  // states is stable then, which is said. Everything else is found.
  const GrayEos copper_eos(copper()), aluminium_eos(aluminium());
  const Statistics tension = sample(copper_eos, aluminium_eos, 1.05, 1.2, 15000, 1000);
  const Statistics loop = sample(copper_eos, aluminium_eos, 1.2, 10, 15000, 300);
  const Statistics thin = sample(copper_eos, aluminium_eos, 20, 1000, 30000, 300);
  EXPECT_LE(tension.failed, 15);
  EXPECT_LE(loop.failed, 55);
  EXPECT_EQ(thin.failed, 0);
  for (const Statistics* s : {&tension, &loop}) EXPECT_EQ(s->failed, s->beyond_spinodal);
}

TEST(EosClosure, SolidsOfOtherModels) {
  const DebyeEos copper_eos(debye_copper());
  const MieGruneisenEos aluminium_eos(aluminium_2024());
  const Statistics s = sample(copper_eos, aluminium_eos, 0.65, 1.05, 5000, 2000);
  EXPECT_EQ(s.failed, 0);
}

TEST(EosClosure, GasAndMetalComeBackFromTheirPressureAndTemperature) {
  // Volume fractions of the gas from 1e-4 to nearly 1, pressures from 1 kPa to 1 GPa.
  const Gas gas;
  const GrayEos metal(copper());
  const DebyeEos solid(debye_aluminium());
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  int solved = 0;
  double least = 1, greatest = 0;
  for (int i = 0; i < 2000; ++i) {
    const double p = 1e3 * std::pow(1e6, uniform(random)), T = 200 * std::pow(12.0, uniform(random));
    const EquationOfState& other = i % 2 == 0 ? static_cast<const EquationOfState&>(metal) : solid;
    if (p / (Gas::R * T) > 1e3) continue;
    const double x = std::pow(10.0, -8 + 7.9 * uniform(random));
    const Component parts[] = {{&gas, x}, {&other, 1 - x}};
    const Mixture there = mixture_at_pressure_and_temperature(parts, p, T);
    if (there.components[1].phase == "melting") continue;
    const Mixture back = mixture_at_energy(parts, there.state.density, there.state.specific_internal_energy);
    expect_equilibrium(back, parts, there.state.density, there.state.specific_internal_energy);
    // Volume and energy are known to 1e-13 of their sizes: a small gas fraction leaves its pressure
    // uncertain.
    const double known = 1e-7 + 1e-12 / there.volume_fractions[0] + 1e-3 / p;
    EXPECT_NEAR(back.state.pressure / p, 1.0, known) << p << " " << T << " " << x;
    EXPECT_NEAR(back.state.temperature / T, 1.0, known);
    EXPECT_NEAR(back.state.sound_speed / there.state.sound_speed, 1.0, known);
    least = std::min(least, back.volume_fractions[0]);
    greatest = std::max(greatest, back.volume_fractions[0]);
    ++solved;
  }
  EXPECT_GT(solved, 1500);
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(greatest, 0.99);
}

TEST(EosClosure, SoundSpeedOfADilutedMetalFollowsWood) {
  // Wood (1930): 1/(rho c^2) = sum phi_i/(rho_i c_i^2) holds for equal pressure without heat exchange; with
  // common temperature the gas is isothermal, K = p, when the metal's heat capacity dominates.
  const Gas gas;
  const DebyeEos metal(debye_copper());
  const Component parts[] = {{&gas, 1e-6}, {&metal, 1 - 1e-6}};
  const Mixture m = mixture_at_pressure_and_temperature(parts, 1e5, 300);
  const double compliance =
      m.volume_fractions[0] / 1e5 + m.volume_fractions[1] / m.components[1].isentropic_bulk_modulus;
  EXPECT_NEAR(m.state.density * m.state.sound_speed * m.state.sound_speed * compliance, 1.0, 1e-4);
}

TEST(EosClosure, MixtureSatisfiesTheIdentities) {
  const GrayEos a(copper()), b(aluminium());
  const Gas gas;
  const Component three[] = {{&a, 0.5}, {&b, 0.4}, {&gas, 0.1}};
  const Component metals[] = {{&a, 0.6}, {&b, 0.4}};
  struct Case {
    std::span<const Component> parts;
    double p, T;
  };
  const Case cases[] = {{metals, 1e5, 300},    {metals, 20e9, 800}, {metals, 60e9, 2000},
                        {metals, 100e9, 9000}, {metals, 1e9, 3000}, {metals, 80e9, 6000},
                        {three, 1e5, 300},     {three, 1e8, 700},   {three, 1e7, 3000}};
  for (const Case& c : cases) {
    const Mixture m = mixture_at_pressure_and_temperature(c.parts, c.p, c.T);
    const double V = 1 / m.state.density, e = m.state.specific_internal_energy, h = 1e-4;
    const double dV = h * V, de = h * m.state.heat_capacity * c.T;
    const auto at = [&](double v, double energy) { return mixture_at_energy(c.parts, 1 / v, energy).state; };
    const State wider = at(V + dV, e), closer = at(V - dV, e), hotter = at(V, e + de), colder = at(V, e - de);
    const double P_V = (wider.pressure - closer.pressure) / (2 * dV),
                 P_e = (hotter.pressure - colder.pressure) / (2 * de);
    const double T_e = (hotter.temperature - colder.temperature) / (2 * de);
    const double T_V = (wider.temperature - closer.temperature) / (2 * dV);
    const double squared = V * V * (c.p * P_e - P_V);
    EXPECT_NEAR(m.state.sound_speed * m.state.sound_speed / squared, 1.0, 1e-5) << c.p << " " << c.T;
    EXPECT_NEAR(m.state.gruneisen / (V * P_e), 1.0, 1e-5) << c.p << " " << c.T;
    EXPECT_NEAR(m.state.heat_capacity * T_e, 1.0, 1e-5) << c.p << " " << c.T;
    EXPECT_NEAR(m.state.isothermal_bulk_modulus / (-V * (P_V - P_e * T_V / T_e)), 1.0, 1e-5) << c.p;
    // T ds = de + p dV
    EXPECT_NEAR(c.T * (hotter.specific_entropy - colder.specific_entropy) / (2 * de), 1.0, 1e-5);
    EXPECT_NEAR(
        c.T * (wider.specific_entropy - closer.specific_entropy) / (2 * dV * m.state.isentropic_bulk_modulus),
        c.p / m.state.isentropic_bulk_modulus, 1e-5);
  }
}

TEST(EosClosure, WhatHasNoSolutionSaysSo) {
  const GrayEos a(copper()), b(aluminium());
  const Component parts[] = {{&a, 0.5}, {&b, 0.5}};
  EXPECT_THROW(static_cast<void>(mixture_at_energy(parts, 1e5, 1e6)), StateError);    // beyond both
  EXPECT_THROW(static_cast<void>(mixture_at_energy(parts, 4154, -5e7)), StateError);  // colder than both
  EXPECT_THROW(static_cast<void>(mixture_at_energy(parts, -1, 1e5)), StateError);
  EXPECT_THROW(static_cast<void>(mixture_at_energy(parts, 4154, std::nan(""))), StateError);
  EXPECT_THROW(static_cast<void>(mixture_at_pressure_and_temperature(parts, -1e12, 300)), StateError);
  const Component wrong[] = {{&a, 0.5}, {&b, 0.4}}, negative[] = {{&a, 1.5}, {&b, -0.5}};
  EXPECT_THROW(static_cast<void>(mixture_at_energy(wrong, 4000, 1e5)), InputError);
  EXPECT_THROW(static_cast<void>(mixture_at_energy(negative, 4000, 1e5)), InputError);
  EXPECT_THROW(static_cast<void>(mixture_at_energy({}, 4000, 1e5)), InputError);
}

}  // namespace
}  // namespace whipple::eos::test
