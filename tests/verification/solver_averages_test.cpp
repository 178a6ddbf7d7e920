// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose pressure and volume rate act as means over cells (docs/theory/mpm.md, 4.12 to 4.14): exact balances, and the
// membrane of Cook against finite elements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
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

/// What alternates from cell to cell of the pressure of a body, over its root mean square: the means over cells times
/// (4, -2 of the four neighbours, 1 of those at the corners)/16, which no quadratic field has (studies/rubber).
double alternating(const solver::Simulation& simulation, std::uint32_t body) {
  const grid::Geometry& geometry = simulation.setup().geometry;
  const double area = geometry.cell_size * geometry.cell_size;
  struct Mean {
    double volume = 0.0, sum = 0.0;
  };
  std::map<std::pair<int, int>, Mean> cells;
  const Particles& q = simulation.particles();
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (q.body[p] != body) continue;
    const Lanes at = geometry.in_cells(q.position[p]);
    Mean& cell = cells[{static_cast<int>(std::floor(at[0])), static_cast<int>(std::floor(at[1]))}];
    cell.volume += q.volume[p];
    cell.sum += q.volume[p] * q.pressure[p];
  }
  std::erase_if(cells, [&](const auto& cell) { return cell.second.volume < 0.75 * area; });
  double mode = 0.0, whole = 0.0;
  for (const auto& [at, cell] : cells) {
    double sum = 0.0;
    bool is_inside = true;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const auto near = cells.find({at.first + i, at.second + j});
        is_inside = is_inside && near != cells.end();
        if (!is_inside) continue;
        const double weight = i == 0 && j == 0 ? 4.0 : i == 0 || j == 0 ? -2.0 : 1.0;
        sum += weight / 16.0 * near->second.sum / near->second.volume;
      }
    }
    if (!is_inside) continue;
    mode += sum * sum;
    whole += std::pow(cell.sum / cell.volume, 2);
  }
  return std::sqrt(mode / whole);
}

// Two disks of rubber, bulk over shear modulus 500, 24 cells across, while they touch.
TEST(Averages, TakeTheCheckerboardOutOfThePressure) {
  const std::string rubber = write_material("rubber_that_keeps_its_volume", R"toml(
name = "rubber"
source = "studies/rubber"
[eos]
model = "mie_gruneisen"
source = "K = rho c0^2 = 500 G"
reference_density = "1000 kg/m^3"
hugoniot_intercept = "707.107 m/s"
hugoniot_slope = 0.001
gruneisen = 0.001
heat_capacity = "1500 J/(kg K)"
[constitutive]
model = "neo_hookean"
source = "as above"
shear_modulus = "1 MPa"
)toml");
  const auto found = [&](const std::string& volumetric) {
    std::string text =
        "[domain]\ndimension = \"plane_strain\"\nlower = [-0.08, 0]\nupper = [0.08, 0.04]\ncell_size = "
        "0.0025\n"
        "boundary = { y_lower = \"symmetry\" }\n[time]\nend = 0.003\n[contact]\nfriction = 0\n";
    for (const double side : {-1.0, 1.0}) {
      text += fmt::format(
          "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nvolumetric = \"{}\"\nvelocity = [{}, 0]\nshape = {{ "
          "cylinder = "
          "{{ center = [{}, 0, 0], axis = \"z\", radius = 0.03, height = 2 }} }}\n",
          side < 0.0 ? "left" : "right", rubber, volumetric, -4.0 * side, 0.031 * side);
    }
    solver::Simulation simulation(cases::read_case_text(text, "disks.toml"), parallel::world());
    double sum = 0.0;
    for (const double time : {1e-3, 1.5e-3, 2e-3, 2.5e-3, 3e-3}) {
      run_to(simulation, time);
      sum += std::pow(alternating(simulation, 0), 2) / 5.0;
    }
    return std::sqrt(sum);
  };
  const double of_particles = found("point"), of_means = found("cell");
  std::printf("alternating from cell to cell: %.1f %%, by means over cells %.1f %%\n", 100 * of_particles,
              100 * of_means);
  EXPECT_GT(of_particles, 0.1);
  EXPECT_LT(of_means, 0.4 * of_particles);
  EXPECT_LT(of_means, 0.1);
}

}  // namespace
}  // namespace whipple::verification
