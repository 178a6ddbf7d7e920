// SPDX-License-Identifier: BSD-3-Clause
// Water at rest in a tank under gravity (docs/theory/soil.md, section 7): hydrostatic pressure, drift and spurious
// kinetic energy over ten periods of the column's compression (4 h/c), with the surface on a plane of nodes and
// between two of them; forces on floor and wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace tank_test {

constexpr double gravity = 9.81, width = 0.2, depth = 0.5, speed = 30.0,
                 density = 1000.0;  // m/s^2, m, m/s, kg/m^3

std::string still_water() {
  return write_material("still_water", R"toml(
name = "water, weakly compressible"
source = "test"
[eos]
model = "mie_gruneisen"
source = "linear: c0 = 30 m/s"
reference_density = "1000 kg/m^3"
hugoniot_intercept = "30 m/s"
hugoniot_slope = 0.001
gruneisen = 0.001
heat_capacity = "4157 J/(kg K)"
[strength]
model = "none"
[[failure]]
model = "tensile_pressure"
source = "water with a free surface carries no tension"
spall_strength = "1 Pa"
)toml");
}

/// @param cells  over the depth
/// @param above  of the surface over the plane of nodes at the depth, cells
/// @param more  further tables
cases::Case tank(int cells, double above, double end, bool in_equilibrium, const std::string& more) {
  const double size = depth / cells, surface = depth + above * size;
  return cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() + "[output]\nmaximum_energy_error = 10.0\n[domain]\n" +
          "dimension = \"plane_strain\"\nlower = [0, 0]\nupper = [0.2, 0.7]\ncell_size = " + number(size) +
          "\nboundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"symmetry\" }\n"
          "[gravity]\nacceleration = [0, -9.81, 0]\n" +
          more +
          "[[force_gauge]]\nname = \"floor\"\nface = \"y_lower\"\n[[force_gauge]]\nname = \"wall\"\nface = "
          "\"x_upper\"\n" +
          BodyOptions{"water", still_water(), box({0, 0, -1}, {width, surface, 1}), Vector3::Zero(),
                      in_equilibrium
                          ? "initial = { lithostatic = { surface = " + number(surface) + ", k0 = 1 } }\n"
                          : ""}
              .toml(),
      "tank.toml");
}

struct Still {
  double early = 0.0, late = 0.0;  ///< greatest kinetic energy of either half of the time over rho g h^2 W/2
  double moved = 0.0, lost = 0.0;  ///< greatest displacement over h; largest energy error over the same
  double pressure = 0.0;           ///< mean error at the end over rho g h
  double floor = 0.0, wall = 0.0;  ///< mean forces over those of the hydrostatic pressure, less 1
};

constexpr double stiffness = density * speed * speed;  // K = rho_0 c^2 of p = K (1 - rho_0/rho), Pa

/// Returns the hydrostatic pressure at a depth in water that its weight compresses: dp/dz = rho g.
double hydrostatic(double z) {
  return stiffness * (1.0 - std::sqrt(1.0 - 2.0 * density * gravity * z / stiffness));
}

Still stand(int cells, double above, double end, bool in_equilibrium = true, const std::string& more = {}) {
  solver::Simulation simulation(tank(cells, above, end, in_equilibrium, more), parallel::world());
  const double h = depth + above * depth / cells, scale = 0.5 * density * gravity * h * h * width;
  std::vector<Vector3> places(simulation.particle_count());
  for (std::size_t p = 0; p < places.size(); ++p)
    places.at(simulation.particles().id[p]) = simulation.particles().position[p];
  Still still;
  Vector3 floor = Vector3::Zero(), wall = Vector3::Zero();
  double since = 0.0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    const solver::Totals& totals = s.totals();
    const double moving = (totals.kinetic_energy + totals.affine_kinetic_energy) / scale;
    const double time = s.state().time;
    double& greatest = time < 0.5 * end ? still.early : still.late;
    greatest = std::max(greatest, moving);
    if (time < 0.5 * end) {  // so that the means are those of the second half
      floor = s.state().gauged[0].impulse;
      wall = s.state().gauged[1].impulse;
      since = time;
    }
    const solver::Ledger& ledger = s.state().ledger;
    still.lost = std::max(still.lost, std::abs(totals.energy() - ledger.initial.energy() -
                                               ledger.external_work - ledger.damping_work) /
                                          scale);
  });
  const Particles& q = simulation.particles();
  double mass = 0.0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    still.moved = std::max(still.moved, (q.position[p] - places.at(q.id[p])).norm() / h);
    // Where all began at the reference density the mass above a particle, and so its pressure, is known by its place.
    const double exact =
        in_equilibrium ? hydrostatic(h - q.position[p][1]) : density * gravity * (h - places.at(q.id[p])[1]);
    still.pressure += q.mass[p] * std::abs(q.pressure[p] - exact);
    mass += q.mass[p];
  }
  still.pressure /= mass * density * gravity * h;
  const double time = simulation.state().time - since;
  still.floor = -(simulation.state().gauged[0].impulse - floor)[1] / time / (mass * gravity) - 1.0;
  // Integral of the pressure over the wall, to the first order of rho g h/K.
  const double denser = density * gravity * h / stiffness;
  const double push = 0.5 * density * gravity * h * h * (1.0 + (in_equilibrium ? 1.0 : -2.0) / 3.0 * denser);
  still.wall = (simulation.state().gauged[1].impulse - wall)[0] / time / push - 1.0;
  std::printf(
      "tank, %d cells, surface %.1f: kinetic %.2e, then %.2e; moved %.2e, pressure %.2e, floor %+.2e, wall "
      "%+.2e, energy %.1e\n",
      cells, above, still.early, still.late, still.moved, still.pressure, still.floor, still.wall,
      still.lost);
  return still;
}

constexpr double ten_periods = 10 * 4 * depth / speed;  // s

TEST(Tank, WaterAtRestStaysSo) {
  for (const double above : {0.0, 0.3}) {
    Still last;
    for (const int cells : {10, 20, 40}) {
      if (cells == 40 && above > 0.0) continue;
      const Still still = stand(cells, above, ten_periods);
      EXPECT_LT(still.lost, 1e-12) << cells;
      EXPECT_LT(still.late, 0.5 * still.early) << cells << ": it does not begin to move";
      EXPECT_LT(still.early, 1e-8) << cells;
      EXPECT_LT(std::abs(still.floor), 1e-5) << cells;
      EXPECT_LT(std::abs(still.wall), 3e-5) << cells;
      if (cells > 10 && above == 0.0) {  // second order, the energy third
        EXPECT_LT(still.pressure, 0.3 * last.pressure) << cells;
        EXPECT_LT(still.moved, 0.3 * last.moved) << cells;
        EXPECT_LT(still.early, 0.15 * last.early) << cells;
      } else if (cells > 10) {  // the cell of the surface is cut
        EXPECT_LT(still.pressure, 0.65 * last.pressure) << cells;
        EXPECT_LT(still.moved, 0.65 * last.moved) << cells;
      }
      last = still;
    }
  }
}

TEST(Tank, WaterThatItsWeightStrikesComesToTheHydrostaticPressure) {
  double last = 0.0;
  for (const int cells : {10, 20}) {
    const Still still = stand(cells, 0.0, ten_periods, false, "[damping]\ncoefficient = 0.5\n");
    EXPECT_LT(still.lost, 1e-12) << cells;
    EXPECT_LT(still.late, 1e-3 * still.early) << cells;
    EXPECT_LT(std::abs(still.floor), 2e-4) << cells;
    EXPECT_LT(std::abs(still.wall), 2e-4) << cells;
    if (last > 0.0) {
      EXPECT_LT(still.pressure, 0.55 * last) << cells;
    }
    last = still.pressure;
  }
  EXPECT_LT(last, 0.005);
}

}  // namespace tank_test
}  // namespace whipple::verification
