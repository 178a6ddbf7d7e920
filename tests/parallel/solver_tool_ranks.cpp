// SPDX-License-Identifier: BSD-3-Clause
// Tools on prescribed paths that press and rub, and pressures on patches of walls: several ranks agree with one, to the
// round-off of the gaps that close, and runs go on from their checkpoints, on one rank bit for bit.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "src/io/ranks.hpp"
#include "src/run/observers/history_columns.hpp"
#include "tests/parallel/solver_ranks.hpp"
#include "tests/verification/contact_problems.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::solver {
namespace {

namespace fs = std::filesystem;
using verification::restored;
using verification::save;

constexpr double middle = 1.5e-6, end = 3e-6, rubbed = 2.5e-7;  // s
// Sums agree to 1e-14; the time step is that of one point at the edge of a contact, where round-off is a part of 1e-10 of
// it in single steps.
constexpr double of_sums = 1e-11, of_time_step = 1e-9;

/// Returns a body of aluminium in a box, mm, with further keys.
std::string aluminium_box(const std::string& name, const Vector3& lower, const Vector3& upper,
                          const std::string& keys) {
  return "[[body]]\nname = \"" + name + "\"\nmaterial = \"" +
         verification::aluminium("aluminium_of_tools", "0.3 GPa") + "\"\nshape = { " +
         verification::box(1e-3 * lower, 1e-3 * upper) + " }\n" + keys;
}

/// Returns the keys of a plate of elements that moves along a path.
std::string plate(const std::string& velocity, const std::string& path) {
  return "discretization = { method = \"finite_elements\" }\n"
         "[[body.node_condition]]\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n"
         "directions = [\"x\", \"y\", \"z\"]\nvelocity = " +
         velocity + "\n" + path;
}

/// Returns all but the bodies: friction, and a domain with separating walls at two sides.
std::string surroundings(double until) {
  const verification::Method method;
  return method.time_toml(until) + method.toml() +
         "[contact]\nmethod = \"multi_field\"\nfriction = 0.25\n"
         "[domain]\nlower = [0, 0, 0]\nupper = [0.024, 0.012, 0.012]\ncell_size = 0.001\n"
         "boundary = { x_lower = \"separating\", z_lower = \"separating\" }\n";
}

/// Returns a case of a block between a plate of elements and a stamp of particles, both on paths, with a pressure behind it that begins in the second half.
cases::Case press() {
  const std::string path = "[body.path]\ntimes = [0, 1e-6, 2e-6, 3e-6]\nfactors = [0.0, 1.0, 1.0, -0.5]\n";
  return cases::read_case_text(
      surroundings(end) +
          "[[load]]\nface = \"x_lower\"\nbox = { lower = [-1, 0.002, 0.001], upper = [1, 0.007, 0.006] }\n"
          "pressure = 2e8\ntimes = [0, 1e-6, 2e-6]\nfactors = [0, 0, 1]\n" +
          aluminium_box("block", {0.0, 2.0, 0.4}, {10.0, 9.0, 7.0}, "velocity = [-40, 10, -60]\n") +
          aluminium_box("plate", {10.0, 2.0, 0.4}, {12.0, 9.0, 7.0}, plate("[-60, 0, 0]", path)) +
          aluminium_box("stamp", {2.0, 3.0, 7.0}, {8.0, 8.0, 9.0},
                        "velocity = [20, 0, -80]\ndriven = true\n" + path) +
          "[[force_gauge]]\nname = \"plate\"\nbody = \"plate\"\n",
      "press.toml");
}

/// Returns a case of a block at rest that two slow tools, from rest too, reach across gaps of 5 and 4 nm and rub.
cases::Case rub() {
  const std::string path = "[body.path]\ntimes = [0, 1e-6]\nfactors = [0.0, 1.0]\n";
  return cases::read_case_text(
      surroundings(rubbed) +
          aluminium_box("block", {0.0, 2.0, 0.4}, {10.0, 9.0, 7.0}, "velocity = [0, 0, 0]\n") +
          aluminium_box("plate", {10.000005, 2.0, 0.4}, {12.000005, 9.0, 7.0},
                        plate("[-0.2, 0.05, 0.05]", path)) +
          aluminium_box("stamp", {2.0, 3.0, 7.000004}, {8.0, 8.0, 9.000004},
                        "velocity = [0.05, 0.05, -0.2]\ndriven = true\n" + path),
      "rub.toml");
}

using Velocities = std::map<std::uint64_t, Vector3>;

/// Returns the velocities of the particles of all ranks by their numbers, on the root. Collective.
Velocities velocities(const Simulation& of, MPI_Comm communicator) {
  struct Row {
    std::uint64_t id;
    std::array<double, 3> velocity;
  };
  std::vector<std::vector<Row>> sent(static_cast<std::size_t>(parallel::size(communicator)));
  for (std::size_t p = 0; p < of.particles().size(); ++p) {
    const Vector3& v = of.particles().velocity[p];
    sent[0].push_back({of.particles().id[p], {v[0], v[1], v[2]}});
  }
  Velocities all;
  for (const auto& part : parallel::exchange(communicator, sent)) {
    for (const auto& [id, v] : part) all[id] = {v[0], v[1], v[2]};
  }
  return all;
}

double largest_difference(const Velocities& a, const Velocities& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (const auto& [id, v] : a) largest = std::max(largest, (v - b.at(id)).norm());
  return largest;
}

class ToolRanks : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::temp_directory_path() / ("whipple_tool_ranks_" + ranks_.broadcast(std::to_string(::getpid())));
    ranks_.on_root([&] { fs::create_directories(folder_); });
  }
  void TearDown() override {
    MPI_Barrier(MPI_COMM_WORLD);
    ranks_.on_root([&] { fs::remove_all(folder_); });
  }

  io::Ranks ranks_{MPI_COMM_WORLD};
  fs::path folder_;
};

TEST_F(ToolRanks, AgreeWithOneRankAndGoOnFromTheirCheckpoints) {
  const cases::Case setup = press();
  Simulation together(setup, MPI_COMM_WORLD), alone(setup, MPI_COMM_SELF);
  advance_to(together, middle);
  const fs::path of_all = save(together, folder_ / "all");
  advance_to(together, end);
  advance_on_root(alone, middle);
  std::string of_one;
  ranks_.on_root([&] { of_one = save(alone, folder_ / "one").string(); });
  of_one = ranks_.broadcast(of_one);
  advance_on_root(alone, end);
  expect_agreement(together, alone, of_sums, of_time_step);

  Simulation again = restored(setup, of_all, MPI_COMM_WORLD);
  advance_to(again, end);
  expect_agreement(again, alone, of_sums, of_time_step);
  Simulation of_other = restored(setup, of_one, MPI_COMM_WORLD);
  advance_to(of_other, end);
  expect_agreement(of_other, alone, of_sums, of_time_step);
  const std::vector<run::HistoryColumn> columns = run::history_columns(setup);
  const std::vector<io::HistoryValue> row = run::history_row(columns, together);
  if (!is_root()) return;
  const Ledger& b = alone.state().ledger;
  const std::vector<io::HistoryValue> row_of_one = run::history_row(columns, alone);
  for (const std::string name : {"elastic_energy", "plastic_heat", "viscous_heat", "volume_energy"}) {
    const auto value = [&](const std::vector<io::HistoryValue>& of) {
      return std::ranges::find(of, name, &io::HistoryValue::name)->value;
    };
    EXPECT_NE(value(row_of_one), 0.0) << name;
    EXPECT_NEAR(value(row), value(row_of_one), 1e-10 * b.external_work) << name;
  }
  const double momentum = b.external_impulse.norm();
  EXPECT_GT(b.external_work, 0.0);
  EXPECT_GT(b.friction_heat, 0.1 * b.external_work);
  for (const Simulation* run : std::array<const Simulation*, 3>{&together, &again, &of_other}) {
    const Ledger& a = run->state().ledger;
    EXPECT_NEAR(a.external_work, b.external_work, 1e-10 * b.external_work);
    EXPECT_NEAR(a.friction_heat, b.friction_heat, 1e-10 * b.external_work);
    EXPECT_LE((a.external_impulse - b.external_impulse).norm(), 1e-10 * momentum);
    EXPECT_LE((run->state().gauged[0].impulse - alone.state().gauged[0].impulse).norm(), 1e-10 * momentum);
    EXPECT_LE(std::abs(a.energy_error(run->totals())), 1e-12);
  }
  Simulation resumed = restored(setup, of_one, MPI_COMM_SELF);
  advance_to(resumed, end);
  verification::expect_same(resumed, alone);
  EXPECT_EQ(resumed.state().ledger.external_work, b.external_work);
}

// A contact that begins leaves the velocity that closes the gap within the step: the round-off of the positions of the
// surfaces over the step, whatever the speed of the tools. Particles displaced by one unit of their last digit show it too.
TEST_F(ToolRanks, ThatRubFromRestDifferByTheRoundOffOfTheirGaps) {
  const cases::Case setup = rub();
  Simulation together(setup, MPI_COMM_WORLD);
  advance_to(together, rubbed);
  const Velocities of_ranks = velocities(together, MPI_COMM_WORLD);
  compute_on_root([&] {
    Simulation alone(setup, MPI_COMM_SELF);
    alone.advance(rubbed);
    io::Checkpoint begun = io::read_checkpoint(save(alone, folder_ / "begun"), MPI_COMM_SELF);
    for (std::size_t p = 0; p < begun.particles.size(); ++p) {
      for (double& x : begun.particles.position[p])
        x = std::nextafter(x, begun.particles.id[p] % 2 == 0 ? 1.0 : 0.0);
    }
    Simulation displaced(setup, std::move(begun.particles), run::from_checkpoint(begun.values), MPI_COMM_SELF,
                         std::move(begun.meshes), std::move(begun.bars));
    advance_to(alone, rubbed);
    advance_to(displaced, rubbed);
    const Velocities of_one = velocities(alone, MPI_COMM_SELF);
    const double round_off = std::numeric_limits<double>::epsilon() * 0.012 / alone.state().time_step;  // m/s
    const double of_partition = largest_difference(of_ranks, of_one),
                 of_last_digit = largest_difference(velocities(displaced, MPI_COMM_SELF), of_one);
    std::printf(
        "%d ranks: %.1e m/s, last digits displaced: %.1e m/s, round-off of gaps over a step: %.1e m/s\n",
        parallel::size(MPI_COMM_WORLD), of_partition, of_last_digit, round_off);
    EXPECT_LE(of_partition, round_off);
    EXPECT_LE(of_last_digit, round_off);
    EXPECT_GE(of_last_digit, 1e-3 * round_off);
    const Ledger &a = together.state().ledger, &b = alone.state().ledger;
    EXPECT_GT(b.friction_heat, 0.0);
    EXPECT_NEAR(a.friction_heat, b.friction_heat, 1e-9 * b.friction_heat);
    EXPECT_NEAR(a.external_work, b.external_work, 1e-10 * b.external_work);
  });
}

}  // namespace
}  // namespace whipple::solver
