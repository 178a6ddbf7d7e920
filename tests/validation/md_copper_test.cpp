// SPDX-License-Identifier: BSD-3-Clause
// Molecular dynamics of copper in seconds: published numbers of the potentials, and what must hold for any of
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/campaign.hpp"
#include "md_fitting/protocols/hugoniot.hpp"
#include "md_fitting/protocols/lattice.hpp"
#include "md_fitting/protocols/nvt_state.hpp"
#include "md_fitting/protocols/structure.hpp"
#include "md_fitting/protocols/zero_pressure.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "tests/unit/md_mpi_environment.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace whipple::md {
namespace {

/// J/kg of so many eV per copper atom.
double specific(double electron_volts, const Potential& potential) {
  return metal::specific_energy(electron_volts, potential.mass());
}

// Mishin et al., Phys. Rev. B 63 (2001) 224106, table III: a0 = 3.615 A, E0 = -3.54 eV;
// Foiles, Baskes, Daw, Phys. Rev. B 33 (1986) 7983: 3.615 A, 3.54 eV.
TEST(Copper, LatticeConstantAndCohesiveEnergy) {
  for (const char* name : {"copper_mishin_2001", "copper_universal_3"}) {
    const Potential potential = Potential::load(name, "Cu");
    const LatticeResult lattice = measure_lattice(potential);
    EXPECT_NEAR(lattice.lattice_constant.value, 3.615e-10, 0.0005e-10) << name;
    EXPECT_NEAR(lattice.cohesive_energy.value / specific(-3.54, potential), 1.0, 1e-3) << name;
    // Two independent ways: LAMMPS' splines and the lattice sums over the tables.
    EXPECT_NEAR(lattice.lattice_constant.value / (potential.lattice_constant() * 1e-10), 1.0, 3e-5) << name;
    EXPECT_NEAR(lattice.cohesive_energy.value /
                    specific(potential.tables().crystal_energy(potential.lattice_constant()), potential),
                1.0, 2e-5)
        << name;
  }
}

// At 293 K both potentials expand by 1.4 %, because they were fitted to the room-temperature lattice constant
// at rest; the volume of the crystal at rest is 0.1119 cm^3/g.
TEST(Copper, ZeroPressureVolumeAtRoomTemperature) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  const ZeroPressureResult result =
      measure_zero_pressure(potential, 293.0, {.cells = 4, .equilibration_steps = 1000, .steps = 4000}, 1);
  EXPECT_NEAR(result.specific_volume.value, 1.135e-4, 3e-7);
  EXPECT_LT(result.specific_volume.error, 1e-7);
  EXPECT_GT(result.specific_volume.error, 0.0);
}

// Classical crystal: E - E_static = 3 k T per atom up to anharmonic terms of a percent at 100 K. This checks
// the exact kinetic part and the scaling with N/(N - 1) at once: without them 32 atoms would be 3 % too low.
TEST(Copper, EquipartitionAtLowTemperatureForAnySize) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  const double static_energy =
      specific(potential.tables().crystal_energy(potential.lattice_constant()), potential);
  for (const std::int64_t cells : {2, 4}) {
    NvtStateSource source(
        potential, {.cells = cells, .equilibration_steps = 2000, .steps = 128000 / (cells * cells * cells)},
        11);
    const State state = source.state(potential.static_volume(), 100.0, StateSource::Effort::final);
    const double excess = state.specific_internal_energy.value - static_energy;
    EXPECT_NEAR(excess / (3.0 * specific(metal::boltzmann * 100.0, potential)), 1.0, 0.012) << cells;
    EXPECT_TRUE(state.solid);
  }
}

// The header of CuTa.eam.alloy gives tantalum the structure fcc, in which its crystal is no minimum of the
// energy: it leaves its sites, and still passes for a crystal by its order and its displacements.
TEST(Crystal, ThatIsNoMinimumIsRefused) {
  const Potential potential = Potential::load("CuTa.eam.alloy", "Ta", {}, CrystalStructure::fcc);
  NvtStateSource source(potential, {.cells = 4, .equilibration_steps = 300, .steps = 600}, 1);
  try {
    source.state(potential.static_volume(), 300.0, StateSource::Effort::final);
    FAIL() << "accepted";
  } catch (const StateError& error) {
    EXPECT_NE(std::string(error.what()).find("the fcc crystal of Ta (CuTa.eam.alloy) is unstable"),
              std::string::npos)
        << error.what();
  }
}

// The Grueneisen coefficient from a finite difference must agree for 32 and 256 atoms: thermal energy and
// thermal pressure are scaled alike. Published range for this potential at V0: 1.8 +- 0.05.
TEST(Copper, ThermalPressureAndEnergyGiveTheGruneisenCoefficient) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  NvtStateSource source(potential, {.cells = 4, .equilibration_steps = 500, .steps = 3000}, 5);
  const double v = potential.static_volume();
  const State cold = source.state(v, 150.0, StateSource::Effort::final);
  const State hot = source.state(v, 900.0, StateSource::Effort::final);
  const double gruneisen = v * (hot.pressure.value - cold.pressure.value) /
                           (hot.specific_internal_energy.value - cold.specific_internal_energy.value);
  EXPECT_NEAR(gruneisen, 1.80, 0.06);
  EXPECT_GT(hot.correlation, 0.3);  // hot fluctuations of energy and pressure go together
}

// A Hugoniot state by molecular dynamics lies on the line that the isotherm and the Grueneisen coefficient
// demand: Us = 3.90 + 1.32 up (km/s) for this potential up to 3 km/s, to 1 %.
TEST(Copper, HugoniotState) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  const RunSize size{.cells = 4, .equilibration_steps = 300, .steps = 1000};
  const ZeroPressureResult rest =
      measure_zero_pressure(potential, 293.0, {.cells = 4, .equilibration_steps = 1000, .steps = 4000}, 1);
  NvtStateSource source(potential, size, 3);
  const double heat = 3.0 * specific(metal::boltzmann, potential);
  const HugoniotState state = solve_hugoniot(
      source, {rest.specific_volume, rest.specific_internal_energy, 0.0}, 0.75 * potential.static_volume(),
      {.first_temperature = 1200.0, .specific_heat = heat, .gruneisen = 1.5});
  EXPECT_NEAR(state.shock_velocity.value / (3900.0 + 1.32 * state.particle_velocity.value), 1.0, 0.01);
  EXPECT_TRUE(state.solid);
  EXPECT_LT(state.temperature.error, 0.03 * state.temperature.value);
}

// Far above the melting temperature the crystal must be flagged as melted, by its structure too: in the
// nearest minimum of the energy a melt keeps disorder (fourteen seeds of 256 atoms, half of them in another
// bath: shares of 0.31 to 0.54; boxes of 108 atoms go to 0.70), while a crystal of 1000 K loses all traces of
// its heat.
TEST(Copper, MeltingGuard) {
  const Potential potential = Potential::load("copper_universal_3", "Cu");
  NvtStateSource source(potential, {.cells = 4, .equilibration_steps = 2000, .steps = 3000}, 5);
  const State melt = source.state(1.15 * potential.static_volume(), 4000.0, StateSource::Effort::final);
  EXPECT_FALSE(melt.solid);
  EXPECT_LT(melt.crystal_share, 0.65);
  const State crystal = source.state(potential.static_volume(), 1000.0, StateSource::Effort::final);
  EXPECT_TRUE(crystal.solid);
  EXPECT_GT(crystal.crystal_share, 0.98);
}

// Coexistence in bcc metals counts crystal by the same bond order, over fourteen neighbours: 0.4 to 0.6 of the atoms of a hot
// crystal have it, 0.03 to 0.12 of those of a melt.
TEST(Tungsten, BondOrderTellsAHotCrystalFromItsMelt) {
  const Potential potential = Potential::load("zhou_2004", "W");
  Crystal crystal(potential, 1.015 * potential.lattice_constant(), 5, 5, 5);
  Lammps& lammps = crystal.lammps();
  const auto at = [&](double temperature, int seed, int steps) {
    lammps.command("velocity all create {} {} mom yes dist gaussian", 2.0 * temperature, seed);
    lammps.command("fix bath all nvt temp {0} {0} 0.1", temperature);
    lammps.command("run {}", steps);
    lammps.command("unfix bath");
    return crystal_share(crystal, potential);
  };
  lammps.command("timestep 0.001");
  EXPECT_GT(at(3500.0, 1, 500), 0.35);
  at(14000.0, 2, 2000);
  EXPECT_LT(at(5000.0, 3, 800), 0.2);
}

Plan small_plan() {
  Plan plan;
  plan.element = "Cu";
  plan.potential = "copper_universal_3";
  plan.zero_pressure = ZeroPressurePlan{{293.0}, {.cells = 3, .equilibration_steps = 200, .steps = 400}};
  plan.isotherms = {{293.0, {1.0, 0.8}, {.cells = 3, .equilibration_steps = 100, .steps = 300}}};
  plan.hugoniot = HugoniotPlan{{0.8}, {.cells = 3, .equilibration_steps = 100, .steps = 300}};
  return plan;
}

// The whole way from plan to store, twice: the same numbers to the last bit, and other ones with another
// seed.
TEST(CopperCampaign, SamePlanGivesTheSameNumbersBitwise) {
  log::set_level(log::Level::quiet);
  const TemporaryFolder folder;
  Plan plan = small_plan();
  const Potential potential = Potential::load(plan.potential, plan.element);
  const auto points = [&](const std::string& name) {
    const std::vector<Task> tasks = make_tasks(plan, potential);
    const CampaignSummary summary = run_campaign(tasks, folder.path() / name, MPI_COMM_WORLD, false);
    EXPECT_EQ(summary.computed, 5);
    EXPECT_EQ(run_campaign(tasks, folder.path() / name, MPI_COMM_WORLD, false).computed, 0);
    return read_store(folder.path() / name);
  };
  const auto first = points("first.md.h5");
  const auto second = points("second.md.h5");
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].key, second[i].key);
    for (const auto& [name, estimate] : first[i].results) {
      EXPECT_EQ(estimate.value, second[i].result(name).value) << first[i].label() << " " << name;
      EXPECT_EQ(estimate.error, second[i].result(name).error) << first[i].label() << " " << name;
    }
  }
  plan.seed = 2;
  const auto other = points("other.md.h5");
  // Stores are ordered by protocol and key: another seed gives other keys, so the volumes are looked up by
  // the protocol.
  const auto volume = [](const auto& store) {
    return *std::find_if(store.begin(), store.end(),
                         [](const auto& point) { return point.protocol == "zero_pressure_volume"; });
  };
  EXPECT_NE(volume(other).key, volume(first).key);
  EXPECT_NE(volume(other).result("specific_volume").value, volume(first).result("specific_volume").value);
}

// A real LAMMPS failure (an absurd time step) in one point of a plan: named, stored, the others done.
TEST(CopperCampaign, LammpsFailureInOnePointLeavesTheOthers) {
  log::set_level(log::Level::quiet);
  const TemporaryFolder folder;
  const auto store = folder.path() / "points.md.h5";
  Plan plan = small_plan();
  plan.hugoniot.reset();
  plan.isotherms.push_back(
      {5000.0, {0.9}, {.cells = 3, .equilibration_steps = 200, .steps = 300, .time_step = 80e-15}});
  const Potential potential = Potential::load(plan.potential, plan.element);
  const CampaignSummary summary = run_campaign(make_tasks(plan, potential), store, MPI_COMM_WORLD, false);
  EXPECT_EQ(summary.failed, 1);
  EXPECT_EQ(summary.computed, 4);
  int failed = 0;
  for (const PointRecord& point : read_store(store)) {
    if (point.done()) continue;
    ++failed;
    EXPECT_EQ(point.condition("temperature"), 5000.0);
    EXPECT_FALSE(point.message.empty());
  }
  EXPECT_EQ(failed, 1);
}

// States beyond the density table are refused before anything runs, all of them at once.
TEST(CopperCampaign, RefusesStatesOutsideThePotential) {
  Plan plan = small_plan();
  plan.potential = "Cu_mishin1.eam.alloy";
  plan.isotherms[0].volume_ratio = {1.0, 0.65, 0.6};
  const Potential potential = Potential::load(plan.potential, plan.element);
  try {
    make_tasks(plan, potential);
    FAIL() << "no InputError";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("isotherm: potential Cu_mishin1.eam.alloy: density table ends at V/V0 = 0.719"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("V/V0 = 0.650"), std::string::npos) << text;
    EXPECT_NE(text.find("V/V0 = 0.600"), std::string::npos) << text;
    EXPECT_EQ(text.find("V/V0 = 1.0"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace whipple::md
