// SPDX-License-Identifier: BSD-3-Clause
// A case built in code runs, and as the same case read from a text does.
#include "src/case/case.hpp"
#include "src/case/shapes/box.hpp"
#include "src/case/shapes/sphere.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::verification {
namespace {

constexpr const char* text = R"(
[domain]
lower = ["-4 mm", "-4 mm", "-4 mm"]
upper = ["4 mm", "4 mm", "4 mm"]
cell_size = "0.8 mm"
boundary = { x_lower = "symmetry" }
[time]
end = "0.5 us"
stress_rotation = "polar"
[transfer]
shape_function = "cubic_bspline"
[[body]]
name = "ball"
material = "copper.toml"
velocity = ["0 m/s", "0 m/s", "2 km/s"]
shape = { sphere = { center = ["-4 mm", "0 mm", "-1.6 mm"], radius = "1.5 mm" } }
[[body]]
name = "plate"
material = "aluminium.toml"
shape = { box = { lower = ["-4 mm", "-3.2 mm", "0 mm"], upper = ["3.2 mm", "3.2 mm", "1.6 mm"] } }
discretization = { per_cell = 27 }
)";

TEST(CaseInCode, RunsAsTheSameCaseFromATextDoes) {
  cases::Case setup;
  setup.domain.lower = Vector3(-4e-3, -4e-3, -4e-3);
  setup.domain.upper = Vector3(4e-3, 4e-3, 4e-3);
  setup.domain.cell_size = 0.8e-3;
  setup.domain.boundary.x_lower = grid::Boundary::symmetry;
  setup.time.end = 0.5e-6;
  setup.time.stress_rotation = material::StressRotation::polar;
  setup.transfer.shape_function = transfer::ShapeFunction::cubic_bspline;
  cases::Body ball;
  ball.name = "ball";
  ball.material = "copper.toml";
  ball.velocity = Vector3(0.0, 0.0, 2e3);
  ball.shape = std::make_shared<cases::Sphere>(Vector3(-4e-3, 0.0, -1.6e-3), 1.5e-3);
  cases::Body plate;
  plate.name = "plate";
  plate.material = "aluminium.toml";
  plate.shape = std::make_shared<cases::Box>(Vector3(-4e-3, -3.2e-3, 0.0), Vector3(3.2e-3, 3.2e-3, 1.6e-3));
  plate.discretization.per_cell = 27;
  setup.bodies = {ball, plate};
  ASSERT_TRUE(cases::check(setup).empty());

  const cases::Case read = cases::read_case_text(text, "case.toml");
  const std::vector<std::string> materials = {"copper.toml", "aluminium.toml"};
  EXPECT_EQ(cases::to_toml(cases::complete(setup), materials), cases::to_toml(read, materials));
  solver::Simulation in_code(cases::complete(setup), parallel::world());
  solver::Simulation from_text(read, parallel::world());
  for (int n = 0; n < 5; ++n) {
    in_code.advance(setup.time.end);
    from_text.advance(setup.time.end);
  }
  EXPECT_EQ(in_code.state().step, 5);
  expect_same(in_code, from_text);
}

}  // namespace
}  // namespace whipple::verification
