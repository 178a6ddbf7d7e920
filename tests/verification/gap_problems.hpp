// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/verification/contact_problems.hpp"

/// Bodies that meet across a gap.
namespace whipple::verification {

/// Aluminium of 2 mm on 4 mm of the same, cells of 0.1 mm, a column of one cell along x; hydrodynamic, so
/// that the state behind the shock is that of the Hugoniot.
struct PlanarGap {
  static constexpr double dx = 1e-4, thickness = 2e-3, target = 4e-3;  // m
  double speed = 500.0;                                                // m/s
  double gap = 0.0;                                                    // cells
  double offset = 0.0;                                                 // of the grid, cells
  Method method = {};
  std::string contact = {};                   // table; empty: the default
  std::string of_flyer = {}, of_target = {};  // further lines of the bodies
  double after = 0.35e-6;                     // s, end of the run after the touch

  [[nodiscard]] double touch() const { return gap * dx / speed; }
  /// Exact state behind the symmetric shock: u_s = c0 + s u_p.
  [[nodiscard]] double pressure() const { return 2785.0 * (5328.0 + 1.338 * 0.5 * speed) * 0.5 * speed; }
  [[nodiscard]] double shock_speed() const { return 5328.0 + 1.338 * 0.5 * speed; }
  [[nodiscard]] Problem problem() const {
    Problem problem;
    problem.method = method;
    problem.end = touch() + after;
    const double flight = gap * dx, shift = offset * dx;
    const double room = std::ceil((0.6 * speed * problem.end + 2e-3) / dx) * dx;
    problem.domain = "[domain]\nlower = " + vector3({-thickness - flight - 10 * dx - shift, 0, 0}) +
                     "\nupper = " + vector3({target + room, dx, dx}) + "\ncell_size = " + number(dx) + "\n" +
                     column_sides;
    problem.contact = contact;
    const std::string material = aluminium("gap_aluminium", "1 Pa");
    problem.bodies = {
        {"flyer", material, box({-thickness - flight, 0, 0}, {-flight, dx, dx}), {speed, 0, 0}, of_flyer},
        {"target", material, box({0, 0, 0}, {target, dx, dx}), Vector3::Zero(), of_target}};
    return problem;
  }
};

/// Calls f(position, pressure, mass, volume) for the matter of a body of particles or elements.
template <class Function>
void for_each_point(const solver::Simulation& s, std::uint32_t body, Function&& f) {
  const Particles& q = s.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (q.body[p] == body) f(q.position[p], q.pressure[p], q.mass[p], q.volume[p]);
  }
  for (const fem::Mesh& mesh : s.meshes()) {
    if (mesh.body != body) continue;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      Vector3 centre = Vector3::Zero();
      for (const std::uint32_t a : mesh.elements.corners[e]) centre += 0.125 * mesh.nodes.position[a];
      f(centre, mesh.points.pressure[e], mesh.points.mass[e], mesh.points.volume[e]);
    }
  }
}

}  // namespace whipple::verification
