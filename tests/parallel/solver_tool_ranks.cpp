// SPDX-License-Identifier: BSD-3-Clause
// Tools on prescribed paths and pressures on patches of walls: several ranks agree with one, and runs go on from their
// checkpoints, on one rank bit for bit.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
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

constexpr double middle = 1.5e-6, end = 3e-6;  // s
// Sums agree to 1e-14; the time step is that of one point at the edge of a contact, where round-off is a part of 1e-10 of
// it in single steps.
constexpr double of_sums = 1e-11, of_time_step = 1e-9;

/// Returns a case of a block between a plate of elements and a stamp of particles, both on paths, with a pressure behind it that begins in the second half.
cases::Case press() {
  using namespace verification;
  const std::string material = aluminium("aluminium_of_tools", "0.3 GPa");
  const auto body = [&](const char* name, const Vector3& lower, const Vector3& upper,
                        const std::string& keys) {
    return std::string("[[body]]\nname = \"") + name + "\"\nmaterial = \"" + material + "\"\nshape = { " +
           box(1e-3 * lower, 1e-3 * upper) + " }\n" + keys;
  };
  const std::string path = "[body.path]\ntimes = [0, 1e-6, 2e-6, 3e-6]\nfactors = [0.0, 1.0, 1.0, -0.5]\n";
  return cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() +
          "[contact]\nmethod = \"multi_field\"\nfriction = 0\n"
          "[domain]\nlower = [0, 0, 0]\nupper = [0.024, 0.012, 0.012]\ncell_size = 0.001\n"
          "boundary = { x_lower = \"separating\", z_lower = \"separating\" }\n"
          "[[load]]\nface = \"x_lower\"\nbox = { lower = [-1, 0.002, 0.001], upper = [1, 0.007, 0.006] }\n"
          "pressure = 2e8\ntimes = [0, 1e-6, 2e-6]\nfactors = [0, 0, 1]\n" +
          body("block", {0.0, 2.0, 0.4}, {10.0, 9.0, 7.0}, "velocity = [-40, 10, -60]\n") +
          body("plate", {10.0, 2.0, 0.4}, {12.0, 9.0, 7.0},
               "discretization = { method = \"finite_elements\" }\n"
               "[[body.node_condition]]\nlower = [0, 0, 0]\nupper = [1, 1, 1]\n"
               "directions = [\"x\", \"y\", \"z\"]\nvelocity = [-60, 0, 0]\n" +
                   path) +
          body("stamp", {2.0, 3.0, 7.0}, {8.0, 8.0, 9.0}, "velocity = [20, 0, -80]\ndriven = true\n" + path) +
          "[[force_gauge]]\nname = \"plate\"\nbody = \"plate\"\n",
      "press.toml");
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

}  // namespace
}  // namespace whipple::solver
