// SPDX-License-Identifier: BSD-3-Clause
// Shocks, tension, melt and vapour of copper in small simulations: independent ways to one state, bounds that
// the potential itself sets, and flags of states that are not what was asked for.
#include <gtest/gtest.h>

#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/catalogue.hpp"
#include "md_fitting/protocols/cold_curve.hpp"
#include "md_fitting/protocols/hugoniostat.hpp"
#include "md_fitting/protocols/liquid_vapour.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "md_fitting/protocols/phase.hpp"
#include "md_fitting/protocols/piston.hpp"
#include "md_fitting/protocols/spall.hpp"
#include "md_fitting/protocols/zero_pressure.hpp"
#include "src/core/base/error.hpp"
#include "tests/unit/md_mpi_environment.hpp"

namespace whipple::md {
namespace {

const Potential& universal() {
  static const Potential potential = Potential::load("copper_universal_3", "Cu");
  return potential;
}

/// Zero pressure and 293 K, from a run of 500 atoms and 20000 steps.
ReferenceState room_temperature() { return {{1.13515e-4, 1e-8}, {-5.25865e6, 1e2}, 0.0}; }

// Thermostat and root search know nothing of each other: at the volume that the Hugoniostat finds, the root
// of the Hugoniot function must have the same shock velocity to 0.5 % and the same temperature.
TEST(Hugoniostat, AgreesWithTheRootOfTheHugoniotFunction) {
  const RunSize size{.cells = 4, .equilibration_steps = 1000, .steps = 3000};
  const HugoniostatResult driven = run_hugoniostat(universal(), room_temperature(), 50e9, size, 7);
  EXPECT_TRUE(driven.converged);
  EXPECT_NEAR(driven.pressure.value, 50e9, 4.0 * driven.pressure.error + 0.1e9);
  EXPECT_LT(std::abs(driven.residual_temperature.value), 25.0);
  NvtStateSource source(universal(), {.cells = 4, .equilibration_steps = 500, .steps = 2000}, 3);
  const HugoniotState root =
      solve_hugoniot(source, room_temperature(), driven.specific_volume.value,
                     {.first_temperature = 700.0,
                      .specific_heat = 3.0 * metal::specific_energy(metal::boltzmann, universal().mass()),
                      .gruneisen = 1.6});
  EXPECT_NEAR(driven.shock_velocity.value / root.shock_velocity.value, 1.0, 0.005);
  EXPECT_NEAR(driven.particle_velocity.value / root.particle_velocity.value, 1.0, 0.01);
  EXPECT_NEAR(driven.temperature.value, root.temperature.value,
              4.0 * std::hypot(driven.temperature.error, root.temperature.error) + 15.0);
}

// A perfect crystal that only yields like a spring is flagged: at 0.5 km/s, below the plastic threshold (0.75
// km/s along [001]: Bringa et al., J. Appl. Phys. 96 (2004) 3793), its elastic front outruns the hydrostatic
// Hugoniot, Us = 3.90 + 1.32 up here. At 3.5 km/s the shock melts the crystal and lies on that line. The
// density counted behind the front is that of the jump of mass, rho0 Us/(Us - up), of which the measurement
// of Us knows nothing.
TEST(Piston, ElasticFrontsAreFlaggedAndStrongOnesLieOnTheHugoniot) {
  const PistonPlan section{{}, 30, {.cells = 5, .equilibration_steps = 400}};
  const PistonResult elastic = measure_piston(universal(), room_temperature(), 293.0, 500.0, section, 3);
  EXPECT_TRUE(elastic.elastic);
  EXPECT_GT(elastic.shock_velocity.value, 1.02 * (3900.0 + 1.32 * 500.0));
  EXPECT_GT(elastic.shear_stress_share, 0.08);
  const PistonResult strong = measure_piston(universal(), room_temperature(), 293.0, 3500.0, section, 3);
  EXPECT_FALSE(strong.elastic);
  EXPECT_NEAR(strong.shock_velocity.value / (3900.0 + 1.32 * 3500.0), 1.0, 0.02);
  EXPECT_LT(std::abs(strong.shear_stress_share), 0.06);
  for (const auto& [shock, velocity] : {std::pair{elastic, 500.0}, std::pair{strong, 3500.0}}) {
    const double us = shock.shock_velocity.value;
    EXPECT_NEAR(shock.density * 1.13515e-4 / (us / (us - velocity)), 1.0, 0.02) << velocity;
    EXPECT_LT(shock.shock_velocity.error, 0.02 * us);
  }
}

// Thermal motion can only weaken a crystal: the tension stays below the largest one of the static crystal,
// and heat lowers it. Adiabatic expansion cools.
TEST(Spall, LiesBelowTheStrengthOfTheStaticCrystal) {
  double static_strength = 0.0;
  std::string transcript;
  for (double ratio = 1.2; ratio < 1.7; ratio += 0.02) {
    const double volume = ratio * universal().static_volume();
    static_strength = std::fmax(
        static_strength, -measure_cold(universal(), CrystalStructure::fcc, volume, transcript).pressure);
  }
  SpallPlan section;
  section.strain_rate = 5e10;
  section.replicas = 2;
  section.size.cells = 4;
  section.size.equilibration_steps = 1000;
  const ReplicaSet<SpallPoint> cold = measure_spall(universal(), 293.0, section, 3);
  const ReplicaSet<SpallPoint> hot = measure_spall(universal(), 900.0, section, 3);
  const double strength = cold.mean(&SpallPoint::spall_strength).value;
  EXPECT_LT(strength, static_strength);
  EXPECT_GT(strength, 0.7 * static_strength);
  EXPECT_LT(hot.mean(&SpallPoint::spall_strength).value, 0.9 * strength);
  EXPECT_LT(cold.mean(&SpallPoint::spall_temperature).value, 250.0);
  EXPECT_GT(cold.mean(&SpallPoint::spall_specific_volume).value,
            1.2 * cold.mean(&SpallPoint::specific_volume).value);
  // The crystal does not fail within two per cent.
  section.largest_strain = 0.05;
  EXPECT_THROW(measure_spall(universal(), 293.0, section, 3), StateError);
}

// Thermal expansion from the fluctuations at one temperature against the volumes of two other temperatures.
TEST(ZeroPressure, ExpansionFromFluctuationsIsTheSlopeOfTheVolume) {
  const RunSize size{.cells = 4, .equilibration_steps = 1000, .steps = 24000};
  const ZeroPressureResult cold = measure_zero_pressure(universal(), 300.0, size, 3);
  const ZeroPressureResult middle = measure_zero_pressure(universal(), 450.0, size, 4);
  const ZeroPressureResult hot = measure_zero_pressure(universal(), 600.0, size, 5);
  const double slope =
      (hot.specific_volume.value - cold.specific_volume.value) / 300.0 / middle.specific_volume.value;
  EXPECT_NEAR(middle.thermal_expansion.value, slope, 4.0 * middle.thermal_expansion.error);
  EXPECT_LT(middle.thermal_expansion.error, 0.25 * slope);
  EXPECT_NEAR(slope, 5.3e-5, 0.6e-5);  // copper: 3 x 17.9e-6 1/K (NIST StRD, Hahn1)
}

// A melt is a melt by its structure, and no crystal is: the same measurement on a crystal of the same
// temperature. Enthalpy and volume rise on melting.
TEST(Liquid, IsProvedByItsStructure) {
  const RunSize size{.cells = 4, .equilibration_steps = 1000, .steps = 2000};
  std::string transcript;
  const Phase melt = measure_phase(universal(), true, 0.0, 1250.0, size, 1e-3, 3, transcript);
  const Phase crystal = measure_phase(universal(), false, 0.0, 1250.0, size, 1e-3, 3, transcript);
  EXPECT_LT(melt.crystal_share, 0.15);
  EXPECT_GT(crystal.crystal_share, 0.35);
  EXPECT_GT(melt.volume.value, 1.02 * crystal.volume.value);
  EXPECT_GT(melt.enthalpy.value, crystal.enthalpy.value + 0.08);  // eV; copper: 0.137 eV
}

// Far below the critical point there is no vapour to count in a small box, above it no film; between, the
// film has the density of the melt alone at the same temperature and pressure, found by another protocol, the
// vapour is thinner by a multiple, and the surface energy has become small.
TEST(LiquidVapour, IsMeasuredWhereBothPhasesAre) {
  LiquidVapourPlan section{{}, 2.0, 2, {.cells = 4, .equilibration_steps = 16000, .steps = 8000}};
  const ReplicaSet<FilmRun> film = measure_liquid_vapour(universal(), 5000.0, section, 3);
  std::string transcript;
  const Phase melt =
      measure_phase(universal(), true, std::fmax(0.0, film.mean(&LiquidVapourPoint::vapour_pressure).value),
                    5000.0, {.cells = 4, .equilibration_steps = 1000, .steps = 3000}, 1e-3, 3, transcript);
  const double density = 1.0 / metal::specific_volume(melt.volume.value, universal().mass());
  EXPECT_NEAR(film.mean(&LiquidVapourPoint::liquid_density).value / density, 1.0, 0.10);
  EXPECT_LT(film.mean(&LiquidVapourPoint::vapour_density).value,
            0.2 * film.mean(&LiquidVapourPoint::liquid_density).value);
  EXPECT_GT(film.mean(&LiquidVapourPoint::vapour_density).value, 0.0);
  EXPECT_GT(film.mean(&LiquidVapourPoint::surface_energy).value,
            -3.0 * film.mean(&LiquidVapourPoint::surface_energy).error);
  // So close to the critical point it is a small part of that of liquid copper at its melting point, 1.3
  // J/m^2.
  EXPECT_LT(film.mean(&LiquidVapourPoint::surface_energy).value, 0.4);
  section.size = {.cells = 4, .equilibration_steps = 1000, .steps = 3200};
  const auto refusal_at = [&](double temperature) -> std::string {
    try {
      measure_liquid_vapour(universal(), temperature, section, 3);
    } catch (const StateError& error) {
      return error.what();
    }
    return "no StateError";
  };
  EXPECT_NE(refusal_at(2500.0).find("atoms on average"), std::string::npos) << refusal_at(2500.0);
  EXPECT_NE(refusal_at(12000.0).find("do not separate"), std::string::npos) << refusal_at(12000.0);
}

}  // namespace
}  // namespace whipple::md
