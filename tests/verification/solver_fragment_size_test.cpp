// SPDX-License-Identifier: BSD-3-Clause
// A body that expands uniformly fails with the size of fragments of its rate (docs/theory/cracks.md, eq. 8) of particles and
// of elements that become particles; the motion does not change.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/core/base/error.hpp"
#include "tests/verification/same_state.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

using solver::Simulation;

constexpr double rate = 1e5, energy = 1.2e4, end = 80e-9;  // 1/s along each axis, J/m^2, s

/// An octant of a cube of 6 mm, its centre in the corner of the mirror planes, that fails at 1 GPa after 43 ns; waves from
/// its faces have come 0.4 mm far then.
cases::Case expanding_cube(const std::string& of_failure, const std::string& of_body = "") {
  const std::string material =
      aluminium("expands" + std::to_string(of_failure.size()), "100 GPa",
                "[[failure]]\nmodel = \"tensile_pressure\"\nsource = \"test\"\nspall_strength = \"1 GPa\"\n" +
                    of_failure);
  return cases::read_case_text(fmt::format(R"(
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["4 mm", "4 mm", "4 mm"]
cell_size = "0.5 mm"
boundary = {{ x_lower = "symmetry", y_lower = "symmetry", z_lower = "symmetry" }}
[time]
end = "80 ns"
courant = 0.05
[[body]]
name = "cube"
material = "{0}"
expansion_rate = ["1e5 1/s", "1e5 1/s", "1e5 1/s"]
shape = {{ box = {{ lower = ["-3 mm", "-3 mm", "-3 mm"], upper = ["3 mm", "3 mm", "3 mm"] }} }}
{1}
)",
                                           material, of_body),
                               "expanding.toml");
}

const std::string keeps = fmt::format(
    "[[failure]]\nmodel = \"fragment_size\"\nsource = \"test\"\nenergy_per_area = \"{} J/m^2\"\n", energy);

/// Checks the sizes of points near the centre: places x grow as 1 + rate t, so that their gradient is rate/(1 + rate t).
template <class Points>
std::size_t expect_sizes(const Points& points, const std::vector<Vector3>& place) {
  const double at = 43e-9, stretch = 1.0 + rate * at;  // of failure; all fail within a step of 5 ns
  const double volumetric = 3.0 * rate / stretch, density = 2785.0 / std::pow(stretch, 3);
  const double expected = std::cbrt(24.0 * energy / (density * volumetric * volumetric));
  std::size_t found = 0;
  for (std::size_t i = 0; i < points.mass.size(); ++i) {
    if (place[i].maxCoeff() > 1.5e-3) continue;
    ++found;
    EXPECT_NE(points.failed[i], 0);
    EXPECT_NEAR(points.history.scalar("fragment_size")[i], expected, 2e-3 * expected);
  }
  return found;
}

TEST(FragmentSize, OfUniformExpansionIsThatOfItsRate) {
  Simulation simulation(expanding_cube(keeps), parallel::world());
  run_to(simulation, end);
  EXPECT_EQ(expect_sizes(simulation.particles(), simulation.particles().position), 216U);
}

TEST(FragmentSize, ChangesNoOtherNumber) {
  Simulation with(expanding_cube(keeps), parallel::world()), without(expanding_cube(""), parallel::world());
  run_to(with, end);
  run_to(without, end);
  for_each_field(without.particles(), [&](const auto& field) {
    const auto& x = field.of(without.particles());
    const auto& y = field.of(with.particles());
    ASSERT_EQ(x.size(), y.size()) << field.name;
    EXPECT_TRUE(x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0) << field.name;
  });
  EXPECT_EQ(without.particles().history.find("fragment_size"), nullptr);
  ASSERT_NE(with.particles().history.find("fragment_size"), nullptr);
}

TEST(FragmentSize, GoesFromElementsToTheParticlesThatTheyBecome) {
  const cases::Case setup = expanding_cube(keeps, "discretization = { method = \"adaptive\" }\n");
  Simulation simulation(setup, parallel::world());
  run_to(simulation, end);
  EXPECT_GT(expect_sizes(simulation.particles(), simulation.particles().position), 20U);
}

TEST(FragmentSize, RestartsBitwise) {
  const cases::Case setup = expanding_cube(keeps);
  Simulation whole(setup, parallel::world());
  run_to(whole, 60e-9);
  const TemporaryFolder folder;
  Simulation restarted = restored(setup, save(whole, folder.path()), parallel::world());
  run_to(whole, end);
  run_to(restarted, end);
  expect_same(whole, restarted);
  EXPECT_EQ(expect_sizes(restarted.particles(), restarted.particles().position), 216U);
}

}  // namespace
}  // namespace whipple::verification
