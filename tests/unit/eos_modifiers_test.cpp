// SPDX-License-Identifier: BSD-3-Clause
// Modifiers around equations of state: identities, limits of porous compaction, composition, bad constants.
#include <gtest/gtest.h>

#include <cmath>

#include "eos/catalogue.hpp"
#include "eos/identities.hpp"
#include "eos/inversions.hpp"
#include "eos/loci/hugoniot.hpp"
#include "eos/loci/isentrope.hpp"
#include "eos/modifiers/floor.hpp"
#include "eos/modifiers/p_alpha.hpp"
#include "eos/modifiers/scale.hpp"
#include "eos/modifiers/shift.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using Shared = std::shared_ptr<const EquationOfState>;

Shared gray_copper() {
  static const Shared eos = std::make_shared<GrayEos>(copper());
  return eos;
}
Shared solid_copper() {
  static const Shared eos = std::make_shared<DebyeEos>(debye_copper());
  return eos;
}

/// Batch and single point say the same.
void expect_batch_agrees(const EquationOfState& eos, double density, double e) {
  const State s = eos.state(density, e);
  std::vector<double> rho(600, density), energy(600, e), P(600), T(600), c(600), melted(600), vapour(600);
  const RangeReport report = eos.evaluate({rho, energy, P, T, c, melted, vapour});
  EXPECT_EQ(report.out_of_range, 0u);
  for (std::size_t i : {0u, 255u, 256u, 599u}) {
    EXPECT_NEAR(P[i], s.pressure, 1e-9 * (std::abs(s.pressure) + 1e9));
    EXPECT_NEAR(T[i], s.temperature, 1e-9 * s.temperature);
    EXPECT_NEAR(c[i], s.sound_speed, 1e-9 * s.sound_speed);
    EXPECT_NEAR(melted[i], s.melted_fraction, 1e-12);
    EXPECT_NEAR(vapour[i], s.vaporised_fraction, 1e-12);
  }
}

// Ranks share particles out by it.
TEST(EosModifiers, PassTheCostOn) {
  EXPECT_GT(gray_copper()->relative_cost(), 1.0);
  EXPECT_EQ(Shift(gray_copper(), {.energy = 3e6}).relative_cost(), gray_copper()->relative_cost());
  const PAlpha porous(gray_copper(), {.distension = 1.4, .elastic_pressure = 1e8, .solid_pressure = 2e9});
  EXPECT_GT(porous.relative_cost(), gray_copper()->relative_cost());
}

TEST(EosModifiers, ShiftAndScaleKeepTheIdentities) {
  const Shift shift(gray_copper(), {.energy = 3e6});
  const Scale scale(gray_copper(), {.density = 65.0 / 63.546});
  for (const EquationOfState* eos :
       {static_cast<const EquationOfState*>(&shift), static_cast<const EquationOfState*>(&scale)}) {
    for (const auto& [ratio, T] :
         {std::pair{1.0, 300.0}, {0.8, 900.0}, {0.7, 9000.0}, {1.15, 4000.0}, {20.0, 9000.0}}) {
      const State s = eos->state_at_temperature(eos->reference_density() / ratio, T);
      const IdentityDefects d = check_identities(*eos, s.density, s.specific_internal_energy);
      EXPECT_LT(d.largest(), 1e-6) << ratio << " " << T << " " << s.phase;
      EXPECT_FALSE(std::isnan(d.sound_speed));
      EXPECT_NEAR(s.gibbs_energy,
                  s.specific_internal_energy - T * s.specific_entropy + s.pressure / s.density,
                  1e-6 * std::abs(s.gibbs_energy) + 1);
      expect_batch_agrees(*eos, s.density, s.specific_internal_energy);
    }
    const State rest = eos->state(eos->reference_density(), eos->reference_energy());
    EXPECT_NEAR(rest.pressure, 0, 1e5);
    EXPECT_NEAR(rest.temperature, eos->reference_temperature(), 1e-6 * 300);
    EXPECT_NEAR(eos->state(9000, eos->minimum_energy(9000)).temperature, 1.0, 1e-3);
  }
  EXPECT_EQ(shift.state(9500, 3.5e6).pressure, gray_copper()->state(9500, 5e5).pressure);
}

TEST(EosModifiers, ScaleKeepsTheHugoniotInScaledVelocities) {
  // At equal pressure both shocks compress alike: velocities scale with f^-1/2, since p = rho0 Us up.
  const double f = 1.1;
  const Scale heavy(solid_copper(), {.density = f});
  const ShockState a = Hugoniot(*solid_copper()).at_pressure(80e9), b = Hugoniot(heavy).at_pressure(80e9);
  EXPECT_NEAR(b.state.density / a.state.density, f, 1e-9);
  EXPECT_NEAR(b.shock_velocity / a.shock_velocity, 1 / std::sqrt(f), 1e-9);
  EXPECT_NEAR(b.particle_velocity / a.particle_velocity, 1 / std::sqrt(f), 1e-9);
  EXPECT_NEAR(b.state.temperature, a.state.temperature, 1e-6 * a.state.temperature);
}

TEST(EosModifiers, TheDomeMovesWithTheModifier) {
  const double f = 1.25;
  const Shift shift(gray_copper(), {.energy = 1e6});
  const Scale scale(gray_copper(), {.density = f});
  const auto plain = gray_copper()->vapour_dome()->at_temperature(3000);
  const auto shifted = shift.vapour_dome()->at_temperature(3000),
             scaled = scale.vapour_dome()->at_temperature(3000);
  ASSERT_TRUE(plain && shifted && scaled);
  EXPECT_NEAR(shifted->pressure / plain->pressure, 1.0, 1e-9);
  EXPECT_NEAR(shifted->liquid_energy - plain->liquid_energy, 1e6, 1e-3);
  EXPECT_NEAR(scaled->pressure / plain->pressure, 1.0, 1e-9);
  EXPECT_NEAR(scaled->vapour_volume * f / plain->vapour_volume, 1.0, 1e-7);
  EXPECT_NEAR(scaled->latent_heat() * f / plain->latent_heat(), 1.0, 1e-7);
  // Release of strongly shocked matter to 1 bar ends in the same mixture.
  const auto released = [](const EquationOfState& eos) {
    return release(eos, Hugoniot(eos).at_pressure(396e9).state, 1e5).end.state;
  };
  const State a = released(*gray_copper()), b = released(shift), c = released(scale);
  EXPECT_EQ(a.phase, "liquid and vapour");
  EXPECT_NEAR(b.vaporised_fraction, a.vaporised_fraction, 1e-6);
  EXPECT_NEAR(c.vaporised_fraction, a.vaporised_fraction, 1e-6);
  EXPECT_NEAR(b.specific_internal_energy - a.specific_internal_energy, 1e6, 10.0);
}

TEST(EosModifiers, FloorHoldsThePressureKeepsTheEnergyAndCounts) {
  const Floor eos(gray_copper(), {.pressure = -1e8});
  const double rho = 0.97 * 8945, e = 0;
  EXPECT_LT(gray_copper()->state(rho, e).pressure, -1e9);
  const State s = eos.state(rho, e);
  EXPECT_EQ(s.pressure, -1e8);
  EXPECT_EQ(s.specific_internal_energy, e);
  EXPECT_EQ(s.temperature, gray_copper()->state(rho, e).temperature);
  EXPECT_EQ(s.isothermal_bulk_modulus, 0.0);
  EXPECT_EQ(s.phase, "cavitated");
  EXPECT_GT(s.sound_speed, 0.0);
  expect_batch_agrees(eos, rho, e);
  expect_batch_agrees(eos, 9500, 5e5);
  std::vector<double> density = {rho, 9500, 0.96 * 8945}, energy = {0, 5e5, 0}, P(3), T(3), c(3);
  EXPECT_EQ(eos.evaluate({density, energy, P, T, c, {}, {}}).at_pressure_floor, 2u);
  // Above the floor nothing changes, identities included.
  EXPECT_LT(check_identities(eos, 9500, 5e5).largest(), 1e-6);
  EXPECT_THROW(Floor(gray_copper(), {.pressure = 1e9}), InputError);
}

PAlphaConstants pores() { return {.distension = 1.4, .elastic_pressure = 1e8, .solid_pressure = 2e9}; }

TEST(EosPAlpha, StartsPorousAtRestAndResistsUpToTheElasticPressure) {
  const PAlpha eos(solid_copper(), pores());
  EXPECT_NEAR(eos.reference_density() * 1.4, 8935, 1.0);
  const State rest = eos.state(eos.reference_density(), eos.reference_energy());
  EXPECT_NEAR(rest.pressure, 0, 1.0);
  EXPECT_EQ(rest.distension, 1.4);
  EXPECT_NEAR(rest.specific_internal_energy, 0, 1e-9);
  // Elastic: p = p_s(alpha0 rho)/alpha0, with the modulus K_s/alpha0; identities hold.
  const double rho = eos.reference_density() * (1 + 3e-4);
  const State elastic = eos.state(rho, 1.0);
  EXPECT_EQ(elastic.distension, 1.4);
  EXPECT_GT(elastic.pressure, 1e7);
  EXPECT_LT(elastic.pressure, 1e8);
  EXPECT_NEAR(elastic.pressure, solid_copper()->state(1.4 * rho, 1.0).pressure / 1.4, 1e-3);
  EXPECT_LT(check_identities(eos, rho, 30.0, 1e-5).largest(), 1e-3);
  expect_batch_agrees(eos, rho, 1.0);
}

TEST(EosPAlpha, FollowsTheCrushCurveOfBothKinds) {
  PAlphaConstants exponential = pores();
  exponential.compaction = CompactionCurve::exponential;
  exponential.solid_pressure = 0;
  exponential.compaction_rate = 2.54e-9;
  for (const PAlphaConstants& c : {pores(), exponential}) {
    const PAlpha eos(solid_copper(), c);
    double before = 1.4;
    for (double ratio = 1.0; ratio < 1.45; ratio += 0.003) {
      const State s = eos.state(eos.reference_density() * ratio, 2e4);
      // The pressure of the matrix, and the crush curve, at once.
      EXPECT_NEAR(s.pressure, solid_copper()->state(s.distension * s.density, 2e4).pressure / s.distension,
                  1e-7 * (std::abs(s.pressure) + 1e9));
      if (s.distension < 1.4) {
        EXPECT_NEAR(s.distension, eos.distension_at(s.pressure), 1e-9) << ratio;
        if (s.distension > 1) {
          EXPECT_NEAR(eos.crush_pressure(s.distension), s.pressure, 1e-6 * 2e9);
        }
      }
      EXPECT_LE(s.distension, before + 1e-12);
      before = s.distension;
      expect_batch_agrees(eos, s.density, 2e4);
      // The same state from its temperature.
      EXPECT_NEAR(eos.state_at_temperature(s.density, s.temperature).pressure, s.pressure,
                  1e-6 * (std::abs(s.pressure) + 1e9));
    }
    EXPECT_NEAR(before, 1.0, 1e-5);  // the exponential curve ends at 5.5 GPa
  }
}

TEST(EosPAlpha, CompactedHugoniotIsThatOfThePorousMatrix) {
  // Jump conditions see only the states: above p_s the shock from (rho00, e0, p = 0) ends on the surface of
  // the matrix, with e - e0 = p (V00 - V)/2.
  const PAlpha eos(solid_copper(), pores());
  const double rho00 = eos.reference_density();
  for (double p : {2.5e9, 10e9, 50e9, 100e9}) {
    const ShockState a = Hugoniot(eos).at_pressure(p),
                     b = Hugoniot::porous(*solid_copper(), rho00).at_pressure(p);
    EXPECT_EQ(a.state.distension, 1.0);
    EXPECT_NEAR(a.state.density / b.state.density, 1.0, 1e-9) << p;
    EXPECT_NEAR(a.shock_velocity / b.shock_velocity, 1.0, 1e-8) << p;
    EXPECT_NEAR(a.state.specific_internal_energy, 0.5 * p * (1 / rho00 - 1 / a.state.density),
                1e-9 * a.state.specific_internal_energy);
    // The pores make heat: hotter than the shock of the same pressure in the solid.
    EXPECT_GT(a.state.temperature, Hugoniot(*solid_copper()).at_pressure(p).state.temperature + 100);
  }
}

TEST(EosPAlpha, WeakPoresAreASnowPlough) {
  // Pores without strength in a nearly incompressible matrix: p = rho00 up^2/(1 - 1/alpha0).
  const PAlpha eos(solid_copper(), {.distension = 2.0, .elastic_pressure = 0, .solid_pressure = 1e6});
  for (double up : {60.0, 100.0}) {
    const ShockState s = Hugoniot(eos).at_particle_velocity(up);
    EXPECT_NEAR(s.state.pressure / (eos.reference_density() * up * up / 0.5), 1.0, 0.005) << up;
    EXPECT_NEAR(s.shock_velocity / (2 * up), 1.0, 0.005);
  }
}

TEST(EosPAlpha, PressedCopperOfBoade) {
  // Boade, J. Appl. Phys. 39, 5693 (1968): copper powder pressed to 6.4 g/cm^3, precursor of 1.4 kbar; shocks
  // up to 35 kbar follow alpha = 1 + (alpha1 - 1) exp[-0.254 (P/kbar - 1.4)]. The density behind the shock of
  // the model is that of cold solid copper at P over this alpha, less the expansion by the heat of the shock:
  // Gamma rho e/K = 1 % at 35 kbar.
  const double alpha0 = 8.935 / 6.4;
  const PAlpha eos(solid_copper(), {.distension = alpha0,
                                    .elastic_pressure = 1.4e8,
                                    .compaction = CompactionCurve::exponential,
                                    .compaction_rate = 2.54e-9});
  for (double kbar : {5.0, 10.0, 20.0, 35.0}) {
    const double published = 1 + (alpha0 - 1) * std::exp(-0.254 * (kbar - 1.4));
    const ShockState s = Hugoniot(eos).at_pressure(kbar * 1e8);
    const double solid = density_at_pressure(*solid_copper(), kbar * 1e8, 298);
    EXPECT_NEAR(s.state.density * published / solid, 1.0, 0.011) << kbar;
    EXPECT_LT(s.state.density * published / solid, 1.0);
  }
}

TEST(EosPAlpha, UnloadingKeepsTheDistension) {
  const PAlpha eos(solid_copper(), pores());
  // Half crushed, then released: along the matrix with fixed pores.
  const ShockState half = Hugoniot(eos).at_pressure(1e9);
  ASSERT_GT(half.state.distension, 1.01);
  ASSERT_LT(half.state.distension, 1.39);
  const Release r = release(eos, half.state, 0.0);
  EXPECT_NEAR(r.end.state.distension, half.state.distension, 1e-12);
  EXPECT_GT(r.end.state.density, 1.1 * eos.reference_density());
  EXPECT_NEAR(r.end.state.specific_entropy, half.state.specific_entropy,
              1e-6 * std::abs(half.state.specific_entropy));
  // Closed pores: the release of the matrix itself.
  const ShockState closed = Hugoniot(eos).at_pressure(20e9);
  EXPECT_NEAR(release(eos, closed.state, 0.0).end.state.density,
              release(*solid_copper(),
                      solid_copper()->state(closed.state.density, closed.state.specific_internal_energy), 0.0)
                  .end.state.density,
              1e-6 * 9000);
  // The batch: out of a crushed state, expanded again and again loaded to less than before.
  std::vector<double> rho = {1.25 * eos.reference_density()}, e = {2e4}, P(1), T(1), c(1), alpha = {1.4};
  const auto step = [&](double density) {
    rho[0] = density;
    EXPECT_EQ(eos.evaluate({rho, e, P, T, c, {}, {}, alpha}).out_of_range, 0u);
  };
  step(rho[0]);
  const double crushed = alpha[0], pressure = P[0];
  EXPECT_LT(crushed, 1.2);
  step(rho[0] * 0.995);
  EXPECT_EQ(alpha[0], crushed);
  EXPECT_LT(P[0], pressure);
  step(rho[0] * 1.004);
  EXPECT_EQ(alpha[0], crushed);
  step(rho[0] * 1.02);
  EXPECT_LT(alpha[0], crushed);
}

TEST(EosPAlpha, EnergyOfACrushingCycleIsTheWorkDone) {
  // de = p dV/..., integrated with the batch and the distension carried along: the heat left after compaction
  // and release to p = 0 is the area of the loop, and positive.
  const PAlpha eos(solid_copper(), pores());
  double V = 1 / eos.reference_density(), work = 0;
  std::vector<double> rho(1), e = {0.0}, P(1), T(1), c(1), alpha = {1.4};
  const auto pressure = [&](double volume) {
    rho[0] = 1 / volume;
    static_cast<void>(eos.evaluate({rho, e, P, T, c, {}, {}, alpha}));
    return P[0];
  };
  double p = pressure(V);
  const double last = V / 1.42;
  const int steps = 20000;
  const auto go = [&](double to) {
    const double dV = (to - V) / steps;
    for (int i = 0; i < steps; ++i) {
      const double old = p;
      V += dV;
      e[0] -= old * dV;
      p = pressure(V);
      e[0] += 0.5 * (old - p) * dV;  // trapezoid
      work -= 0.5 * (old + p) * dV;
      if (dV > 0 && p <= 0) break;
    }
  };
  go(last);
  EXPECT_EQ(alpha[0], 1.0);
  EXPECT_GT(p, 2e9);
  go(1 / 8000.0);
  EXPECT_NEAR(e[0], work, 1e-9 * work);
  EXPECT_GT(e[0], 1e4);
  EXPECT_NEAR(T[0], solid_copper()->state(1 / V, e[0]).temperature, 1e-6);
  EXPECT_GT(T[0], 320.0);
}

TEST(EosModifiers, ComposeInOrder) {
  const Shared porous = std::make_shared<PAlpha>(gray_copper(), pores());
  const Shift both(std::make_shared<Scale>(porous, ScaleConstants{.density = 1.02}), {.energy = 5e5});
  EXPECT_EQ(both.model(), "gray");
  EXPECT_EQ(both.initial_distension(), 1.4);
  EXPECT_NEAR(both.reference_density(), 8945 * 1.02 / 1.4, 5.0);
  const double rho = 1.2 * both.reference_density();
  const State s = both.state(rho, 5e5 + 3e4), inside = porous->state(rho / 1.02, 3e4 * 1.02);
  EXPECT_EQ(s.pressure, inside.pressure);
  EXPECT_EQ(s.distension, inside.distension);
  EXPECT_EQ(s.phase, "compacting");
  expect_batch_agrees(both, rho, 5e5 + 3e4);
  const auto unloading = both.unloading(s);
  ASSERT_TRUE(unloading);
  EXPECT_NEAR(unloading->state(rho, 5e5 + 3e4).pressure, s.pressure, 1e-6 * s.pressure);
  // Provenance: the model, then one table for each modifier in the order of application.
  const std::string text = both.constants();
  const auto at = [&](const char* word) { return text.find(word); };
  EXPECT_LT(at("hugoniot_intercept"), at("model = \"p_alpha\""));
  EXPECT_LT(at("model = \"p_alpha\""), at("model = \"scale\""));
  EXPECT_LT(at("model = \"scale\""), at("model = \"shift\""));
  EXPECT_NE(at("energy = "), std::string::npos);
}

TEST(EosModifiers, PoresCostNothingWithoutPores) {
  EXPECT_EQ(gray_copper()->initial_distension(), 1.0);
  EXPECT_EQ(gray_copper()->unloading(gray_copper()->state(9000, 1e5)), nullptr);
  // A model without pores leaves the distension alone.
  std::vector<double> rho = {9000}, e = {1e5}, P(1), T(1), c(1), alpha = {0.5};
  static_cast<void>(gray_copper()->evaluate({rho, e, P, T, c, {}, {}, alpha}));
  EXPECT_EQ(alpha[0], 0.5);
}

TEST(EosPAlpha, OutOfRangeIsReportedAndConstantsAreChecked) {
  const PAlpha eos(solid_copper(), pores());
  std::vector<double> rho = {7000, 60000, 7000}, e = {0, 0, std::nan("")}, P(3), T(3), c(3),
                      alpha = {1.4, 1.4, 1.4};
  const RangeReport report = eos.evaluate({rho, e, P, T, c, {}, {}, alpha});
  EXPECT_EQ(report.out_of_range, 2u);
  EXPECT_EQ(report.first, 1u);
  EXPECT_FALSE(report.bound.empty());
  EXPECT_FALSE(std::isnan(P[0]));
  EXPECT_THROW(static_cast<void>(eos.state(60000, 0)), StateError);
  // Compression beyond the matrix with open pores, within it with closed ones: closed at once.
  EXPECT_EQ(eos.state(40000, 1e8).distension, 1.0);
  const auto refused = [](PAlphaConstants wrong) { EXPECT_THROW(PAlpha(solid_copper(), wrong), InputError); };
  refused({.distension = 0.9, .elastic_pressure = 1e8, .solid_pressure = 2e9});
  refused({.distension = 1.4, .elastic_pressure = 3e9, .solid_pressure = 2e9});
  refused({.distension = 1.4, .elastic_pressure = 1e8, .solid_pressure = 2e9, .compaction_rate = 1e-9});
  refused({.distension = 1.4, .elastic_pressure = 1e8, .compaction = CompactionCurve::exponential});
  refused({.distension = 1.4,
           .elastic_pressure = 1e8,
           .compaction = CompactionCurve::exponential,
           .solid_pressure = 1e9,
           .compaction_rate = 1e-9});
  EXPECT_THROW(PAlpha(std::make_shared<PAlpha>(solid_copper(), pores()), pores()), InputError);
  for (const ModifierEntry& entry : modifier_catalogue())
    EXPECT_FALSE(entry.describe().empty()) << entry.name;
  EXPECT_EQ(modifier_catalogue().size(), 4u);
}

}  // namespace
}  // namespace whipple::eos::test
