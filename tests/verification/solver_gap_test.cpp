// SPDX-License-Identifier: BSD-3-Clause
// Bodies that meet across a gap (docs/theory/contact.md): nothing acts before it touches, and then the gap
// makes no difference.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "src/parallel/threads.hpp"
#include "tests/verification/gap_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
const std::string elements = "discretization = { method = \"finite_elements\" }\n";

/// What a planar impact gave.
struct Impact {
  double largest = 0.0;   ///< pressure at any time, over that of the Hugoniot
  double plateau = 0.0;   ///< mean pressure behind the shock, away from front and surfaces, over the same
  double early = -never;  ///< first pressure of 2 % before the touch, in cells of the gap
  double late = 0.0;      ///< arrival of the shock in 1 mm depth after the exact time, over the transit
  double momentum = 0.0;  ///< of the target at the end, over all
  double energy = 0.0, balance = 0.0;  ///< largest errors of energy and momentum
};

Impact impact(const PlanarGap& set) {
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

TEST(Gap, Explore) {
  for (const double speed : {200.0, 500.0, 2000.0, 6000.0}) {
    for (const double gap : {0.0, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0}) impact({.speed = speed, .gap = gap});
    for (const double gap : {0.0, 2.0, 5.0})
      impact({.speed = speed, .gap = gap, .contact = "[contact]\nmethod = \"multi_field\"\n"});
    for (const double gap : {0.0, 2.0})
      impact({.speed = speed, .gap = gap, .contact = "[contact]\nmethod = \"none\"\n"});
  }
  for (const double gap : {0.0, 2.0}) {
    for (const auto& [a, b] : {std::pair(elements, std::string()), std::pair(std::string(), elements),
                               std::pair(elements, elements)})
      impact({.gap = gap, .of_flyer = a, .of_target = b});
    for (const double offset : {0.25, 0.5}) impact({.gap = gap, .offset = offset});
    impact({.gap = gap, .method = {.shape_function = "cubic_bspline"}});
    impact({.gap = gap, .method = {.shape_function = "gimp", .particle_update = "flip"}});
    impact({.gap = gap, .method = {.particle_update = "flip"}});
    impact({.gap = gap, .method = {.particle_update = "apic"}});
    impact({.gap = gap, .method = {.particle_update = "pic"}});
  }
}

}  // namespace
}  // namespace whipple::verification
