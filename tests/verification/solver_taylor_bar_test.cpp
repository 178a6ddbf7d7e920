// SPDX-License-Identifier: BSD-3-Clause
// Taylor bar of copper, 190 m/s (Johnson & Holmquist 1988: length 16.2, impact-end diameter 13.5 mm). Proves: strength,
// mirror wall with wide kernels (fixed nodes, as in other codes, give impact-end diameters 12 to 40 % off),
// independence of the time step.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

struct Shape {
  double length, foot;  // mm
  double middle,
      outmost;  // mm: diameter 5.08 mm above the wall, of the cross-section and of the outermost particle
  double energy_error;
};

Shape taylor_bar(const Method& method) {
  const std::string text = method.time_toml(80e-6) + method.toml() + R"(
[output]
maximum_energy_error = 10.0
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["13.68 mm", "13.68 mm", "28.88 mm"]
cell_size = "0.76 mm"
boundary = { x_lower = "symmetry", y_lower = "symmetry", z_lower = "symmetry" }
[[body]]
name = "bar"
material = "copper_taylor.toml"
velocity = ["0 m/s", "0 m/s", "-190 m/s"]
shape = { cylinder = { center = ["0 mm", "0 mm", "12.73 mm"], axis = "z", radius = "3.8 mm", height = "25.46 mm" } }
)";
  const cases::Case setup = cases::read_case_text(text, "taylor_bar.toml");
  solver::Simulation simulation(setup, parallel::world());
  EnergyWatch watch;
  run_to(simulation, setup.time.end, std::ref(watch));
  // Half a particle spacing (0.19 mm) is between the outermost particle and the surface that it represents. The
  // cross-section is the volume per length, with a hat function of two cells.
  double top = 0, foot = 0, outmost = 0, section = 0;
  const Particles& q = simulation.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    const Vector3& x = q.position[p];
    const double radius = std::hypot(x[0], x[1]);
    top = std::max(top, x[2]);
    if (x[2] < 0.57e-3) foot = std::max(foot, radius);
    const double above = std::abs(x[2] - 5.08e-3);
    if (above < 0.38e-3) outmost = std::max(outmost, radius);
    section += 4.0 * q.volume[p] * std::max(1.0 - above / 0.76e-3, 0.0) / 0.76e-3;
  }
  const Shape shape{1e3 * top + 0.19, 2 * (1e3 * foot + 0.19), 2e3 * std::sqrt(section / std::numbers::pi),
                    2 * (1e3 * outmost + 0.19), watch.worst};
  std::printf(
      "%s %s %s, courant %.1f: length %.3f mm, foot %.3f mm, middle %.3f mm (outermost particle %.3f), "
      "energy error %.1e, momentum "
      "error "
      "%.1e\n",
      method.scheme.c_str(), method.shape_function.c_str(), method.particle_update.c_str(), method.courant,
      shape.length, shape.foot, shape.middle, shape.outmost, shape.energy_error,
      simulation.state().ledger.momentum_error(simulation.totals()));
  return shape;
}

TEST(TaylorBar, DefaultSchemeMatchesExperimentForEveryTimeStep) {
  for (const double courant : {0.2, 0.5, 0.8}) {
    Method method;
    method.courant = courant;
    const Shape shape = taylor_bar(method);
    EXPECT_NEAR(shape.length, 16.2, 0.02 * 16.2);
    EXPECT_NEAR(shape.foot, 13.5, 0.02 * 13.5);
    EXPECT_NEAR(shape.middle, 10.1, 0.03 * 10.1);
    // Results of the scheme (docs/theory/mpm.md, 7.2): equal within 0.1 % for every time step.
    EXPECT_NEAR(shape.length, 16.28, 0.003 * 16.28);
    EXPECT_NEAR(shape.foot, 13.325, 0.003 * 13.325);
    EXPECT_LT(shape.energy_error, 1e-12);
  }
}

// Length, impact-end and middle diameter within 3 % of the experiment with every kind of shape function; the mirror
// wall is correct for all.
TEST(TaylorBar, EveryShapeFunctionMatchesTheExperiment) {
  for (const char* shape_function : {"gimp", "cubic_bspline"}) {
    const bool affine = std::string(shape_function) == "cubic_bspline";
    Method method = affine ? Method{} : Method::musl();
    method.shape_function = shape_function;
    const Shape shape = taylor_bar(method);
    EXPECT_NEAR(shape.length, 16.2, 0.03 * 16.2) << shape_function;
    EXPECT_NEAR(shape.foot, 13.5, 0.03 * 13.5) << shape_function;
    EXPECT_NEAR(shape.middle, 10.1, 0.03 * 10.1) << shape_function;
  }
}

TEST(TaylorBar, LinearMuslReproducesPublishedCodes) {
  // MPM3D-F90, Karamelo and NairnMPM agree on 16.43 mm with this scheme, impact-end diameters 13.41 to 13.50 mm.
  Method method = Method::musl();
  const Shape shape = taylor_bar(method);
  EXPECT_NEAR(shape.length, 16.43, 0.005 * 16.43);
  EXPECT_NEAR(shape.foot, 13.47, 0.01 * 13.47);
  EXPECT_NEAR(shape.middle, 10.1, 0.03 * 10.1);
}

}  // namespace
}  // namespace whipple::verification
