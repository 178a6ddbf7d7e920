// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "tests/verification/contact_problems.hpp"

/// Problems of bodies that meet across a gap.
namespace whipple::verification {

/// Aluminium of 2 mm on 4 mm of the same, cells of 0.1 mm, a column of one cell along x; hydrodynamic, so that the
/// state behind the shock is that of the Hugoniot.
struct PlanarGap {
  static constexpr double dx = 1e-4, thickness = 2e-3, target = 4e-3;  // m
  double speed = 500.0;                                                // m/s
  double gap = 0.0;                                                    // cells
  double offset = 0.0;                                                 // of the grid, cells
  Method method = {};
  std::string contact = {};                   // table; empty: the default
  std::string of_flyer = {}, of_target = {};  // further lines of the bodies
  double after = 0.35e-6;                     // s, end of the run after the touch

  [[nodiscard]] PlanarGap across(double cells) const {
    PlanarGap other = *this;
    other.gap = cells;
    return other;
  }
  [[nodiscard]] double touch() const { return gap * dx / speed; }
  /// Returns the exact pressure behind the symmetric shock: u_s = c0 + s u_p.
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

/// Calls f(position, pressure, mass, volume) for the material of a body of particles or elements.
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

inline constexpr double never = std::numeric_limits<double>::infinity();
inline const std::string elements = "discretization = { method = \"finite_elements\" }\n";

/// Holds the results of a planar impact.
struct Impact {
  double largest = 0.0;  ///< pressure at any time, over the Hugoniot pressure
  /// Mean pressure behind the shock, away from front and surfaces, over the Hugoniot pressure.
  double plateau = 0.0;
  double early = -never;  ///< distance at the first pressure of 2 % before contact, in cells
  /// Delay of the shock at a depth of 1 mm relative to the exact time, over the transit time.
  double late = 0.0;
  double momentum = 0.0;               ///< of the target at the end, over all
  double energy = 0.0, balance = 0.0;  ///< largest errors of energy and momentum
};

inline Impact impact(const PlanarGap& set) {
  solver::Simulation simulation(set.problem().read(), parallel::world());
  Impact result;
  const double exact = set.pressure(), transit = 1e-3 / set.shock_speed();
  const double look = set.touch() + 0.25e-6;  // the shock is 1.4 mm deep or deeper
  double first = never, arrival = never, all = 0.0;
  bool seen = false;
  run_to(simulation, set.problem().end, [&](const solver::Simulation& s) {
    const double time = s.state().time;
    result.energy = std::max(result.energy, std::abs(s.state().ledger.energy_error(s.totals())));
    result.balance = std::max(result.balance, s.state().ledger.momentum_error(s.totals()));
    double at_depth = 0.0;
    for (const std::uint32_t body : {0U, 1U}) {
      for_each_point(s, body, [&](const Vector3& x, double p, double, double) {
        result.largest = std::max(result.largest, p / exact);
        if (p > 0.02 * exact) first = std::min(first, time);
        if (body == 1 && std::abs(x[0] - 1e-3 - set.dx) < set.dx) at_depth = std::max(at_depth, p);
      });
    }
    if (at_depth > 0.5 * exact) arrival = std::min(arrival, time);
    if (!seen && time >= look) {
      seen = true;
      double sum = 0.0, mass = 0.0;
      for_each_point(s, 1, [&](const Vector3& x, double p, double m, double) {
        const double depth = x[0] - 0.5 * set.speed * (time - set.touch());
        if (depth < 0.3e-3 || depth > 0.8e-3) return;
        sum += m * p;
        mass += m;
      });
      result.plateau = sum / mass / exact;
    }
  });
  double target = 0.0;
  for (const std::uint32_t body : {0U, 1U}) {
    const BodySums sums = sums_of(simulation, body);
    all += sums.momentum[0];
    if (body == 1) target = sums.momentum[0];
  }
  result.momentum = target / all;
  result.early = set.gap > 0.0 ? (set.touch() - first) * set.speed / set.dx : 0.0;
  result.late = (arrival - set.touch() - transit) / transit;
  std::printf(
      "%s on %s, %s %s, %.1f km/s, gap %.1f, offset %.2f: largest %.3f, plateau %.4f of P_H, first %+.3f "
      "cells "
      "early, shock %+.3f of the transit, target %.4f of the momentum, energy %.1e, momentum %.1e\n",
      set.of_flyer.empty() ? "particles" : "elements", set.of_target.empty() ? "particles" : "elements",
      set.method.shape_function.c_str(), set.method.particle_update.c_str(), 1e-3 * set.speed, set.gap,
      set.offset, result.largest, result.plateau, result.early, result.late, result.momentum, result.energy,
      result.balance);
  EXPECT_LT(result.energy, 1e-13);
  EXPECT_LT(result.balance, 1e-13);
  return result;
}

/// Compares with bodies that touch at the start, by the same method. The position of the surfaces relative to the nodes
/// has more influence than the gap: touching runs with several offsets of the grid bound the largest pressure.
struct Touching {
  double least = never, largest = 0.0;
  Impact impact;
  explicit Touching(PlanarGap set, const std::vector<double>& offsets = {0.5, 0.0}) {
    for (const double offset : offsets) {
      set.gap = 0.0;
      set.offset = offset;
      impact = verification::impact(set);
      least = std::min(least, impact.largest);
      largest = std::max(largest, impact.largest);
    }
  }
};

inline void expect_like_touching(const PlanarGap& set, const Touching& touching) {
  const Impact result = impact(set);
  constexpr double tolerance = 0.1;  // of the largest pressure: an overshoot of the first layer
  EXPECT_LT(result.largest, (1.0 + tolerance) * touching.largest);
  EXPECT_GT(result.largest, (1.0 - tolerance) * touching.least);
  EXPECT_NEAR(result.plateau, 1.0, 0.035);  // mean of some 40 particles: 0.966 to 1.000 when they touch
  EXPECT_NEAR(result.late, touching.impact.late, 0.045);
  EXPECT_NEAR(result.momentum, touching.impact.momentum, 0.006 * touching.impact.momentum);
  EXPECT_LT(result.early, 0.1);
}

}  // namespace whipple::verification
