// SPDX-License-Identifier: BSD-3-Clause
// Viscous fluid: the decaying vortex of Taylor and Green, an exact solution of the Navier-Stokes equations
// between frictionless walls, v = U (sin kx cos ky, -cos kx sin ky) exp(-2 nu k^2 t), k = pi/L. Proves the
// viscosity, its heat, and the bound of the time step. Source: G. I. Taylor, A. E. Green, Proc. R. Soc. A 158
// (1937) 499, its plane form in G. K. Batchelor (1967). And the flow of Poiseuille as it begins between
// no-slip walls: proves the walls, and the order of convergence with them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/verification/solver_problems.hpp"

namespace whipple {
namespace {

constexpr double length = 0.01, speed = 2.0, viscosity_nu = 0.2 * speed * length;
constexpr double wave = std::numbers::pi / length, end = 1.0 / (4.0 * viscosity_nu * wave * wave);

std::string fluid() {
  return verification::write_material("viscous_fluid", R"toml(
name = "viscous fluid"
source = "constants of the verification problem: slow sound, Mach number 0.02"
[eos]
model = "mie_gruneisen"
source = "test"
reference_density = "1 g/cm^3"
hugoniot_intercept = "100 m/s"
hugoniot_slope = 1.0
gruneisen = 0.01
heat_capacity = "1000 J/(kg K)"
reference_temperature = "300 K"
[strength]
model = "viscous_fluid"
source = "test"
viscosity = "4 Pa s"
)toml");
}

struct Decay {
  double kinetic_energy;  // over that of the start
  double heat;            // over the loss of kinetic energy
  double energy_error;
  double largest_step;  // over dx^2/nu
  double unresolved;    // the fraction that became neither heat nor motion of the grid
};

cases::Case vortex(int cells) {
  const double dx = length / cells;
  const auto mm = [](double x) { return std::to_string(1e3 * x); };
  const std::string box = "lower = [0.0, 0.0, 0.0]\nupper = [\"" + mm(length) + " mm\", \"" + mm(length) +
                          " mm\", \"" + mm(dx) + " mm\"]\n";
  return cases::read_case_text(
      "[domain]\n" + box + "cell_size = \"" + mm(dx) +
          " mm\"\nboundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"symmetry\", "
          "y_upper = "
          "\"symmetry\", z_lower = \"symmetry\", z_upper = \"symmetry\" }\n[time]\nend = "
          "1\n[transfer]\nkappa = "
          "0\n[artificial_viscosity]\nlinear = 0\nquadratic = 0\n[[body]]\nname = \"fluid\"\nmaterial = \"" +
          fluid() + "\"\nshape = { box = { " + "lower = [0.0, 0.0, 0.0], upper = [\"" + mm(length) +
          " mm\", \"" + mm(length) + " mm\", \"" + mm(dx) + " mm\"] } }\n",
      "vortex.toml");
}

Decay decay(int cells) {
  const double dx = length / cells;
  const cases::Case setup = vortex(cells);
  Particles particles = cases::seed(setup).particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double x = wave * particles.position[p][0], y = wave * particles.position[p][1];
    particles.velocity[p] = speed * Vector3(std::sin(x) * std::cos(y), -std::cos(x) * std::sin(y), 0.0);
    Matrix3& c = particles.affine_velocity[p];
    c.setZero();
    c(0, 0) = speed * wave * std::cos(x) * std::cos(y);
    c(0, 1) = -speed * wave * std::sin(x) * std::sin(y);
    c(1, 0) = -c(0, 1);
    c(1, 1) = -c(0, 0);
  }
  solver::RunState state;
  state.ledger.initial = solver::totals_of(particles, 0.25 * dx * dx);
  solver::Simulation simulation(setup, particles, state, parallel::world());
  const solver::Totals before = simulation.totals();
  Decay result{};
  verification::run_to(simulation, end, [&](const solver::Simulation& s) {
    result.energy_error = std::max(result.energy_error, std::abs(s.state().ledger.energy_error(s.totals())));
    result.largest_step = std::max(result.largest_step, s.state().time_step * viscosity_nu / (dx * dx));
  });
  const solver::Totals& now = simulation.totals();
  const auto kinetic = [](const solver::Totals& t) { return t.kinetic_energy + t.affine_kinetic_energy; };
  result.kinetic_energy = kinetic(now) / kinetic(before);
  const double lost = kinetic(before) - kinetic(now);
  result.heat = (now.internal_energy - before.internal_energy) / lost;
  result.unresolved = now.unresolved_energy / lost;
  return result;
}

TEST(ViscousFluid, TaylorGreenVortexDecaysAtTheExactRateAndItsEnergyIsHeat) {
  const Decay coarse = decay(8), fine = decay(16);
  const double exact = std::exp(-1.0);
  RecordProperty("coarse", std::to_string(coarse.kinetic_energy / exact - 1.0));
  RecordProperty("fine", std::to_string(fine.kinetic_energy / exact - 1.0));
  EXPECT_NEAR(fine.kinetic_energy, exact, 0.02 * exact);
  EXPECT_LT(std::abs(fine.kinetic_energy - exact), 0.4 * std::abs(coarse.kinetic_energy - exact));
  for (const Decay& d : {coarse, fine}) {
    EXPECT_NEAR(d.heat + d.unresolved, 1.0, 1e-9);  // losses of the transfers are not work of the viscosity
    EXPECT_GT(d.heat, 0.999);
    EXPECT_LT(d.energy_error, 1e-11);
    EXPECT_LT(d.largest_step, 1.0 / 18.0 + 1e-12);
  }
}

// Sound limits the step of the coarse grids above; on fine grids diffusion does.
TEST(ViscousFluid, DiffusionBoundsTheStepOfFineGrids) {
  constexpr int cells = 64;
  solver::Simulation simulation(vortex(cells), parallel::world());
  const double dx = length / cells, bound = dx * dx / (18.0 * viscosity_nu);
  EXPECT_NEAR(simulation.accurate_time_step(), bound, 1e-6 * bound);
}

/// A body force drives fluid at rest between no-slip walls at y = 0 and y = H; parallel to them the fluid is five times
/// as long as the channel is wide, with free ends, and only its middle is evaluated.
struct Channel {
  static constexpr double width = 0.01, nu = 0.004, largest = 0.5, time = 0.1 * width * width / nu;
  static constexpr double force = 8.0 * nu * largest / (width * width);  // per mass

  /// Returns the start-up of the plane flow (Batchelor, An Introduction to Fluid Dynamics (1967), section 4.3).
  static double exact(double y) {
    double u = 0.5 * force / nu * y * (width - y);
    for (int n = 1; n < 40; n += 2) {
      const double k = n * std::numbers::pi / width;
      u -= 4.0 * force * width * width / (nu * std::pow(n * std::numbers::pi, 3)) *
           std::exp(-nu * k * k * time) * std::sin(k * y);
    }
    return u;
  }

  /// Returns the root-mean-square error of the velocity over its largest value.
  static double error(int cells) {
    const double dx = width / cells;
    const std::string thickness = std::to_string(1e3 * dx) + " mm";
    const cases::Case setup = cases::read_case_text(
        "[domain]\nlower = [0, 0, 0]\nupper = [\"70 mm\", \"10 mm\", \"" + thickness + "\"]\ncell_size = \"" +
            thickness +
            "\"\nboundary = { y_lower = \"no_slip\", y_upper = \"no_slip\", z_lower = \"symmetry\", z_upper "
            "= "
            "\"symmetry\" }\n[time]\nend = 1\n[transfer]\nkappa = 0\n[artificial_viscosity]\nlinear = "
            "0\nquadratic "
            "= 0\n[gravity]\nacceleration = [" +
            std::to_string(force) + ", 0, 0]\n[[body]]\nname = \"fluid\"\nmaterial = \"" + fluid() +
            "\"\nshape = { box = { lower = [\"10 mm\", 0, 0], upper = [\"60 mm\", \"10 mm\", \"" + thickness +
            "\"] } }\n",
        "channel.toml");
    solver::Simulation simulation(setup, parallel::world());
    double energy_error = 0;
    verification::run_to(simulation, time, [&](const solver::Simulation& s) {
      energy_error = std::max(energy_error, std::abs(s.state().ledger.energy_error(s.totals())));
    });
    EXPECT_LT(energy_error, 1e-11);
    const Particles& q = simulation.particles();
    double squares = 0, count = 0;
    for (std::size_t p = 0; p < q.size(); ++p) {
      if (std::abs(q.position[p][0] - 0.035) > 0.005) continue;
      squares += std::pow(q.velocity[p][0] - exact(q.position[p][1]), 2);
      ++count;
    }
    const double result = std::sqrt(squares / count) / exact(0.5 * width);
    std::printf("channel of %d cells: error %.3e, energy error %.1e\n", cells, result, energy_error);
    return result;
  }
};

TEST(ViscousFluid, PoiseuilleFlowBeginsBetweenNoSlipWallsAsTheExactSolution) {
  const double coarse = Channel::error(8), fine = Channel::error(16);
  EXPECT_LT(fine, 0.01);
  EXPECT_GT(std::log2(coarse / fine), 1.7);  // order
}

}  // namespace
}  // namespace whipple
