// SPDX-License-Identifier: BSD-3-Clause
// Means over cells on several ranks (docs/theory/mpm.md, 4.12 to 4.14): particles of a body in a cell are on two ranks
// when they cross the blocks of the ranks between two distributions.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/io/ranks.hpp"
#include "src/run/checkpointing.hpp"
#include "tests/parallel/solver_ranks.hpp"
#include "tests/verification/averaged_collision.hpp"

namespace whipple::solver {
namespace {

namespace fs = std::filesystem;
using verification::Method;

constexpr double end = 0.1e-6;  // s

/// Returns two blocks that collide while they fly across the blocks of the ranks.
cases::Case collision(const Method& method, const char* dimension) {
  return verification::averaged_collision(method, dimension, "cell", end, 1000.0);
}

/// Returns the number of cells of a body whose particles are on more than one rank; on the root. Collective.
std::size_t divided_cells(const Simulation& together) {
  const grid::Geometry& geometry = together.grid().geometry();
  std::set<std::array<double, 4>> own;
  const Particles& q = together.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    const Lanes at = floor(geometry.in_cells(q.position[p]));
    own.insert({at[0], at[1], at[2], static_cast<double>(q.body[p])});
  }
  std::vector<std::vector<std::array<double, 4>>> outgoing(
      static_cast<std::size_t>(parallel::size(MPI_COMM_WORLD)));
  outgoing[0].assign(own.begin(), own.end());
  std::vector<std::array<double, 4>> all;
  for (const auto& of_rank : parallel::exchange(MPI_COMM_WORLD, outgoing)) {
    all.insert(all.end(), of_rank.begin(), of_rank.end());
  }
  const std::size_t cells = std::set(all.begin(), all.end()).size();
  return all.size() - cells;
}

/// Advances a run, and requires exact balances after every step and divided cells after some.
void advance_exactly(Simulation& together, double time) {
  double energy = 0.0, momentum = 0.0;
  std::size_t divided = 0;
  while (together.state().time < time) {
    together.advance(time);
    energy = std::max(energy, std::abs(together.state().ledger.energy_error(together.totals())));
    momentum = std::max(momentum, together.state().ledger.momentum_error(together.totals()));
    divided = std::max(divided, divided_cells(together));
  }
  EXPECT_LT(energy, 1e-13);
  EXPECT_LT(momentum, 1e-13);
  if (!is_root()) return;
  EXPECT_EQ(divided > 0, parallel::size(MPI_COMM_WORLD) > 1);
}

TEST(AverageRanks, AgreeWithOneRank) {
  for (const char* dimension : {"3d", "axisymmetric"}) {
    SCOPED_TRACE(dimension);
    const cases::Case setup = collision({}, dimension);
    Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
    advance_exactly(together, end);
    advance_on_root(alone, end);
    expect_agreement(together, alone, 1e-12);
  }
}

// The gradients of each scheme are averaged in a pass of their own.
TEST(AverageRanks, AgreeWithOneRankInEveryScheme) {
  for (const char* scheme : {"musl", "usl", "usf"}) {
    SCOPED_TRACE(scheme);
    Method method = Method::musl();
    method.scheme = scheme;
    const cases::Case setup = collision(method, "plane_strain");
    Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
    advance_to(together, end);
    advance_on_root(alone, end);
    expect_same_on_all_ranks(together);
    if (!is_root()) continue;
    EXPECT_EQ(together.state().step, alone.state().step);
    const Totals& initial = alone.state().ledger.initial;
    EXPECT_NEAR(together.totals().internal_energy, alone.totals().internal_energy, 1e-12 * initial.energy());
    EXPECT_LE((together.totals().momentum - alone.totals().momentum).norm(), 1e-12 * initial.momentum_scale);
  }
}

TEST(AverageRanks, GoOnFromACheckpointOfAnotherNumberOfRanks) {
  const io::Ranks ranks(MPI_COMM_WORLD);
  const fs::path folder =
      fs::temp_directory_path() / ("whipple_average_ranks_" + ranks.broadcast(std::to_string(::getpid())));
  ranks.on_root([&] { fs::create_directories(folder); });
  const cases::Case setup = collision({}, "plane_strain");
  const auto write = [&](const char* name, const Simulation& simulation, MPI_Comm communicator) {
    return io::write_checkpoint(folder / name, simulation.state().step, simulation.particles(),
                                run::to_checkpoint(simulation.state()), communicator);
  };
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, 0.5 * end);
  advance_on_root(alone, 0.5 * end);
  const fs::path of_all = write("all", together, MPI_COMM_WORLD);
  ranks.on_root([&] { write("one", alone, MPI_COMM_SELF); });
  advance_on_root(alone, end);

  io::Checkpoint checkpoint = io::read_checkpoint(of_all, MPI_COMM_SELF);
  Simulation from_all(setup, std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                      MPI_COMM_SELF);
  advance_on_root(from_all, end);
  if (is_root()) expect_equal(from_all, alone, 1e-12);

  checkpoint = io::read_latest_checkpoint(folder / "one", MPI_COMM_WORLD);
  Simulation from_one(setup, std::move(checkpoint.particles), run::from_checkpoint(checkpoint.values),
                      MPI_COMM_WORLD);
  advance_to(from_one, end);
  expect_agreement(from_one, alone, 1e-12);
  MPI_Barrier(MPI_COMM_WORLD);
  ranks.on_root([&] { fs::remove_all(folder); });
}

}  // namespace
}  // namespace whipple::solver
