// SPDX-License-Identifier: BSD-3-Clause
// Porous and reflected Hugoniots, impedance matches, cold curve and thresholds, against closed forms and
// against figures of docs/theory/gray.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using ::testing::HasSubstr;

template <class Function>
std::string message_of(const Function& function) {
  try {
    static_cast<void>(function());
  } catch (const StateError& error) {
    return error.what();
  }
  return "no error";
}

/// p_H and B of Mie-Grueneisen material with rho Gamma constant (docs/theory/equations_of_state.md, M1, M2).
struct ClosedForm {
  MieGruneisenConstants c = aluminium_2024();
  double V0 = 1 / c.reference_density;
  double B = c.gruneisen * c.reference_density;
  [[nodiscard]] double hugoniot(double V) const {
    const double eta = 1 - V / V0;
    return c.hugoniot_intercept * c.hugoniot_intercept * eta / (V0 * std::pow(1 - c.hugoniot_slope * eta, 2));
  }
  /// p at e = 0
  [[nodiscard]] double cold(double V) const { return hugoniot(V) * (1 - 0.5 * B * (V0 - V)); }
};

TEST(EosPorousHugoniot, IsTheClosedFormOfMieGruneisen) {
  // p = A + B e with e = p (V00 - V)/2: p = A(V)/[1 - B (V00 - V)/2].
  const ClosedForm exact;
  const MieGruneisenEos eos(exact.c);
  for (const double distension : {1.05, 1.3, 1.7, 2.5}) {
    const Hugoniot hugoniot = Hugoniot::porous(eos, exact.c.reference_density / distension);
    for (const double V : {0.95 * exact.V0, 0.85 * exact.V0, 0.75 * exact.V0}) {
      const double swept = distension * exact.V0 - V, factor = 1 - 0.5 * exact.B * swept;
      if (factor < 0.05) continue;  // beyond the greatest compression of a shock from this density
      const double p = exact.cold(V) / factor, up = std::sqrt(p * swept);
      const ShockState s = hugoniot.at_particle_velocity(up);
      EXPECT_NEAR(s.state.density * V, 1.0, 1e-8) << distension;
      EXPECT_NEAR(s.state.pressure / p, 1.0, 1e-8) << distension;
      EXPECT_NEAR(s.shock_velocity / (distension * exact.V0 * p / up), 1.0, 1e-8) << distension;
      EXPECT_NEAR(hugoniot.at_pressure(p).state.density * V, 1.0, 1e-8) << distension;
      EXPECT_NEAR(hugoniot.at_density(1 / V).state.pressure / p, 1.0, 1e-8) << distension;
    }
    // No pressure closes the voids at no speed.
    EXPECT_EQ(hugoniot.at_particle_velocity(0).shock_velocity, 0.0);
  }
}

TEST(EosPorousHugoniot, IsHotterThanThePrincipalOneAndMelts) {
  const GrayEos eos(copper());
  const ShockState solid = Hugoniot(eos).at_pressure(60e9);
  const ShockState porous = Hugoniot::porous(eos, eos.reference_density() / 1.5).at_pressure(60e9);
  EXPECT_EQ(solid.state.melted_fraction, 0.0);
  EXPECT_EQ(porous.state.melted_fraction, 1.0);
  EXPECT_LT(porous.state.density, solid.state.density);
  const auto above = [&] { return Hugoniot::porous(eos, 1.01 * eos.reference_density()); };
  EXPECT_THAT(message_of(above), HasSubstr("below the reference density of model gray (8944.54 kg/m^3)"));
  // The greatest compression of any shock from this density: B (V00 - V)/2 = 1.
  const MieGruneisenEos aluminium(aluminium_2024());
  const auto dense = [&] { return Hugoniot::porous(aluminium, 2785 / 2.5).at_density(3000); };
  EXPECT_THAT(message_of(dense), HasSubstr("no shock compresses from 1114 to 3000 kg/m^3"));
}

TEST(EosReflectedHugoniot, IsTheClosedFormOfMieGruneisen) {
  // Second shock: p2 = A + B e2, e2 = e1 + (p1 + p2)(V1 - V2)/2, at rest behind: (p2 - p1)(V1 - V2) = up1^2.
  const ClosedForm exact;
  const MieGruneisenEos eos(exact.c);
  for (const double up : {200.0, 1000.0, 2500.0}) {
    const ShockState first = Hugoniot(eos).at_particle_velocity(up);
    const ShockState second = reflected_at_wall(eos, first);
    const double p1 = first.state.pressure, V1 = 1 / first.state.density, V = 1 / second.state.density;
    const double e1 = first.state.specific_internal_energy;
    const double p = (exact.cold(V) + exact.B * (e1 + 0.5 * p1 * (V1 - V))) / (1 - 0.5 * exact.B * (V1 - V));
    EXPECT_NEAR(second.state.pressure / p, 1.0, 1e-8) << up;
    EXPECT_NEAR((p - p1) * (V1 - V), up * up, 1e-7 * up * up);
    EXPECT_GT(p, 2 * p1);
  }
}

TEST(EosImpedance, SymmetricImpactHalvesTheVelocityAndTwoMetalsFollowTheQuadratic) {
  const MieGruneisenEos aluminium(aluminium_2024());
  MieGruneisenConstants lead = aluminium_2024();
  lead.reference_density = 11350;
  lead.hugoniot_intercept = 2092;
  lead.hugoniot_slope = 1.45;
  lead.heat_capacity = 124;
  const MieGruneisenEos soft(lead);
  const Hugoniot target(aluminium), flyer(soft);
  EXPECT_NEAR(match_impact(target, target, 3000).velocity, 1500, 1e-6);
  for (const double velocity : {50.0, 900.0, 5000.0}) {
    const ImpedanceMatch match = match_impact(flyer, target, velocity);
    // rho1 (c1 + s1 u) u = rho2 (c2 + s2 (v - u)) (v - u)
    const double a = 2785 * 1.338 - 11350 * 1.45;
    const double b = 2785 * 5328.0 + 11350 * (2092 + 2 * 1.45 * velocity);
    const double c = -11350 * (2092 + 1.45 * velocity) * velocity;
    const double u = 2 * -c / (b + std::sqrt(b * b - 4 * a * c));
    EXPECT_NEAR(match.velocity, u, 1e-8 * u);
    EXPECT_NEAR(match.pressure, 2785 * (5328 + 1.338 * u) * u, 1e-7 * match.pressure);
    EXPECT_NEAR(match.left.pressure, match.right.pressure, 1e-7 * match.pressure);
    EXPECT_NEAR(match.left_shock_velocity, 2092 + 1.45 * (velocity - u), 1e-6 * match.left_shock_velocity);
  }
}

// A target under pressure pushes a slow impactor back: no interface between rest and the velocity of the impactor has one
// pressure on both sides.
TEST(EosImpedance, RefusesAnImpactWithoutAMatch) {
  const MieGruneisenEos metal(aluminium_2024());
  const double density = 1.05 * metal.reference_density();
  const Hugoniot compressed(metal, density, metal.reference_energy()), at_rest(metal);
  ASSERT_GT(compressed.initial().pressure, 3e9);
  EXPECT_THROW((void)match_impact(at_rest, compressed, 50.0), StateError);
  EXPECT_GT(match_impact(at_rest, compressed, 2000.0).pressure, compressed.initial().pressure);
}

TEST(EosImpedance, AShockEntersStifferAndSofterMatter) {
  const GrayEos metal(copper());
  const MieGruneisenEos light(aluminium_2024());
  // From aluminium into copper: reshocked, between one and two times the pressure.
  const ShockState in_light = Hugoniot(light).at_particle_velocity(2000);
  const ImpedanceMatch up = match_shock(light, in_light, Hugoniot(metal));
  EXPECT_GT(up.pressure, in_light.state.pressure);
  EXPECT_LT(up.pressure, reflected_at_wall(light, in_light).state.pressure);
  EXPECT_NEAR(up.left.pressure, up.right.pressure, 1e-7 * up.pressure);
  // Energy of the reshock: e2 - e1 = (p1 + p2)(V1 - V2)/2.
  EXPECT_NEAR(
      up.left.specific_internal_energy - in_light.state.specific_internal_energy,
      0.5 * (up.pressure + in_light.state.pressure) * (1 / in_light.state.density - 1 / up.left.density),
      1e-6 * up.left.specific_internal_energy);
  // From copper into aluminium: released at constant entropy, faster than before, slower than a free surface.
  const ShockState in_metal = Hugoniot(metal).at_particle_velocity(1500);
  const ImpedanceMatch down = match_shock(metal, in_metal, Hugoniot(light));
  EXPECT_LT(down.pressure, in_metal.state.pressure);
  EXPECT_NEAR(down.left.pressure, down.right.pressure, 1e-7 * down.pressure);
  EXPECT_NEAR(down.left.specific_entropy, in_metal.state.specific_entropy, 1e-5);
  EXPECT_GT(down.velocity, in_metal.particle_velocity);
  EXPECT_LT(down.velocity, free_surface_velocity(metal, in_metal));
  EXPECT_TRUE(std::isnan(down.left_shock_velocity));
  // Into itself: nothing comes back.
  const ImpedanceMatch same = match_shock(metal, in_metal, Hugoniot(metal));
  EXPECT_NEAR(same.pressure, in_metal.state.pressure, 1e-7 * same.pressure);
}

TEST(EosImpedance, FreeSurfaceOfAWeakShockMovesAtTwiceTheParticleVelocity) {
  const GrayEos eos(copper());
  for (const double up : {10.0, 100.0, 300.0}) {
    const ShockState s = Hugoniot(eos).at_particle_velocity(up);
    EXPECT_NEAR(free_surface_velocity(eos, s) / (2 * up), 1.0, 2e-3) << up;
  }
}

TEST(EosColdCurve, RestTensionAndCompressionOfCopper) {
  const GrayEos eos(copper());
  const ColdCurve curve = cold_curve(eos);
  EXPECT_NEAR(curve.at_rest.pressure, 0, 1e3);
  EXPECT_NEAR(curve.at_rest.temperature, eos.least_temperature(), 1e-9);
  EXPECT_GT(curve.at_rest.density, eos.reference_density());  // colder than 300 K
  EXPECT_LT(curve.at_rest.density, 1.02 * eos.reference_density());
  for (const double aside : {0.9, 0.999, 1.001, 1.1}) {
    EXPECT_GT(cold_state(eos, aside * curve.tension_limit.density).pressure, curve.tension_limit.pressure);
  }
  EXPECT_NEAR(curve.compression_limit.density / eos.maximum_density(), 1, 1e-6);
  EXPECT_GT(curve.compression_limit.pressure, 1e12);
  // Along an isotherm (of 1 K): rho^2 de/d(rho) = p - T (dp/dT)_V = p - T Gamma rho C_v.
  const double rho = 10000, h = 1;
  const State s = cold_state(eos, rho);
  const double slope = (cold_state(eos, rho + h).specific_internal_energy -
                        cold_state(eos, rho - h).specific_internal_energy) /
                       (2 * h);
  EXPECT_NEAR((slope * rho * rho + s.temperature * s.gruneisen * rho * s.heat_capacity) / s.pressure, 1.0,
              1e-6);
  // Evaporation takes the cohesive energy and R T, but for the difference of the heats of both phases (7 %).
  // (19 % below the 5.29 MJ/kg of copper: the vapour constant is chosen for the critical point.)
  const Saturation& coldest = eos.vapour_dome()->rows().front();
  const double gas = 8.314462618 / 63.546e-3;
  EXPECT_NEAR(curve.cohesive_energy / (coldest.latent_heat() - gas * coldest.temperature), 1.07, 0.01);
}

TEST(EosMelting, SolidusAndLiquidusOfCopper) {
  const GrayEos eos(copper());
  const double table[][3] = {
      {0, 1318.7, 1342.6}, {10e9, 1664, 1685}, {50e9, 2751, 2768}, {200e9, 5404, 5415}};
  for (const auto& row : table) {
    const auto melting = melting_point(eos, row[0]);
    ASSERT_TRUE(melting);
    EXPECT_NEAR(melting->solidus.temperature, row[1], 1) << row[0];
    EXPECT_NEAR(melting->liquidus.temperature, row[2], 1) << row[0];
    EXPECT_EQ(melting->solidus.melted_fraction, 0.0);
    EXPECT_EQ(melting->liquidus.melted_fraction, 1.0);
    EXPECT_NEAR(melting->liquidus.pressure, row[0], 1e3);
  }
  EXPECT_FALSE(melting_point(MieGruneisenEos(aluminium_2024()), 0.0));
}

TEST(EosThresholds, ReleaseMeltsAndVaporisesCopper) {
  const GrayEos eos(copper());
  // Melting in equilibrium on release: from 136.6 GPa, complete at 190.2 GPa.
  const ReleaseThresholds vacuum = release_thresholds(eos, 0);
  ASSERT_TRUE(vacuum.incipient_melting && vacuum.complete_melting);
  EXPECT_NEAR(vacuum.incipient_melting->state.pressure * 1e-9, 136.6, 1.4);
  EXPECT_NEAR(vacuum.complete_melting->state.pressure * 1e-9, 190.2, 1.9);
  EXPECT_FALSE(vacuum.incipient_vaporisation);  // liquid and vapour have no equilibrium at no pressure
  const ReleaseThresholds bar = release_thresholds(eos, 1e5);
  ASSERT_TRUE(bar.incipient_melting && bar.incipient_vaporisation);
  EXPECT_NEAR(bar.incipient_melting->state.pressure / vacuum.incipient_melting->state.pressure, 1, 1e-3);
  EXPECT_NEAR(bar.incipient_vaporisation->state.pressure * 1e-9, 302, 3);
  const ReleaseThresholds none = release_thresholds(MieGruneisenEos(aluminium_2024()), 0);
  EXPECT_FALSE(none.incipient_melting);
}

}  // namespace
}  // namespace whipple::eos::test
