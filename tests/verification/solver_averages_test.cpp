// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose pressure and volume rate act as means over cells (docs/theory/mpm.md, 4.12 to 4.14): exact balances, and the
// membrane of Cook against finite elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/folders.hpp"
#include "tests/verification/averaged_collision.hpp"

namespace whipple::verification {
namespace {

TEST(Averages, KeepEnergyAndMomentumExactInEveryDimension) {
  for (const char* dimension : {"3d", "plane_strain", "axisymmetric"}) {
    for (const char* function : {"quadratic_bspline", "cubic_bspline"}) {
      Method method;
      method.shape_function = function;
      std::array<double, 2> pressure{};
      for (const bool averaged : {false, true}) {
        const cases::Case setup = averaged_collision(method, dimension, averaged ? "cell" : "point");
        solver::Simulation simulation(setup, parallel::world());
        double energy = 0.0, momentum = 0.0;
        run_to(simulation, setup.time.end, [&](const solver::Simulation& s) {
          energy = std::max(energy, std::abs(s.state().ledger.energy_error(s.totals())));
          momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
        });
        EXPECT_LT(energy, 1e-13) << dimension << " " << function;
        EXPECT_LT(momentum, 1e-13) << dimension << " " << function;
        for (const double p : simulation.particles().pressure) pressure[averaged ? 1 : 0] += std::abs(p);
      }
      EXPECT_NE(pressure[0], pressure[1]) << dimension << " " << function;
      EXPECT_NEAR(pressure[1] / pressure[0], 1.0, 0.1) << dimension << " " << function;
    }
  }
}

TEST(Averages, SchemesWithoutExactEnergyAreAveragedToo) {
  for (const char* scheme : {"musl", "usl", "usf"}) {
    Method method = Method::musl();
    method.scheme = scheme;
    std::array<double, 2> pressure{};
    for (const bool averaged : {false, true}) {
      const cases::Case setup = averaged_collision(method, "plane_strain", averaged ? "cell" : "point");
      solver::Simulation simulation(setup, parallel::world());
      run_to(simulation, setup.time.end);
      EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-12) << scheme;
      for (const double p : simulation.particles().pressure) pressure[averaged ? 1 : 0] += std::abs(p);
    }
    EXPECT_NE(pressure[0], pressure[1]) << scheme;
    EXPECT_NEAR(pressure[1] / pressure[0], 1.0, 0.2) << scheme;
  }
}

/// Returns the deflection (m) of the upper corner of the membrane of cases/cook_membrane at rest.
double deflection(const std::string& cell, const std::string& volumetric, bool linear = false) {
  const std::string file = whipple::tests::source_folder() + "/cases/cook_membrane/case.toml";
  std::vector<std::pair<std::string, std::string>> overrides = {{"domain.cell_size", cell},
                                                                {"time.end", "80 s"},
                                                                {"body.0.volumetric", volumetric},
                                                                {"body.1.volumetric", volumetric}};
  if (linear) {
    overrides.emplace_back("transfer.shape_function", "linear");
    overrides.emplace_back("transfer.particle_update", "flip");
  }
  const cases::Case setup = cases::read_case(file, overrides);
  solver::Simulation simulation(setup, parallel::world());
  const Vector3 corner(48, 60, simulation.particles().position[0][2]);
  std::size_t tip = 0;
  const auto distance = [&](std::size_t p) { return (simulation.particles().position[p] - corner).norm(); };
  for (std::size_t p = 0; p < simulation.particles().size(); ++p) {
    if (distance(p) < distance(tip)) tip = p;
  }
  const std::uint64_t id = simulation.particles().id[tip];
  const double start = simulation.particles().position[tip][1];
  run_to(simulation, setup.time.end);
  const Particles& q = simulation.particles();
  return q.position[static_cast<std::size_t>(std::ranges::find(q.id, id) - q.id.begin())][1] - start;
}

// 0.2764 +- 0.0003: own finite elements, quadratic with a projected pressure, 4 to 32 a side, extrapolated.
TEST(Averages, CooksMembraneLocksLess) {
  constexpr double exact = 0.2764;
  EXPECT_NEAR(deflection("4 m", "cell") / exact, 1.0, 0.015);
  EXPECT_LT(deflection("4 m", "point") / exact, 0.92);
  EXPECT_NEAR(deflection("4 m", "cell", true) / exact, 1.0, 0.07);
  EXPECT_LT(deflection("4 m", "point", true) / exact, 0.8);
}

}  // namespace
}  // namespace whipple::verification
