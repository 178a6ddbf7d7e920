// SPDX-License-Identifier: BSD-3-Clause
// Impacts by finite elements: the planar one against the exact Hugoniot state and release isentrope, the
// Taylor bar against the experiment.
#include <gtest/gtest.h>

#include <cstdio>

#include "src/material/material_file.hpp"
#include "tests/unit/fem_support.hpp"

namespace whipple::fem_test {
namespace impact_test {

/// Aluminium (material and exact energies after release: solver_planar_impact_test.cpp) against a rigid wall:
/// a slab of 5 mm, 100 elements, one row.
struct PlanarImpact {
  double pressure, density, shock_speed;     // relative errors of the plateau
  double released_energy, released_scatter;  // relative
  double energy_error;
};

PlanarImpact planar_impact(Quadrature quadrature, double up) {
  constexpr double rho0 = 2785.0, c0 = 5328.0, s = 1.338, slab = 5e-3, size = 50e-6;
  constexpr std::size_t n = 100;
  const double released = up < 2000.0 ? 55795.0 : 823260.0;
  const double plateau_time = up > 2000.0 ? 0.3e-6 : 0.45e-6, end = up > 2000.0 ? 0.78e-6 : 1.25e-6;
  Body body(read_material("aluminium_mie_gruneisen"),
            fem::make_box(Vector3::Zero(), Vector3(slab, size, size), {n, 1, 1}), quadrature);
  body.viscosity = {0.25, 1.0};
  body.set_velocity([&](const Vector3&) { return Vector3(-up, 0, 0); });
  for (auto& bits : body.mesh.nodes.constrained) bits = fem::constraint::y | fem::constraint::z;
  constrain(body.mesh.nodes, nodes_on_plane(body.mesh, 0, 0.0, 1e-9), fem::constraint::x);
  const double start = totals(body.mesh).energy(), us = c0 + s * up;
  const double pressure = rho0 * us * up, density = rho0 * us / (us - up);
  const std::size_t rows = points_per_element(quadrature);
  const auto& points = body.mesh.points;
  const auto run_to = [&](double time) {
    while (body.time < time) body.step(std::min(0.9 * body.critical_time_step(), time - body.time));
  };
  const auto swept = [&] {  // length at the start of what has been shocked
    double mass = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      mass += points.pressure[i] > 0.5 * pressure ? points.mass[i] : 0.0;
    return mass / (rho0 * size * size);
  };
  PlanarImpact result{};
  run_to(0.4 * plateau_time);
  const double early = swept();
  run_to(plateau_time);
  result.shock_speed = (swept() - early) / (0.6 * plateau_time) / us - 1.0;
  const double front = us * plateau_time;
  double count = 0.0, p = 0.0, rho = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double depth = (static_cast<double>(body.mesh.elements.id[i / rows]) + 0.5) * size;
    if (depth < 6 * size || depth > front - 8 * size) continue;
    count += 1.0;
    p += points.pressure[i];
    rho += points.mass[i] / points.volume[i];
  }
  result.pressure = p / count / pressure - 1.0;
  result.density = rho / count / density - 1.0;
  run_to(end);
  double e1 = 0.0, e2 = 0.0;
  count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double depth =
        (static_cast<double>(body.mesh.elements.id[i / rows]) + 0.5) / static_cast<double>(n);
    if (depth < 0.8 || depth > 0.95) continue;
    count += 1.0;
    e1 += points.specific_internal_energy[i];
    e2 += points.specific_internal_energy[i] * points.specific_internal_energy[i];
  }
  result.released_energy = e1 / count / released - 1.0;
  result.released_scatter = std::sqrt(std::max(0.0, e2 / count - e1 / count * (e1 / count))) / released;
  result.energy_error = std::abs(totals(body.mesh).energy() - start - body.boundary.work) / start;
  std::printf(
      "planar impact, %s, %.0f m/s: p %+.2f %%, rho %+.2f %%, Us %+.2f %%, released e %+.1f %% (scatter %.1f "
      "%%), "
      "energy error %.1e\n",
      name(quadrature), up, 100 * result.pressure, 100 * result.density, 100 * result.shock_speed,
      100 * result.released_energy, 100 * result.released_scatter, result.energy_error);
  return result;
}

TEST(FiniteElementPlanarImpact, HugoniotAndRelease) {
  for (const Quadrature quadrature : both) {
    for (const double up : {1000.0, 3000.0}) {
      const PlanarImpact result = planar_impact(quadrature, up);
      EXPECT_LT(std::abs(result.pressure), 0.003);
      EXPECT_LT(std::abs(result.density), 0.003);
      EXPECT_LT(std::abs(result.shock_speed), 0.012);  // one element in 80 swept
      EXPECT_LT(std::abs(result.released_energy), 0.045);
      EXPECT_LT(result.energy_error, 1e-12);
    }
  }
}

/// Copper, 25.4 x 7.6 mm, 190 m/s (Johnson & Holmquist, J. Appl. Phys. 64 (1988) 3901: length 16.2, foot
/// diameter 13.5, diameter 10.1 mm at 5.08 mm above the foot); constants of solver_taylor_bar_test.cpp.
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
  double outermost = 0.0;  // a little more than the radius: corners of the mesh's section
  for (const Vector3& x : body.mesh.nodes.position) outermost = std::max(outermost, x[0]);
  std::vector<std::uint32_t> side;
  for (std::uint32_t a = 0; a < body.mesh.nodes.size(); ++a) {
    const Vector3& x = body.mesh.nodes.position[a];
    if (std::abs(x[1]) < 1e-9 && std::abs(x[0] - outermost) < 1e-9) side.push_back(a);
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

TEST(FiniteElementTaylorBar, MatchesTheExperiment) {
  struct Variant {
    Quadrature quadrature;
    fem::HourglassControl hourglass;
    double size;  // mm
  };
  for (const auto& [quadrature, hourglass, size] :
       {Variant{Quadrature::one_point, viscous, 0.76}, Variant{Quadrature::one_point, stiffness, 0.76},
        Variant{Quadrature::b_bar, viscous, 0.95}}) {
    const Shape shape = taylor_bar(quadrature, hourglass, size);
    EXPECT_NEAR(shape.length, 16.2, 0.02 * 16.2) << name(quadrature);
    EXPECT_NEAR(shape.foot, 13.5, 0.04 * 13.5) << name(quadrature);
    EXPECT_NEAR(shape.middle, 10.1, 0.03 * 10.1) << name(quadrature);
    EXPECT_LT(shape.energy_error, 1e-12);
  }
}

}  // namespace impact_test
}  // namespace whipple::fem_test
