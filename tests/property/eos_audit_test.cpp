// SPDX-License-Identifier: BSD-3-Clause
// The audit: every material of the library is usable, in milliseconds; constants that contradict physics are
// found, each by its own check.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "eos/audit.hpp"
#include "eos/loci/thresholds.hpp"
#include "eos/models/jwl.hpp"
#include "src/core/base/error.hpp"
#include "src/material/material_file.hpp"
#include "tests/unit/eos_impact_constants.hpp"
#include "tests/unit/eos_support.hpp"

namespace whipple::eos::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(EosAudit, LibraryIsUsableAndTheBriefFormIsQuick) {
  for (const LibraryMaterial& entry : library_materials()) {
    SCOPED_TRACE(entry.file.string());
    const Material material = read_material(entry.file);
    const auto start = std::chrono::steady_clock::now();
    const Audit brief = audit(*material.eos, AuditDepth::brief);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    RecordProperty(entry.file.stem().string() + "_ms", std::to_string(1e3 * seconds));
    EXPECT_NE(brief.verdict(), Verdict::not_usable) << brief.summary();
    EXPECT_LT(seconds, 0.3);  // some 1 ms; busy machines
    EXPECT_NO_THROW(require_usable(material));
  }
}

/// Constants of tetryl, its density in another unit: all identities hold, of an explosive that does not exist.
TEST(EosAudit, FindsExplosivesThatDoNotExist) {
  const auto tetryl = [](double density, double pressure_1, double exponent_1) {
    return JwlConstants{.reference_density = density,
                        .pressure_1 = pressure_1,
                        .pressure_2 = 10.671e9,
                        .exponent_1 = exponent_1,
                        .exponent_2 = 1.2,
                        .gruneisen = 0.28,
                        .detonation_energy = 8.2e9,
                        .heat_capacity = 578};
  };
  EXPECT_EQ(audit(ModelEquationOfState<Jwl>(tetryl(1730, 586.83e9, 4.4))).verdict(), Verdict::sound);
  const Audit dense = audit(ModelEquationOfState<Jwl>(tetryl(1.73e6, 586.83e9, 4.4)));
  EXPECT_EQ(dense.verdict(), Verdict::not_usable);
  EXPECT_THAT(dense.summary(),
              AllOf(HasSubstr("no material at rest has more"), HasSubstr("detonates with 0.25")));
  EXPECT_EQ(audit(ModelEquationOfState<Jwl>(tetryl(17.3, 586.83e9, 4.4))).verdict(), Verdict::not_usable);
  // Searches end where there is no detonation to find.
  EXPECT_THROW(ModelEquationOfState<Jwl>(tetryl(1730, 0.1, 0.999999999)), InputError);
}

TEST(EosAudit, CopperIsSoundAndItsFiguresAreThoseOfTheLoci) {
  const Audit band = audit(GrayEos(copper(MeltingTransition::band)));
  EXPECT_THAT(band.summary(),
              HasSubstr("with reservations: identities of the phase melting hold to 0.11 only"));
  for (const PhaseIdentities& phase : band.identities) {
    EXPECT_EQ(phase.verdict == Verdict::sound, phase.phase != "melting") << phase.phase;
  }
  const GrayEos eos(copper(MeltingTransition::equilibrium));
  const Audit a = audit(eos);
  EXPECT_EQ(a.summary(), "sound");
  EXPECT_TRUE(a.condensed);
  ASSERT_TRUE(a.cold && a.melting && a.shock_melting && a.critical && a.boiling);
  EXPECT_NEAR(a.melting->solidus.temperature, 1326.8, 0.1);
  EXPECT_NEAR(a.shock_melting->onset.state.pressure * 1e-9, 221.9, 0.1);
  EXPECT_NEAR(a.critical->temperature, 8511, 1);
  EXPECT_NEAR(a.boiling->temperature, 2415, 1);
  EXPECT_NEAR(a.range.greatest_density, eos.maximum_density(), 0.2 * eos.maximum_density());
  EXPECT_EQ(a.range.least_density, a.cold->tension_limit.density);
  EXPECT_GT(a.range.strongest_shock.state.pressure, 1e12);
  bool solid = false, vapour = false;
  for (const PhaseIdentities& phase : a.identities) {
    if (phase.phase == "melting") continue;
    EXPECT_LT(phase.largest.largest(), 1e-6) << phase.phase;
    EXPECT_GT(phase.states, 5) << phase.phase;
    solid = solid || phase.phase == "solid";
    vapour = vapour || phase.phase == "vapour";
  }
  EXPECT_TRUE(solid && vapour);
}

Audit audit_of(const MieGruneisenConstants& c) { return audit(MieGruneisenEos(c)); }

TEST(EosAudit, AHeatCapacityInTheWrongUnitIsNotUsable) {
  StiffenedGasConstants c = water_stiffened();
  c.heat_capacity *= 1000;  // kJ for J: Gamma^2 C_v T exceeds c^2 by far
  const ModelEquationOfState<StiffenedGas> eos(c);
  for (const AuditDepth depth : {AuditDepth::brief, AuditDepth::full}) {
    EXPECT_EQ(audit(eos, depth).verdict(), Verdict::not_usable);
    EXPECT_THAT(audit(eos, depth).summary(),
                HasSubstr("not usable: reference state (1000 kg/m^3, 293 K): K_T = -"));
    EXPECT_THAT(audit(eos, depth).summary(),
                HasSubstr("is not positive (rho c^2 = 2.64 GPa, Gamma^2 C_v T rho = 1.416e+04 GPa)"));
  }
}

TEST(EosAudit, AStiffenedGasFlowsButHasNoTemperature) {
  // Water with gamma = 4.4 and its own heat capacity: Gamma^2 C_v T is 5 times c^2.
  const Audit water = audit(ModelEquationOfState<StiffenedGas>(water_stiffened()));
  EXPECT_EQ(water.verdict(), Verdict::reservations);
  EXPECT_THAT(water.summary(), HasSubstr("no temperature of this model can be trusted"));
  EXPECT_GT(water.range.strongest_shock.state.pressure, 1e11);
}

TEST(EosAudit, ModelsOfImpactCodesAreSound) {
  EXPECT_EQ(audit(ModelEquationOfState<Tillotson>(aluminium_tillotson())).summary(), "sound");
  EXPECT_EQ(audit(ModelEquationOfState<Jwl>(tnt())).summary(), "sound");
  EXPECT_EQ(audit(ModelEquationOfState<IdealGas>(air())).summary(), "sound");
  EXPECT_EQ(audit(ModelEquationOfState<Murnaghan>(copper_murnaghan())).summary(), "sound");
  EXPECT_EQ(audit(ModelEquationOfState<Tait>(water_tait())).summary(), "sound");
}

TEST(EosAudit, ASteepHugoniotIsCompressedTooLittle) {
  MieGruneisenConstants steep = aluminium_2024();
  steep.hugoniot_slope = 15;
  EXPECT_EQ(audit_of(steep).verdict(), Verdict::reservations);
  EXPECT_THAT(audit_of(steep).summary(),
              HasSubstr("compression limit 2973.3 kg/m^3: 1.07 of the reference density"));
  steep.hugoniot_slope = 60;
  EXPECT_EQ(audit_of(steep).verdict(), Verdict::not_usable);
  EXPECT_THAT(audit_of(steep).summary(), HasSubstr("less than 1.02"));
}

TEST(EosAudit, ALargeGruneisenParameterEndsTheHugoniot) {
  MieGruneisenConstants c = aluminium_2024();
  c.gruneisen = 8;
  const Audit a = audit_of(c);
  EXPECT_EQ(a.verdict(), Verdict::reservations);
  EXPECT_THAT(a.summary(), HasSubstr("the Hugoniot ends at 14.8"));
  EXPECT_THAT(a.range.end_of_shocks, HasSubstr("beyond the maximum density of model mie_gruneisen (3196"));
  EXPECT_LT(a.range.strongest_shock.particle_velocity, 900);
}

TEST(EosAudit, MeltingAndBoilingPointsAreHeldAgainstTheReference) {
  GrayConstants low = copper();
  low.melting_temperature = 179;
  EXPECT_THAT(audit(GrayEos(low), AuditDepth::brief).summary(),
              HasSubstr("melts at 181.06 K, below the reference temperature of 300 K"));
  GrayConstants refractory = copper();
  refractory.melting_temperature = 10500;
  refractory.vapour_attraction = 1800;
  EXPECT_THAT(audit(GrayEos(refractory), AuditDepth::brief).summary(),
              HasSubstr("at zero pressure: above 5000 K, as no known material"));
  GrayConstants volatile_metal = copper();
  volatile_metal.vapour_attraction = 200;
  EXPECT_THAT(audit(GrayEos(volatile_metal), AuditDepth::brief).summary(),
              HasSubstr("at one atmosphere, below the melting point"));
}

TEST(EosAudit, ACriticalPointBeyondMatterIsNamed) {
  GrayConstants c = copper();
  c.vapour_attraction = 2000;
  EXPECT_THAT(audit(GrayEos(c), AuditDepth::brief).summary(),
              HasSubstr("critical temperature 26644 K: above 25000 K"));
}

/// A fluid whose pressure falls with density between two bounds: what an audit must not let pass.
class Loop final : public EquationOfState {
 public:
  [[nodiscard]] std::string_view model() const override { return "loop"; }
  [[nodiscard]] double reference_density() const override { return 1000; }
  [[nodiscard]] double reference_temperature() const override { return 300; }
  [[nodiscard]] double reference_energy() const override { return 3e5; }
  [[nodiscard]] double maximum_density() const override { return 3000; }
  [[nodiscard]] double minimum_energy(double) const override { return 1000; }
  [[nodiscard]] double least_temperature() const override { return 1; }
  RangeReport evaluate(const Batch&) const override { return {}; }
  [[nodiscard]] State state(double density, double e) const override {
    State s;
    s.density = density;
    s.specific_internal_energy = e;
    s.temperature = e / 1000;
    // K = rho dp/d(rho) = 2 GPa cos(...) turns negative at x = 1.25.
    const double x = density / 1000;
    s.pressure = 2e9 * std::sin(2 * 3.141592653589793 * (x - 1));
    s.isothermal_bulk_modulus = x * 2e9 * 2 * 3.141592653589793 * std::cos(2 * 3.141592653589793 * (x - 1));
    s.heat_capacity = 1000;
    s.gruneisen = 0;
    s.sound_speed = std::sqrt(std::max(s.isothermal_bulk_modulus / density, 100.0));
    s.specific_entropy = 1000 * std::log(s.temperature);
    s.phase = "liquid";
    derive(s);
    return s;
  }
  [[nodiscard]] State state_at_temperature(double density, double T) const override {
    return state(density, 1000 * T);
  }
  [[nodiscard]] std::string constants() const override { return ""; }
};

TEST(EosAudit, APressureThatFallsWithDensityEndsTheRange) {
  const Audit a = audit(Loop{});
  EXPECT_EQ(a.verdict(), Verdict::reservations);
  EXPECT_NEAR(a.range.greatest_density, 1250, 2);
  EXPECT_THAT(a.summary(), HasSubstr("the pressure of the cold curve falls beyond 1250 kg/m^3"));
  EXPECT_LT(a.range.strongest_shock.state.density, 1251);
}

/// Copper that has no states in a narrow band of densities.
class WithGap final : public EquationOfState {
 public:
  explicit WithGap(double density) : gap_(density) {}
  [[nodiscard]] std::string_view model() const override { return "gap"; }
  [[nodiscard]] double reference_density() const override { return whole_.reference_density(); }
  [[nodiscard]] double reference_temperature() const override { return whole_.reference_temperature(); }
  [[nodiscard]] double reference_energy() const override { return whole_.reference_energy(); }
  [[nodiscard]] double maximum_density() const override { return whole_.maximum_density(); }
  [[nodiscard]] double minimum_energy(double density) const override {
    return whole_.minimum_energy(density);
  }
  [[nodiscard]] double least_temperature() const override { return whole_.least_temperature(); }
  RangeReport evaluate(const Batch& batch) const override { return whole_.evaluate(batch); }
  [[nodiscard]] State state(double density, double energy) const override {
    if (std::abs(density / gap_ - 1.0) < 1e-3) throw StateError("no state in the gap");
    return whole_.state(density, energy);
  }
  [[nodiscard]] State state_at_temperature(double density, double T) const override {
    return whole_.state_at_temperature(density, T);
  }
  [[nodiscard]] std::string constants() const override { return ""; }

 private:
  GrayEos whole_{copper()};
  double gap_;
};

// A sample of a fit may have such a gap: its thresholds are unknown, which is no error of the others.
TEST(EosAudit, AThresholdBehindAGapIsNotKnown) {
  const GrayEos whole{copper()};
  const ShockMelting melting = shock_melting(whole).value();
  const WithGap gap(melting.onset.state.density);
  EXPECT_FALSE(shock_melting(gap).has_value());
  EXPECT_NO_THROW(release_thresholds(gap, 1e5));
}

}  // namespace
}  // namespace whipple::eos::test
