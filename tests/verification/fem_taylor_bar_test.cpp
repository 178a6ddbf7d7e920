// SPDX-License-Identifier: BSD-3-Clause
// Taylor bar of copper by finite elements, 25.4 x 7.6 mm, 190 m/s against a rigid wall: the experiment and
// the material constants of the particles' test (solver_taylor_bar_test.cpp; Johnson & Holmquist, J. Appl.
// Phys. 64 (1988) 3901: length 16.2, foot diameter 13.5, diameter 10.1 mm at 5.08 mm above the foot).
#include <gtest/gtest.h>

#include <cstdio>

#include "src/material/material_file.hpp"
#include "tests/unit/fem_support.hpp"

namespace whipple::fem_test {
namespace {

struct Shape {
  double length, foot, middle;  // mm
  double energy_error;
};

Shape taylor_bar(Quadrature quadrature, fem::HourglassControl hourglass, double size) {
  constexpr double mm = 1e-3, radius = 3.8 * mm, length = 25.46 * mm;
  Body body(read_material("copper_taylor"),
            fem::make_cylinder(radius, length, size * mm, {true, true, false}), quadrature);
  body.hourglass = hourglass;
  body.viscosity = {0.25, 1.0};
  body.set_velocity([](const Vector3&) { return Vector3(0, 0, -190.0); });
  std::vector<std::uint32_t> side;
  for (std::uint32_t a = 0; a < body.mesh.nodes.size(); ++a) {
    const Vector3& x = body.mesh.nodes.position[a];
    if (std::abs(x[1]) < 1e-9 && std::abs(x[0] - radius) < 1e-9) side.push_back(a);
  }
  for (int axis = 0; axis < 3; ++axis) {
    constrain(body.mesh, nodes_on_plane(body.mesh, axis, 0.0, 1e-9), fem::constraint::axis(axis));
  }
  const double before = totals(body.mesh).energy();
  int steps = 0;
  for (; body.time < 80e-6; ++steps) body.step(0.9 * body.critical_time_step());
  EXPECT_TRUE(body.report.valid());
  EXPECT_EQ(body.deformation.inverted, 0U);
  const fem::MeshTotals now = totals(body.mesh);
  // The wall stops its nodes in the first step: their kinetic energy is work of the boundary condition.
  Shape shape{0, 0, 0, std::abs(now.energy() - before - body.boundary.work) / before};
  for (const Vector3& x : body.mesh.nodes.position) {
    shape.length = std::max(shape.length, x[2] / mm);
    if (x[2] < 1e-9) shape.foot = std::max(shape.foot, 2.0 * std::hypot(x[0], x[1]) / mm);
  }
  std::ranges::sort(side, {}, [&](std::uint32_t a) { return body.mesh.nodes.position[a][2]; });
  for (std::size_t i = 1; i < side.size(); ++i) {  // between the two nodes around 5.08 mm
    const Vector3 &low = body.mesh.nodes.position[side[i - 1]], &high = body.mesh.nodes.position[side[i]];
    if (low[2] > 5.08 * mm || high[2] < 5.08 * mm) continue;
    const double share = (5.08 * mm - low[2]) / (high[2] - low[2]);
    shape.middle = 2.0 * (low[0] + share * (high[0] - low[0])) / mm;
  }
  const double hourglass_share =
      (now.hourglass_energy +
       (hourglass.kind == fem::HourglassControl::Kind::viscous ? body.deformation.hourglass_work : 0.0)) /
      before;
  std::printf(
      "%s, hourglass %s %.2f, elements of %.2f mm: length %.3f, foot %.3f, at 5.08 mm %.3f mm; %d steps, "
      "energy "
      "error %.1e, work of hourglass forces %.2f %%\n",
      name(quadrature), hourglass.kind == fem::HourglassControl::Kind::viscous ? "viscous" : "stiffness",
      hourglass.coefficient, size, shape.length, shape.foot, shape.middle, steps, shape.energy_error,
      100.0 * hourglass_share);
  return shape;
}

constexpr fem::HourglassControl viscous = {fem::HourglassControl::Kind::viscous, 0.1};

TEST(FiniteElementTaylorBar, MatchesTheExperiment) {
  for (const Quadrature quadrature : both) {
    const Shape shape = taylor_bar(quadrature, viscous, 0.76);
    EXPECT_NEAR(shape.length, 16.2, 0.02 * 16.2) << name(quadrature);
    EXPECT_NEAR(shape.foot, 13.5, 0.04 * 13.5) << name(quadrature);
    EXPECT_NEAR(shape.middle, 10.1, 0.03 * 10.1) << name(quadrature);
    EXPECT_LT(shape.energy_error, 1e-12);
  }
}

}  // namespace
}  // namespace whipple::fem_test
