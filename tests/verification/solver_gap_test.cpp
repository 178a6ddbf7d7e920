// SPDX-License-Identifier: BSD-3-Clause
// Bodies that meet across a gap (docs/theory/contact.md): there is no interaction before contact, and then the gap
// makes no difference.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "tests/verification/gap_problems.hpp"

namespace whipple::verification {
namespace {

TEST(Gap, MakesNoDifferenceToAPlanarImpact) {
  for (const double speed : {500.0, 6000.0}) {
    const PlanarGap set{.speed = speed};
    const Touching touching(set);
    for (const double gap : {0.5, 5.0}) expect_like_touching(set.across(gap), touching);
  }
}

TEST(Gap, MakesNoDifferenceToElements) {
  for (const auto& [flyer, target] : {std::pair(elements, std::string()), std::pair(elements, elements)}) {
    const PlanarGap set{.of_flyer = flyer, .of_target = target};
    expect_like_touching(set.across(2.3), Touching(set));
  }
}

// Touching planar bodies: along the normal the common field equals that of one body.
TEST(Gap, BodiesThatTouchAreAsOneFieldWhileTheyPress) {
  for (const double speed : {500.0, 6000.0}) {
    // In one field shocks would conduct heat from one body to the other.
    const std::string quiet = "[dissipation]\nshock_conduction = 0\n";
    const Impact own = impact({.speed = speed, .contact = quiet}),
                 one = impact({.speed = speed, .contact = quiet + "[contact]\nmethod = \"none\"\n"});
    EXPECT_NEAR(own.largest, one.largest, 1e-9);
    EXPECT_NEAR(own.plateau, one.plateau, 1e-9);
    EXPECT_NEAR(own.momentum, one.momentum, 1e-9);
  }
}

// Material under pressure fills its cells; in one velocity field it is compressed across voids that never close.
TEST(Gap, MatterUnderPressureFillsItsCells) {
  const auto fill = [](double speed, double gap, const char* contact) {
    const PlanarGap set{.speed = speed, .gap = gap, .contact = contact, .after = 0.25e-6};
    solver::Simulation simulation(set.problem().read(), parallel::world());
    run_to(simulation, set.problem().end);
    const double least = simulation.least_fill(0.5 * set.pressure());
    std::printf("%.1f km/s, gap %.1f %s: least fill %.4f, squeezed beside voids %.3g of the mass\n",
                1e-3 * speed, gap, contact, least,
                simulation.state().squeezed_beside_voids / simulation.totals().mass);
    return least;
  };
  for (const double speed : {500.0, 6000.0}) {
    for (const double gap : {0.0, 2.0, 5.0}) EXPECT_GT(fill(speed, gap, ""), 0.98);
    EXPECT_LT(fill(speed, 5.0, "[contact]\nmethod = \"none\"\n"), 0.8);
  }
}

/// Two spheres of 4 mm, cells of 0.5 mm, that approach along a line between their centres.
struct Approach {
  static constexpr double dx = 5e-4, radius = 2e-3, speed = 500.0, gap = 0.8e-3;  // m, m/s
  [[nodiscard]] static Problem problem(const Vector3& direction, const Vector3& offset) {
    Problem problem;
    problem.end = gap / speed + 0.15e-6;
    problem.domain =
        "[domain]\nlower = [-0.006, -0.006, -0.006]\nupper = [0.006, 0.006, 0.006]\ncell_size = " +
        number(dx) + "\n";
    const Vector3 n = direction.normalized(), centre = dx * offset;
    const std::string material = aluminium("gap_sphere", "0.3 GPa");
    problem.bodies = {{"first", material, sphere(centre - (radius + gap) * n, radius), speed * n},
                      {"second", material, sphere(centre + radius * n, radius), Vector3::Zero()}};
    return problem;
  }
};

TEST(Gap, NothingActsBeforeItTouches) {
  for (const Vector3& direction :
       {Vector3(0, 0, 1), Vector3(1, 0, 1), Vector3(1, 1, 1), Vector3(1, 0.3, 0.1)}) {
    for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(0.37, 0.21, 0.11)}) {
      const Problem problem = Approach::problem(direction, offset);
      solver::Simulation simulation(problem.read(), parallel::world());
      const double touch = Approach::gap / Approach::speed, sign = 0.02 * 2785.0 * 5328.0 * 250.0;
      double first = never, begin = -never, pushed = 0.0, strained = 0.0;
      run_to(simulation, problem.end, [&](const solver::Simulation& s) {
        const double open = Approach::gap - Approach::speed * s.state().time;
        double strain = 0.0;
        const Particles& q = s.particles();
        for (std::size_t p = 0; p < q.size(); ++p) {
          strain = std::max(strain, std::abs(q.mass[p] / q.volume[p] / 2785.0 - 1.0));
          if (q.pressure[p] > sign) first = std::min(first, s.state().time);
        }
        if (s.state().ledger.contact_impulse > 0.0) begin = std::max(begin, open / Approach::dx);
        if (open > 0.15 * Approach::dx) {
          pushed = s.state().ledger.contact_impulse / s.totals().momentum_scale;
          strained = std::max(strained, strain);
        }
      });
      const double early = (touch - first) * Approach::speed / Approach::dx;
      std::printf(
          "spheres along (%g, %g, %g), offset %g: first pressure %+.3f cells early, first impulse %+.3f; "
          "while more than 0.15 cells apart impulse %.1e of the momentum, strain %.1e\n",
          direction[0], direction[1], direction[2], offset[0], early, begin, pushed, strained);
      // Where a body contributes less than a ten-thousandth to a node, at the edge of the function of one particle, its
      // normal is that of the grid, and the gap along it may appear closed early.
      EXPECT_LT(pushed, 1e-8);
      EXPECT_LT(strained, 1e-4);
      EXPECT_LT(std::abs(early), 0.1);
    }
  }
}

/// A quarter of an aluminium sphere of 4 mm at 3 km/s on a plate of 1 mm, cells of 0.5 mm.
struct SphereOnPlate {
  double momentum = 0.0, internal = 0.0, largest = 0.0;
  explicit SphereOnPlate(double gap, const char* contact = "") {
    constexpr double speed = 3000.0;
    Problem problem;
    problem.end = gap / speed + 2e-6;
    problem.domain =
        "[domain]\nlower = [0, 0, -0.012]\nupper = [0.012, 0.012, 0.012]\ncell_size = 0.0005\n"
        "boundary = { x_lower = \"symmetry\", y_lower = \"symmetry\" }\n";
    problem.contact = contact;
    const std::string material = aluminium("gap_sphere", "0.3 GPa");
    problem.bodies = {{"sphere", material, sphere({0, 0, -2e-3 - gap}, 2e-3), {0, 0, speed}},
                      {"plate", material, box({-6e-3, -6e-3, 0}, {6e-3, 6e-3, 1e-3})}};
    solver::Simulation simulation(problem.read(), parallel::world());
    EnergyWatch watch;
    run_to(simulation, problem.end, [&](const solver::Simulation& s) {
      watch(s);
      for (const double p : s.particles().pressure) largest = std::max(largest, p);
    });
    momentum = sums_of(simulation.particles(), 0, 0).momentum[2];
    internal = simulation.totals().internal_energy;
    std::printf(
        "sphere on plate across %.1f mm %s: momentum %.5g N s, internal energy %.5g J, largest %.4g GPa, "
        "contact heat %.3g, friction heat %.3g J, energy %.1e\n",
        1e3 * gap, contact, momentum, internal, 1e-9 * largest, simulation.state().ledger.contact_heat,
        simulation.state().ledger.friction_heat, watch.worst);
    EXPECT_LT(watch.worst, 1e-13);
    EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-13);
  }
};

TEST(Gap, MakesNoDifferenceToASphereOnAPlate) {
  const SphereOnPlate touching(0.0), across(2e-3);
  EXPECT_NEAR(across.momentum, touching.momentum, 0.001 * touching.momentum);
  EXPECT_NEAR(across.internal, touching.internal, 0.005 * touching.internal);
  EXPECT_NEAR(across.largest, touching.largest, 0.02 * touching.largest);
  const SphereOnPlate one(2e-3, "[contact]\nmethod = \"none\"\n");
  EXPECT_GT(one.largest, 1.5 * across.largest);
}

// Exact: the flyer stops, the target has all its momentum, and there is no tension at any time.
TEST(Gap, BodiesPartWithoutTension) {
  for (const double gap : {0.0, 2.0}) {
    const PlanarGap set{.speed = 100.0, .gap = gap, .after = 1.6e-6};
    const Problem problem = set.problem();
    solver::Simulation simulation(problem.read(), parallel::world());
    double lowest = 0.0;
    const double scale = 2785.0 * 5328.0 * 0.5 * set.speed;
    run_to(simulation, problem.end, [&](const solver::Simulation& s) {
      for (const std::uint32_t body : {0U, 1U}) {
        double face = body == 0 ? -never : never, sum = 0.0, mass = 0.0;
        for_each_point(s, body, [&](const Vector3& x, double, double, double) {
          face = body == 0 ? std::max(face, x[0]) : std::min(face, x[0]);
        });
        for_each_point(s, body, [&](const Vector3& x, double p, double m, double) {
          if (std::abs(x[0] - face) > 0.8 * set.dx) return;
          sum += m * p;
          mass += m;
        });
        lowest = std::min(lowest, sum / mass / scale);
      }
    });
    const BodySums flyer = sums_of(simulation, 0), target = sums_of(simulation, 1);
    const double of_flyer = flyer.momentum[0] / flyer.mass / set.speed,
                 of_target = target.momentum[0] / target.mass / set.speed;
    std::printf(
        "rebound across %.1f cells: flyer %.4f, target %.4f of the speed, lowest mean pressure of a first "
        "cell %.3f\n",
        gap, of_flyer, of_target, lowest);
    EXPECT_NEAR(of_flyer, 0.0, 0.01);
    EXPECT_NEAR(of_target, 0.5, 0.005);
    EXPECT_GT(lowest, -0.15);
    EXPECT_GT(target.centre[0] - flyer.centre[0], 0.5 * (set.thickness + set.target));
  }
}

// Two blocks at rest, one warm, with separate fields: the heat that the cold one gains by conduction (J).
double heat_across(double gap, const char* contact) {
  constexpr double dx = 1e-3;
  Problem problem;
  problem.end = 4e-6;
  problem.domain = "[domain]\nlower = [-0.006, 0, 0]\nupper = " + vector3({8e-3, dx, dx}) +
                   "\ncell_size = 0.001\n" + column_sides;
  problem.contact = contact;
  problem.more = "[heat]\nconduction = true\n";
  const std::string material =
      aluminium("gap_conductor", "1e6 GPa", "[thermal]\nsource = \"test\"\nconductivity = \"240 W/(m K)\"\n");
  problem.bodies = {{"cold", material, box({-4e-3, 0, 0}, {0, dx, dx})},
                    {"warm", material, box({gap, 0, 0}, {gap + 4e-3, dx, dx}), Vector3::Zero(),
                     "[body.initial]\ntemperature = \"400 K\"\npressure = \"0 Pa\"\n"}};
  solver::Simulation simulation(problem.read(), parallel::world());
  const auto energy = [&] {
    double sum = 0.0;
    const Particles& q = simulation.particles();
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (q.body[p] == 0) sum += q.mass[p] * q.specific_internal_energy[p];
    }
    return sum;
  };
  const double before = energy();
  for (int step = 0; step < 5; ++step) simulation.advance(problem.end);
  const solver::Totals &now = simulation.totals(), &initial = simulation.state().ledger.initial;
  EXPECT_NEAR(now.energy(), initial.energy(), 1e-14 * initial.energy());
  return energy() - before;
}

TEST(Gap, HeatFlowsWhereBodiesTouch) {
  const char *own = "[contact]\nmethod = \"auto\"\n", *one = "[contact]\nmethod = \"none\"\n";
  const double touching = heat_across(0.0, own);
  EXPECT_GT(touching, 0.0);
  EXPECT_NEAR(touching, heat_across(0.0, one), 0.01 * touching);
  EXPECT_LT(std::abs(heat_across(0.7e-3, own)), 1e-9 * touching);
  EXPECT_GT(heat_across(0.7e-3, one), 0.1 * touching);
}

}  // namespace
}  // namespace whipple::verification
