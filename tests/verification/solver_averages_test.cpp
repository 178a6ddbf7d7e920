// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose pressure and volume rate act as means over cells (docs/theory/mpm.md, 4.1): exact balances, and the
// membrane of Cook against finite elements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

cases::Case read(const std::string& text) { return cases::read_case_text(text, "averages.toml"); }

/// Two blocks of aluminium that collide obliquely, in a section or in space.
std::string collision(const Method& method, const std::string& dimension, const std::string& volumetric) {
  const bool space = dimension == "3d";
  const auto corner = [&](double x, double y) {
    return space ? fmt::format("[{}, {}, {}]", x, y, y) : fmt::format("[{}, {}]", x, y);
  };
  // The transverse velocity would leave the axis of a section with an axis.
  const double transverse = dimension == "axisymmetric" ? 0.0 : 50.0;
  const auto body = [&](const char* name, double velocity, double lower, double upper) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nvelocity = {}\nvolumetric = \"{}\"\n"
        "shape = {{ box = {{ lower = {}, upper = {} }} }}\n",
        name, aluminium("averaged_aluminium", "290 MPa"), corner(velocity, velocity > 0 ? transverse : 0.0),
        volumetric, corner(lower, 0.0), corner(upper, 4.3e-4));
  };
  return method.time_toml(0.08e-6) + method.toml() +
         "[output]\nmaximum_energy_error = 10.0\n[domain]\nlower = " +
         (space ? corner(-2e-3, -1e-3) : "[-2e-3, 0]") + "\nupper = " + corner(2e-3, 1.5e-3) +
         "\ncell_size = 1e-4\n" + (space ? "" : "dimension = \"" + dimension + "\"\n") +
         body("left", 400.0, -6e-4, 0.0) + body("right", -400.0, 0.0, 6e-4);
}

TEST(Averages, KeepEnergyAndMomentumExactInEveryDimension) {
  for (const char* dimension : {"3d", "plane_strain", "axisymmetric"}) {
    for (const char* function : {"quadratic_bspline", "cubic_bspline"}) {
      Method method;
      method.shape_function = function;
      std::array<double, 2> pressure{};
      for (const bool averaged : {false, true}) {
        const cases::Case setup = read(collision(method, dimension, averaged ? "cell" : "point"));
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
      const cases::Case setup = read(collision(method, "plane_strain", averaged ? "cell" : "point"));
      solver::Simulation simulation(setup, parallel::world());
      run_to(simulation, setup.time.end);
      EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-12) << scheme;
      for (const double p : simulation.particles().pressure) pressure[averaged ? 1 : 0] += std::abs(p);
    }
    EXPECT_NE(pressure[0], pressure[1]) << scheme;
    EXPECT_NEAR(pressure[1] / pressure[0], 1.0, 0.2) << scheme;
  }
}

/// Nearly incompressible neo-Hookean membrane of Cook: nu = 0.499, E = 70 Pa.
std::string rubber_of_cook() {
  return write_material("rubber_of_cook", R"toml(
name = "rubber of Cook's membrane"
source = "E 70 Pa, Poisson's ratio 0.499"
[eos]
model = "mie_gruneisen"
source = "bulk modulus 11666.7 Pa"
reference_density = "1 kg/m^3"
hugoniot_intercept = "108.0123 m/s"
hugoniot_slope = 0.5
gruneisen = 1e-6
heat_capacity = "1 J/(kg K)"
reference_temperature = "300 K"
[constitutive]
model = "neo_hookean"
source = "shear modulus of E and nu"
shear_modulus = "23.3489 Pa"
)toml");
}

/// Returns the deflection (m) of the upper corner of the membrane under a shear force of 1 N, at rest.
double deflection(double cell, const std::string& transfer, const std::string& volumetric) {
  const cases::Case setup = read(fmt::format(
      "[domain]\ndimension = \"plane_strain\"\nlower = [0, -4]\nupper = [56, 68]\ncell_size = {0}\n"
      "boundary = {{ x_lower = \"no_slip\" }}\n[time]\nend = 70\n[transfer]\n{1}"
      "[artificial_viscosity]\nlinear = 0\nquadratic = 0\n[[body]]\nname = \"membrane\"\nmaterial = \"{2}\"\n"
      "volumetric = \"{3}\"\nshape = {{ extrude = {{ axis = \"z\", base = [\"0 m\", \"0 m\"], height = \"1 m\", "
      "first = [\"0 m\", \"48 m\", \"48 m\", \"0 m\"], second = [\"0 m\", \"44 m\", \"60 m\", \"44 m\"] }} }}\n"
      "[[load]]\nforce = [\"0 N\", \"1 N\"]\nbox = {{ lower = [{4}, 0], upper = [49, 100] }}\n"
      "times = [\"0 s\", \"20 s\"]\nfactors = [0, 1]\n[[load]]\ndamping = \"0.2 1/s\"\n",
      cell, transfer, rubber_of_cook(), volumetric, 48 - 0.5 * cell));
  solver::Simulation simulation(setup, parallel::world());
  const Vector3 corner(48, 60, simulation.particles().position[0][2]);
  std::size_t tip = 0;
  for (std::size_t p = 0; p < simulation.particles().size(); ++p) {
    const auto distance = [&](std::size_t of) { return (simulation.particles().position[of] - corner).norm(); };
    if (distance(p) < distance(tip)) tip = p;
  }
  const std::uint64_t id = simulation.particles().id[tip];
  const double start = simulation.particles().position[tip][1];
  run_to(simulation, setup.time.end);
  const Particles& q = simulation.particles();
  const auto now = static_cast<std::size_t>(std::ranges::find(q.id, id) - q.id.begin());
  return q.position[now][1] - start;
}

// 0.2764 +- 0.0003: own finite elements, quadratic with a projected pressure, 4 to 32 a side, extrapolated. What
// particles lack, of either kind, is of first order: the load acts within half a cell of the edge, and particles at the
// oblique edges have partial volumes.
TEST(Averages, CooksMembraneLocksLess) {
  constexpr double exact = 0.2764;
  const std::string quadratic, linear = "shape_function = \"linear\"\nparticle_update = \"flip\"\n";
  const double coarse = exact - deflection(4, quadratic, "cell"), fine = exact - deflection(2, quadratic, "cell"),
               of_points = exact - deflection(4, quadratic, "point"),
               with_linear = exact - deflection(4, linear, "cell"),
               of_linear_points = exact - deflection(4, linear, "point");
  EXPECT_GT(fine, 0.0);
  EXPECT_LT(fine, 0.055 * exact);
  EXPECT_NEAR(coarse / fine, 2.0, 0.4);
  EXPECT_LT(coarse, 0.6 * of_points);
  EXPECT_LT(with_linear, 0.4 * of_linear_points);
}

}  // namespace
}  // namespace whipple::verification
