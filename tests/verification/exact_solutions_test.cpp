// SPDX-License-Identifier: BSD-3-Clause
// The exact solutions of the suite themselves: published numbers and jump conditions.
#include <gtest/gtest.h>

#include <cmath>

#include "src/material/material_file.hpp"
#include "tests/folders.hpp"
#include "tests/verification/exact/gas_solutions.hpp"
#include "tests/verification/exact/piston.hpp"
#include "tests/verification/exact/planar_impact.hpp"
#include "tests/verification/exact/runs.hpp"

namespace whipple::verification::exact {
namespace {

// Toro, 3rd ed., table 4.2, tests 1 (Sod), 2 (two rarefactions) and 3 (strong shock).
TEST(ExactSolutions, RiemannProblemsHaveTorosStarStates) {
  struct Case {
    GasState left, right;
    double pressure, velocity;
  };
  for (const Case& c :
       {Case{{1, 0, 1}, {0.125, 0, 0.1}, 0.30313, 0.92745}, Case{{1, -2, 0.4}, {1, 2, 0.4}, 0.00189, 0.0},
        Case{{1, 0, 1000}, {1, 0, 0.01}, 460.894, 19.5975}}) {
    const RiemannProblem problem(c.left, c.right, 1.4);
    EXPECT_NEAR(problem.star_pressure(), c.pressure, 6e-6 * std::max(1.0, c.pressure * 20));
    EXPECT_NEAR(problem.star_velocity(), c.velocity, 6e-6 * std::max(1.0, c.velocity * 2));
  }
}

// Toro, table 4.3: densities on either side of the contact of test 1; and the fan joins its ends.
TEST(ExactSolutions, SodHasTorosDensitiesAndAContinuousFan) {
  const RiemannProblem problem({1, 0, 1}, {0.125, 0, 0.1}, 1.4);
  EXPECT_NEAR(problem.at(0.92).density, 0.42632, 5e-6);
  EXPECT_NEAR(problem.at(0.93).density, 0.26557, 5e-6);
  const double head = -std::sqrt(1.4);
  EXPECT_NEAR(problem.at(head + 1e-9).pressure, 1.0, 1e-8);
  const double tail = 0.927452 - std::sqrt(1.4 * problem.star_pressure() / problem.at(0.92).density);
  EXPECT_NEAR(problem.at(tail - 1e-6).pressure, problem.star_pressure(), 1e-5);
}

// Kamm & Timmes (2007), table of the standard uniform-density case: E = 0.851072 brings the shock to 1 m at 1
// s.
TEST(ExactSolutions, SedovHasThePublishedEnergyIntegral) {
  const Sedov sedov(0.851072, 1.0, 1.4);
  EXPECT_NEAR(sedov.alpha(), 0.851072, 2e-6);
  EXPECT_NEAR(sedov.shock_radius(1.0), 1.0, 1e-6);
  const GasState behind = sedov.at(0.999999, 1.0);
  EXPECT_NEAR(behind.density, 6.0, 1e-3);
  EXPECT_NEAR(behind.velocity, 0.4 / 1.2, 1e-4);
  EXPECT_NEAR(behind.pressure, 2 * 0.16 / 2.4, 1e-4);
  double mass = 0;  // inside the shock: that of the sphere
  for (int i = 0; i < 2000; ++i) {
    const double r = (i + 0.5) / 2000;
    mass += sedov.at(r, 1.0).density * r * r / 2000;
  }
  EXPECT_NEAR(mass, 1.0 / 3, 1e-3);
}

TEST(ExactSolutions, NohKeepsMassAndEnergy) {
  for (const int dimensions : {1, 2, 3}) {
    const Noh noh{dimensions, 5.0 / 3};
    const GasState behind = noh.at(0.1, 0.6), ahead = noh.at(0.200001, 0.6);
    const double shock = noh.shock_radius(1.0);
    EXPECT_NEAR(ahead.density * (shock + 1), behind.density * shock, 1e-3 * behind.density);
    EXPECT_NEAR(behind.energy(noh.gamma), 0.5, 1e-12);
    EXPECT_NEAR(behind.pressure, ahead.density * (shock + 1), 1e-3 * behind.pressure);
  }
}

// Jump conditions of the whole: wall force = momentum that the fronts stop; work of the moving material =
// energy.
TEST(ExactSolutions, TwoWavesObeyTheJumpConditions) {
  const Material material = read_material(aluminium("two_waves", "1 GPa"));
  const TwoWaves waves(material, 27.6e9, 1e9, 400);
  const PlateauState &rest = waves.ahead(), &elastic = waves.elastic(), &plastic = waves.plastic();
  EXPECT_NEAR(plastic.velocity, 0.0, 1e-9);
  EXPECT_GT(waves.elastic_speed(), 1.05 * waves.plastic_speed());
  // A weak elastic front runs with sqrt((K + 4/3 G)/rho); this one with half of s times the strain more.
  const double weak = std::sqrt(5328.0 * 5328.0 + 4 * 27.6e9 / (3 * 2785.0));
  EXPECT_GT(waves.elastic_speed(), weak);
  EXPECT_LT(waves.elastic_speed(), 1.03 * weak);
  const double change1 = elastic.velocity - rest.velocity, change2 = plastic.velocity - elastic.velocity;
  EXPECT_NEAR(elastic.stress, rest.density * waves.elastic_speed() * change1, 1e-6 * elastic.stress);
  EXPECT_NEAR(plastic.stress - elastic.stress, rest.density * waves.plastic_speed() * change2,
              1e-6 * plastic.stress);
  EXPECT_NEAR(elastic.energy - rest.energy, 0.5 * change1 * change1, 1e-6 * elastic.energy);
  EXPECT_NEAR(rest.density / elastic.density, 1 - change1 / waves.elastic_speed(), 1e-9);
  EXPECT_NEAR(material.eos->state(plastic.density, plastic.energy).pressure + 2e9 / 3, plastic.stress,
              1e-6 * plastic.stress);
}

// Energy, entropy and jump conditions of the released states of all impacts.
TEST(ExactSolutions, ReleaseKeepsTheEntropyOfTheShock) {
  for (const PlanarImpact& impact : planar_impacts()) {
    const Material flyer = read_material(impact.flyer, whipple::tests::source_folder());
    const eos::Hugoniot hugoniot(*flyer.eos);
    const ShockedAndReleased exact(flyer, hugoniot.at_particle_velocity(0.5 * impact.speed));
    const eos::State& shocked = exact.shocked().state;
    EXPECT_NEAR(exact.energy(shocked.density), shocked.specific_internal_energy - exact.initial_energy(),
                1e-6 * shocked.specific_internal_energy)
        << impact.name;
    EXPECT_NEAR(exact.entropy_share(shocked.density, shocked.specific_internal_energy), 1.0, 1e-9)
        << impact.name;
    const double density = 0.9 * shocked.density;
    EXPECT_NEAR(exact.entropy_share(density, exact.energy(density) + exact.initial_energy()), 1.0, 2e-3)
        << impact.name;
    std::printf("%s: half of the speed: %.1f GPa, e released %.1f kJ/kg, %.0f K\n", impact.name.c_str(),
                1e-9 * shocked.pressure, 1e-3 * exact.energy(0.0), exact.released().temperature);
  }
}

}  // namespace
}  // namespace whipple::verification::exact
