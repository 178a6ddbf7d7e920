// SPDX-License-Identifier: BSD-3-Clause
// Explosives on several ranks: lighting times, burn fractions, the drive by the products and the removed products equal
// those of one rank, and a run resumed from a checkpoint of several ranks uses the lighting stored there. A gas whose
// particles are split and separate.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/ranks.hpp"
#include "src/run/checkpointing.hpp"
#include "src/solver/carriers/carrier.hpp"
#include "tests/parallel/solver_ranks.hpp"

namespace whipple::solver {
namespace {

/// Returns a case of TNT that drives a copper plate, around an inert block; a second detonator fires in material at
/// rest. Plane strain. The plate moves from the start, for a scale of momenta.
cases::Case charge_on_plate() {
  return cases::read_case_text(R"(
[domain]
dimension = "plane_strain"
lower = ["-4 mm", "0 mm"]
upper = ["28 mm", "12 mm"]
cell_size = "0.5 mm"
boundary = { y_lower = "symmetry" }
[splitting]
length = 0  # new particles have other numbers on other ranks, and the sums below are weighted with the numbers
[time]
end = "3 us"
[[detonation]]
position = ["0 mm", "0 mm"]
[[detonation]]
position = ["20 mm", "8 mm"]
delay = "0.9 us"
[[body]]
name = "charge"
material = "tnt"
shape = { difference = { from = { box = { lower = ["0 mm", "0 mm", "-1 mm"], upper = ["20 mm", "8 mm", "1 mm"] } }, minus = [ { box = { lower = ["8 mm", "0 mm", "-1 mm"], upper = ["10 mm", "4 mm", "1 mm"] } } ] } }
[[body]]
name = "block"
material = "pmma"
shape = { box = { lower = ["8 mm", "0 mm", "-1 mm"], upper = ["10 mm", "4 mm", "1 mm"] } }
[[body]]
name = "plate"
material = "copper_ofhc_mie_gruneisen"
velocity = ["1 m/s", "0 m/s"]
shape = { box = { lower = ["20 mm", "0 mm", "-1 mm"], upper = ["22 mm", "8 mm", "1 mm"] } }
)",
                               "charge_on_plate.toml");
}

/// Sums over the explosive of all ranks, with an individual weight of each particle: chemical energy (J), burn
/// fraction, lighting time (s), and the last two sums without weights. Collective.
std::vector<double> sums_of(const Simulation& simulation, MPI_Comm communicator) {
  const Particles& q = simulation.particles();
  const auto &burnt = q.history.scalar("burn_fraction"), &lit = q.history.scalar("lighting_time");
  Figures figures;
  simulation.carriers()[0]->add_figures(figures);
  std::vector<double> sums = {figures.chemical_energy, 0.0, 0.0, 0.0, 0.0};
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (q.body[p] != 0) continue;
    const double weight = std::sin(static_cast<double>(q.id[p]));
    sums[1] += weight * burnt[p];
    sums[2] += weight * lit[p];
    sums[3] += burnt[p];
    sums[4] += lit[p];
  }
  parallel::sum(communicator, sums);
  return sums;
}

void expect_same_burn(const std::vector<double>& all, const std::vector<double>& one, double store) {
  EXPECT_NEAR(all[0], one[0], 1e-11 * store);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_NEAR(all[i], one[i], 1e-10 * one[3 + (i + 1) % 2]) << i;
}

TEST(BurnRanks, AgreeWithOneRankAndGoOnWithTheirLighting) {
  const io::Ranks ranks(MPI_COMM_WORLD);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       ("whipple_burn_ranks_" + ranks.broadcast(std::to_string(::getpid())));
  const cases::Case setup = charge_on_plate();
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  const double store = sums_of(together, MPI_COMM_WORLD)[0];
  expect_same_burn(sums_of(together, MPI_COMM_WORLD), sums_of(alone, MPI_COMM_SELF), store);
  advance_to(together, 1e-6);
  const std::filesystem::path file =
      io::write_checkpoint(folder, together.state().step, together.particles(),
                           run::to_checkpoint(together.state()), MPI_COMM_WORLD);
  advance_to(together, 1.7e-6);
  advance_on_root(alone, 1e-6);
  advance_on_root(alone, 1.7e-6);
  expect_agreement(together, alone, 1e-11);
  EXPECT_EQ(together.particles().size() < together.particle_count(), ranks.is_parallel());
  const std::vector<double> of_all = sums_of(together, MPI_COMM_WORLD),
                            of_one = sums_of(alone, MPI_COMM_SELF);
  io::Checkpoint checkpoint = io::read_checkpoint(file, MPI_COMM_SELF);
  Simulation resumed(setup, std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                     MPI_COMM_SELF);
  advance_on_root(resumed, 1.7e-6);
  MPI_Barrier(MPI_COMM_WORLD);
  ranks.on_root([&] { std::filesystem::remove_all(folder); });
  if (!is_root()) return;
  EXPECT_GT(of_one[0], 0.05 * store);  // both fronts are propagating
  EXPECT_LT(of_one[0], 0.8 * store);
  EXPECT_GT(alone.totals().kinetic_energy, 0.01 * store);
  expect_same_burn(of_all, of_one, store);
  expect_equal(resumed, alone, 1e-11);
  expect_same_burn(sums_of(resumed, MPI_COMM_SELF), of_one, store);
}

/// Returns a case of a thin charge of TNT between vacuum and a plate, whose products are removed below 50 MPa. Plane
/// strain.
cases::Case charge_that_spreads() {
  return cases::read_case_text(R"(
[domain]
dimension = "plane_strain"
lower = ["-16 mm", "0 mm"]
upper = ["20 mm", "16 mm"]
cell_size = "0.5 mm"
boundary = { y_lower = "symmetry" }
[time]
end = "5 us"
[burn]
retire_below = "50 MPa"
[[detonation]]
position = ["0 mm", "0 mm"]
[[body]]
name = "charge"
material = "tnt"
shape = { box = { lower = ["0 mm", "0 mm", "-1 mm"], upper = ["6 mm", "4 mm", "1 mm"] } }
[[body]]
name = "plate"
material = "copper_ofhc_mie_gruneisen"
velocity = ["1 m/s", "0 m/s"]
shape = { box = { lower = ["6 mm", "0 mm", "-1 mm"], upper = ["7 mm", "4 mm", "1 mm"] } }
)",
                               "charge_that_spreads.toml");
}

// Products removed on any rank are included in the sums of all, and the remaining material evolves as on one rank.
TEST(BurnRanks, RemoveTheProductsThatOneRankRemoves) {
  const cases::Case setup = charge_that_spreads();
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, 4e-6);
  advance_on_root(alone, 4e-6);
  expect_agreement(together, alone, 1e-11);
  const Ledger& of_all = together.state().ledger;
  EXPECT_NEAR(together.totals().mass + of_all.outflow.mass, of_all.initial.mass, 1e-14 * of_all.initial.mass);
  EXPECT_GT(of_all.retired.mass, 0.05 * of_all.initial.mass);
  if (!is_root()) return;
  const Ledger& of_one = alone.state().ledger;
  const double energy = of_one.initial.energy(), momentum = of_one.initial.momentum_scale;
  EXPECT_NEAR(of_all.retired.mass, of_one.retired.mass, 1e-11 * of_one.initial.mass);
  EXPECT_NEAR(of_all.retired.energy, of_one.retired.energy, 1e-11 * energy);
  EXPECT_LE((of_all.retired.momentum - of_one.retired.momentum).norm(), 1e-11 * momentum);
}

/// Returns a case of a sphere of gas next to two planes of symmetry, in vacuum: an octant, or a section.
cases::Case expanding_gas(bool section) {
  const std::string of_dimension =
      section ? "dimension = \"axisymmetric\"\nlower = [\"0 mm\", \"0 mm\"]\nupper = [\"48 mm\", \"48 mm\"]\n"
              : "lower = [\"0 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"24 mm\", \"24 mm\", \"24 mm\"]\n";
  const std::string boundary = section ? "" : ", y_lower = \"symmetry\", z_lower = \"symmetry\"";
  return cases::read_case_text("[domain]\n" + of_dimension +
                                   "cell_size = \"1 mm\"\nboundary = { x_lower = \"symmetry\"" + boundary +
                                   " }\n" +
                                   R"([time]
end = "20 us"
[splitting]
maximum_generations = 4
[[body]]
name = "gas"
material = "air"
initial = { density = "1 kg/m^3", pressure = "1 MPa" }
velocity = )" + (section ? R"(["1 m/s", "0 m/s"])" : R"(["1 m/s", "0 m/s", "0 m/s"])") +
                                   R"(
shape = { sphere = { center = ["0 mm", "0 mm", "0 mm"], radius = "4 mm" } }
)",
                               "expanding_gas.toml");
}

// New particles, their numbers, and the pressure held back after the last division
TEST(BurnRanks, DivideTheGasThatOneRankDivides) {
  const io::Ranks ranks(MPI_COMM_WORLD);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       ("whipple_gas_ranks_" + ranks.broadcast(std::to_string(::getpid())));
  for (const bool section : {true, false}) {
    const cases::Case setup = expanding_gas(section);
    const double half_way = section ? 12e-6 : 5e-6, end = section ? 16e-6 : 7e-6;
    Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
    const std::size_t seeded = alone.particle_count();
    advance_to(together, half_way);
    const std::filesystem::path file =
        io::write_checkpoint(folder, together.state().step, together.particles(),
                             run::to_checkpoint(together.state()), MPI_COMM_WORLD);
    advance_to(together, end);
    advance_on_root(alone, half_way);
    advance_on_root(alone, end);
    expect_agreement(together, alone, 1e-11);
    io::Checkpoint checkpoint = io::read_checkpoint(file, MPI_COMM_SELF);
    Simulation resumed(setup, std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                       MPI_COMM_SELF);
    advance_on_root(resumed, end);
    if (is_root()) {
      EXPECT_GT(alone.particle_count(), 4 * seeded);
      if (section) {
        EXPECT_GT(alone.state().ledger.held_pressures, 0.0);
        EXPECT_EQ(together.state().ledger.held_pressures, alone.state().ledger.held_pressures);
      }
      expect_equal(resumed, alone, ranks.is_parallel() ? 1e-11 : 0.0);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ranks.on_root([&] { std::filesystem::remove_all(folder); });
}

}  // namespace
}  // namespace whipple::solver
