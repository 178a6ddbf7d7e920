// SPDX-License-Identifier: BSD-3-Clause
// A tool of elements on a prescribed path compresses an elastic block: its path, its work, its force.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification::tool {
namespace {

constexpr double length = 8e-3, width = 3e-3, end = 40e-6;  // m, s
constexpr double speed = 2.0, path = 0.5 * speed * end;     // m/s, m
// Density times the square of the sound speed, plus 4/3 of the shear modulus.
constexpr double uniaxial = 2785.0 * 5328.0 * 5328.0 + 4.0 / 3.0 * 27.6e9;  // Pa

/// Returns a block of particles between a mirror plane and a plate of elements that touches it, with these keys of the
/// plate. All sides are mirror planes, so that the block is in uniaxial strain.
/// @param tables  of the plate, behind its keys
std::string block_and_plate(const std::string& of_plate, const std::string& tables,
                            const std::string& cell = "1 mm") {
  return fmt::format(R"toml(
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["12 mm", "3 mm", "3 mm"]
cell_size = "{3}"
boundary = {{ x_lower = "symmetry", y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }}
[time]
end = "40 us"
[contact]
method = "multi_field"
[[body]]
name = "block"
material = "{0}"
shape = {{ box = {{ lower = ["0 mm", "0 mm", "0 mm"], upper = ["8 mm", "3 mm", "3 mm"] }} }}
[[body]]
name = "plate"
material = "{0}"
{1}
shape = {{ box = {{ lower = ["8 mm", "0 mm", "0 mm"], upper = ["10 mm", "3 mm", "3 mm"] }} }}
{2})toml",
                     elastic_aluminium(), of_plate, tables, cell);
}

const std::string elements = "discretization = { method = \"finite_elements\" }\n";

const std::string held = R"toml(
[[body.node_condition]]
lower = ["7 mm", "-1 mm", "-1 mm"]
upper = ["11 mm", "4 mm", "4 mm"]
directions = ["x", "y", "z"]
velocity = ["-2 m/s", "0 m/s", "0 m/s"]
)toml";

// The plate advances ever faster to its full speed in half of the time, and then stands still again in the other half:
// a quarter of speed times time in each.
const std::string ramp = "[body.path]\ntimes = [\"0 us\", \"20 us\", \"40 us\"]\nfactors = [0.0, 1.0, 0.0]\n";

/// Runs the plate of elements along its path with these cells, and expects it to end on the path and the balances to be
/// exact.
/// @returns work of the tool, J
double work_of_tool(const std::string& cell) {
  solver::Simulation simulation(
      cases::read_case_text(block_and_plate(elements, ramp + held, cell), "tool.toml"), parallel::world());
  run_to(simulation, end);
  solver::View view;
  for (const solver::Carrier* carrier : simulation.carriers()) carrier->show(view);
  double front = 1.0;
  EXPECT_EQ(view.meshes.size(), 1U);
  for (const Vector3& x : view.meshes[0].nodes.position) front = std::min(front, x[0]);
  EXPECT_NEAR(front, length - path, 1e-14);
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_LT(std::abs(ledger.energy_error(simulation.totals())), 1e-12);
  EXPECT_LT(std::abs(ledger.momentum_error(simulation.totals())), 1e-11);
  return ledger.external_work;
}

// The force of the block is E eps A with the uniaxial modulus, so that the work of the tool is that of a spring. The
// motion is slow against the waves. The nodes of the grid within a cell of the tool move with it, which shortens the
// spring by a part of a cell: an error of first order.
TEST(Tool, FollowsItsPathAndItsWorkIsThatOfTheSpringThatItCompresses) {
  const double strain = path / length, spring = 0.5 * uniaxial * strain * strain * length * width * width;
  const double coarse = work_of_tool("1 mm") / spring - 1.0, fine = work_of_tool("0.5 mm") / spring - 1.0;
  RecordProperty("coarse", fmt::format("{:.6f}", coarse));
  RecordProperty("fine", fmt::format("{:.6f}", fine));
  EXPECT_LT(std::abs(coarse), 0.1);
  EXPECT_LT(std::abs(fine), 0.6 * std::abs(coarse));
}

TEST(Tool, OfParticlesFollowsItsTable) {
  const std::string text =
      block_and_plate("velocity = [\"-2 m/s\", \"0 m/s\", \"0 m/s\"]\ndriven = true\n", ramp);
  solver::Simulation simulation(cases::read_case_text(text, "tool.toml"), parallel::world());
  EXPECT_EQ(simulation.particles().velocity.back(), Vector3::Zero());  // the table begins with 0
  run_to(simulation, 0.25 * end);
  double mass = 0.0, momentum = 0.0;
  const Particles& p = simulation.particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.body[i] != 1) continue;
    mass += p.mass[i];
    momentum += p.mass[i] * p.velocity[i][0];
  }
  EXPECT_NEAR(momentum / mass, -0.5 * speed, 0.05 * speed);
  EXPECT_LT(std::abs(simulation.state().ledger.energy_error(simulation.totals())), 1e-12);
}

TEST(Tool, PathsOfNothingAndTablesOutOfOrderAreNamed) {
  const auto refused = [](const std::string& text, const std::string& reason) {
    try {
      cases::read_case_text(text, "tool.toml");
      ADD_FAILURE() << "passed: " << reason;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  };
  refused(block_and_plate(elements, ramp), "a path is that of prescribed velocities");
  refused(
      block_and_plate(elements, "[body.path]\ntimes = [\"1 us\", \"0 us\"]\nfactors = [0.0, 1.0]\n" + held),
      "not in the order of time");
  refused(block_and_plate(elements, "[body.path]\ntimes = [\"0 us\", \"1 us\"]\nfactors = [0.0]\n" + held),
          "expected one factor per time");
}

}  // namespace
}  // namespace whipple::verification::tool
