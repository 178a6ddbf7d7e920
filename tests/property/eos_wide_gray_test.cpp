// SPDX-License-Identifier: BSD-3-Clause
// GRAY over a wide range (docs/theory/gray.md, section 12): electrons of Thomas and Fermi, cold curve of the electron
// gas, phases, identities, and measurements at terapascals.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "eos/identities.hpp"
#include "eos/models/atomic_units.hpp"
#include "eos/models/three_phase_model.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using WideEos = ModelEquationOfState<WideGray>;

WideGrayConstants wide_copper() {
  WideGrayConstants c;
  c.gray = copper(MeltingTransition::equilibrium);
  c.atomic_number = 29;
  return c;
}

/// Electrons of an element whose units are those of the series: Z = 1, SI values of bohr^3 and hartree.
struct AtomicUnits {
  ThomasFermiElectrons electrons{1.0, atomic::avogadro};  // one kilogram per atom
  double volume = atomic::bohr * atomic::bohr * atomic::bohr;
  double temperature = atomic::hartree / atomic::boltzmann;

  /// Entropy in units of k, pressure above that at T = 0 in atomic units.
  [[nodiscard]] std::array<double, 2> operator()(double V, double T) const {
    const FreeEnergyTerms f = electrons(V * volume, T * temperature);
    return {-f.F_T / atomic::boltzmann, -f.F_V * volume / atomic::hartree};
  }
};

// scripts/thomas_fermi.py --state V T, the pressure less that of T = 5e-5.
TEST(ThomasFermi, SeriesIsTheSolution) {
  struct Case {
    double V, T, entropy, pressure, cold;
  };
  const AtomicUnits atom;
  for (const Case& c : {Case{1456, 0.01, 0.77470173, 1.8079729e-6, 6.2609618e-7},
                        Case{200, 0.001, 0.030592704, 5.7216573e-5, 5.7170186e-5},
                        Case{3e4, 0.3, 8.3773504, 8.7344368e-6, 2.5487981e-10},
                        Case{5e5, 0.02, 3.8097069, 1.4024574e-8, 8.0865012e-13},
                        Case{60, 3, 6.1422626, 0.047643089, 7.0162794e-4}}) {
    const auto [S, P] = atom(c.V, c.T);
    EXPECT_NEAR(S, c.entropy, 3e-4 * c.entropy) << c.V << " " << c.T;
    EXPECT_NEAR(P - atom(c.V, 5e-5)[1], c.pressure - c.cold, 3e-3 * c.pressure) << c.V << " " << c.T;
  }
}

TEST(ThomasFermi, HotAndThinIsAnIdealGas) {
  const AtomicUnits atom;
  for (const double V : {1e6, 1e8, 1e11}) {  // beyond 2e6: continued
    const double T = 9.0;
    EXPECT_NEAR(atom(V, T)[1] * V / T, 1.0, 2e-3) << V;
  }
  // The continuation joins with its slopes, and its pressure is exactly that of a gas.
  EXPECT_NEAR(atom(2e6 * 0.999999, 0.1)[1], atom(2e6 * 1.000001, 0.1)[1], 1e-5 * atom(2e6, 0.1)[1]);
  EXPECT_NEAR(atom(4e6, 0.1)[1] * 4e6, atom(8e6, 0.1)[1] * 8e6, 1e-12);
}

TEST(ThomasFermi, DerivativesAreThoseOfTheFreeEnergy) {
  const ThomasFermiElectrons f(29, 63.546e-3);
  const auto slope = [](const auto& g, double step) {
    return (8 * (g(step) - g(-step)) - (g(2 * step) - g(-2 * step))) / (12 * step);
  };
  for (const double V : {2e-5, 1.1e-4, 8e-4, 0.02, 5.0}) {
    for (const double T : {1e4, 8e4, 1.2e6}) {
      const FreeEnergyTerms at = f(V, T);
      const double h = 1e-3 * V, d = 1e-3 * T;
      const auto near = [&](double exact, double difference, double scale) {
        EXPECT_NEAR(exact, difference, 1e-8 * std::abs(scale)) << V << " " << T;
      };
      near(at.F_V, slope([&](double s) { return f(V + s, T).F; }, h), at.F / V);
      near(at.F_T, slope([&](double s) { return f(V, T + s).F; }, d), at.F / T);
      near(at.F_VV, slope([&](double s) { return f(V + s, T).F_V; }, h), at.F / (V * V));
      near(at.F_VT, slope([&](double s) { return f(V, T + s).F_V; }, d), at.F / (V * T));
      near(at.F_TT, slope([&](double s) { return f(V, T + s).F_T; }, d), at.F / (T * T));
    }
  }
}

TEST(FermiColdCurve, JoinsAndEndsInTheElectronGas) {
  const double V0 = 1.118e-4, M = 63.546e-3, Z = 29;
  const FermiColdCurve::Join join{0.7 * V0, 1.2e6, 115e9, -2.2e16};
  const FermiColdCurve cold(Z, M, V0, 1e-9 * V0, join);
  const ColdPoint at = cold(join.volume);
  EXPECT_NEAR(at.energy, join.energy, 1e-9 * join.energy);
  EXPECT_NEAR(at.pressure, join.pressure, 1e-9 * join.pressure);
  EXPECT_NEAR(at.pressure_by_volume, join.pressure_by_volume, -1e-9 * join.pressure_by_volume);
  for (const double ratio : {0.01, 0.1, 0.3, 0.65}) {
    const double V = ratio * V0, h = 1e-4 * V;
    const auto slope = [&](double ColdPoint::* member) {
      return (8 * (cold(V + h).*member - cold(V - h).*member) -
              (cold(V + 2 * h).*member - cold(V - 2 * h).*member)) /
             (12 * h);
    };
    EXPECT_NEAR(slope(&ColdPoint::energy), -cold(V).pressure, 1e-6 * cold(V).pressure) << ratio;
    EXPECT_NEAR(slope(&ColdPoint::pressure), cold(V).pressure_by_volume, -1e-9 * cold(V).pressure_by_volume);
  }
  // P -> P_FG (1 - c1 X): electrons without interaction, then their energy with the nuclei and their exchange.
  const double V = 1e-9 * V0, X = 1e-3, n = Z * atomic::avogadro / (M * V0) * std::pow(atomic::bohr, 3);
  const double free = 0.2 * std::pow(3 * std::numbers::pi * std::numbers::pi, 2.0 / 3.0) *
                      std::pow(n, 5.0 / 3.0) * atomic::hartree / std::pow(atomic::bohr, 3);
  const double nuclei = 0.3 * Z * std::cbrt(4 * std::numbers::pi / (3 * Z)) * std::pow(n, 4.0 / 3.0);
  const double exchange = 0.25 * std::cbrt(3 / std::numbers::pi) * std::pow(n, 4.0 / 3.0);
  const double c1 = (nuclei + exchange) * atomic::hartree / std::pow(atomic::bohr, 3) / free;
  EXPECT_NEAR((1 - cold(V).pressure / (free * std::pow(X, -5))) / X, c1, 0.02 * c1);
  EXPECT_GT(c1, 3);
}

TEST(WideGray, IsGrayBelowTheOnsetAndTheJoin) {
  const WideEos wide(wide_copper());
  const GrayEos gray(copper(MeltingTransition::equilibrium));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 300; ++i) {
    const double rho =
        gray.reference_density() / std::exp(std::log(0.705) + uniform(random) * std::log(100.0));
    const double T = 60 * std::exp(uniform(random) * std::log(165.0));
    const State a = wide.state_at_temperature(rho, T), b = gray.state_at_temperature(rho, T);
    EXPECT_EQ(a.phase, b.phase) << rho << " " << T;
    EXPECT_NEAR(a.pressure, b.pressure, 1e-9 * (rho * b.sound_speed * b.sound_speed + 1e8))
        << rho << " " << T;
    // Mixtures: the same curve, tabulated over another range.
    EXPECT_NEAR(a.specific_internal_energy, b.specific_internal_energy, 1e-8 * 5e6);
    EXPECT_NEAR(a.specific_entropy, b.specific_entropy, 1e-7 * 1e3);
    EXPECT_NEAR(a.vaporised_fraction, b.vaporised_fraction, 1e-8);
  }
}

TEST(WideGray, IdentitiesHoldToTenfoldCompressionAndAHundredElectronvolts) {
  const WideEos eos(wide_copper());
  EXPECT_NEAR(eos.maximum_density(), 10 * eos.reference_density(), 1e-6 * eos.reference_density());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::map<std::string, int> states;
  for (int i = 0; i < 2000; ++i) {
    const double ratio = std::exp(std::log(0.101) + uniform(random) * std::log(100.0 / 0.101));
    const double rho = eos.reference_density() / ratio,
                 T = 200 * std::exp(uniform(random) * std::log(6000.0));
    const State s = eos.state_at_temperature(rho, T);
    if (std::abs(ratio - 0.7) < 2e-3) continue;  // the slope of the bulk modulus jumps
    IdentityDefects defects = check_identities(eos, rho, s.specific_internal_energy);
    // The fourth derivative by T jumps at the onset of the electrons.
    if (std::abs(T / 10000 - 1) < 0.02)
      defects = check_identities(eos, rho, s.specific_internal_energy, 1e-4);
    ++states[std::string(s.phase)];
    EXPECT_LT(defects.largest(), 1e-6) << s.phase << " V/V0 " << ratio << " T " << T;
    EXPECT_GT(s.heat_capacity, 0);
    EXPECT_NEAR(eos.state(rho, s.specific_internal_energy).temperature, T, 1e-9 * T);
  }
  for (const char* phase : {"solid", "liquid", "hot liquid", "vapour", "hot vapour"})
    EXPECT_GT(states[phase], 20) << phase;
}

// Beyond the end of equilibrium melting the solid melts at one temperature, without a jump of pressure at its edges.
TEST(WideGray, DenseSolidMeltsIsochorically) {
  const WideEos eos(wide_copper());
  const double end = eos.underlying().melting_curve().hottest().liquid_volume;
  ASSERT_GT(end * eos.maximum_density(), 1.0);
  const double V = 0.5 * (end + 1 / eos.maximum_density());
  const double T = eos.underlying().surfaces().isochoric_melting_temperature(V);
  const State solid = eos.state_at_temperature(1 / V, T * (1 - 1e-9));
  const State liquid = eos.state_at_temperature(1 / V, T * (1 + 1e-9));
  EXPECT_EQ(solid.phase, "solid");
  EXPECT_NE(liquid.phase, "solid");
  const double fusion = liquid.specific_internal_energy - solid.specific_internal_energy;
  EXPECT_NEAR(fusion, T * (liquid.specific_entropy - solid.specific_entropy), 1e-6 * fusion);
  for (const double share : {0.001, 0.5, 0.999}) {
    const State s = eos.state(1 / V, solid.specific_internal_energy + share * fusion);
    EXPECT_EQ(s.phase, "isochoric melting");
    EXPECT_NEAR(s.temperature, T, 1e-6 * T);
    EXPECT_NEAR(s.melted_fraction, share, 1e-5);
    EXPECT_NEAR(s.pressure, std::lerp(solid.pressure, liquid.pressure, share), 1e-6 * s.pressure);
  }
}

// Ramp compression of copper to 2.3 TPa and shocks of iron to 19 TPa: none of them entered the constants.
TEST(WideGray, FollowsMeasurementsAtTerapascals) {
  const WideEos cu(wide_copper());
  const State rest = cu.state_at_temperature(cu.reference_density(), 300);
  for (const auto& [pressure, density] :
       {std::array{494.6e9, 17518.0}, std::array{1012.8e9, 21211.0}, std::array{2308.2e9, 27033.0}}) {
    double low = 9000, high = 40000;  // on the isentrope
    while (high - low > 1) {
      const double rho = 0.5 * (low + high);
      double cold = 100, hot = 20000;
      while (hot - cold > 0.1) {
        const double T = 0.5 * (cold + hot);
        (cu.state_at_temperature(rho, T).specific_entropy > rest.specific_entropy ? hot : cold) = T;
      }
      (cu.state_at_temperature(rho, cold).pressure > pressure ? high : low) = rho;
    }
    EXPECT_NEAR(low, density, 0.03 * density) << pressure;
  }
}

std::string refusal(const WideGrayConstants& constants) {
  try {
    WideGray model(constants);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(WideGray, WrongConstantsAreRefusedByName) {
  WideGrayConstants c = wide_copper();
  c.cold_join_ratio = 0.3;
  EXPECT_NE(refusal(c).find("cold_join_ratio must be between"), std::string::npos) << refusal(c);
  c = wide_copper();
  c.electron_temperature = 12000;
  EXPECT_NE(refusal(c).find("electron_temperature more than 1.5 times"), std::string::npos) << refusal(c);
  c = wide_copper();
  c.electron_onset = 300;
  EXPECT_NE(refusal(c).find("electron_onset must be at least"), std::string::npos) << refusal(c);
  c = wide_copper();
  c.gray.melting = MeltingTransition::band;
  EXPECT_NE(refusal(c).find("melting must be \"equilibrium\""), std::string::npos) << refusal(c);
  const WideEos eos(wide_copper());
  EXPECT_THROW(static_cast<void>(eos.state_at_temperature(1.1 * eos.maximum_density(), 300)), StateError);
  EXPECT_THROW(static_cast<void>(eos.state_at_temperature(1000, 1e10)), StateError);
}

}  // namespace
}  // namespace whipple::eos::test
