// SPDX-License-Identifier: BSD-3-Clause
// A disk of rubber that spins (docs/theory/material.md, section 12).
#include <gtest/gtest.h>

#include <string>

#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

/// Neo-Hookean rubber with a bulk modulus of 125 times that of shear.
std::string rubber() {
  return write_material("nearly_incompressible_rubber", R"toml(
name = "rubber"
source = "test"
[eos]
model = "mie_gruneisen"
source = "test"
reference_density = "1 g/cm^3"
hugoniot_intercept = "0.5 km/s"
hugoniot_slope = 1.5
gruneisen = 0.001
heat_capacity = "1500 J/(kg K)"
reference_temperature = "300 K"
[constitutive]
model = "neo_hookean"
source = "test"
shear_modulus = "2 MPa"
)toml");
}

/// Sums of a body in the plane.
struct Spin {
  double angular_momentum = 0.0, kinetic = 0.0, along_x = 0.0,
         along_y = 0.0;  // the last: second moments of mass
};
Spin spin_of(const Particles& q) {
  Spin spin;
  for (std::size_t p = 0; p < q.size(); ++p) {
    spin.angular_momentum += q.mass[p] * q.position[p].cross(q.velocity[p])[2];
    spin.kinetic += 0.5 * q.mass[p] * q.velocity[p].squaredNorm();
    spin.along_x += q.mass[p] * q.position[p][0] * q.position[p][0];
    spin.along_y += q.mass[p] * q.position[p][1] * q.position[p][1];
  }
  return spin;
}

// Ten turns of a disk of 20 cells across, rim speed 10 m/s: a fifth of the speed of shear waves.
TEST(Rubber, DiskThatSpinsTenTimesKeepsShapeAndSpin) {
  const cases::Case setup = cases::read_case_text(
      "[domain]\ndimension = \"plane_strain\"\nlower = [-0.015, -0.015]\nupper = [0.015, 0.015]\ncell_size = "
      "1e-3\n"
      "[time]\nend = 0.0628\n[artificial_viscosity]\nlinear = 0\nquadratic = 0\n"
      "[[body]]\nname = \"disk\"\nmaterial = \"" +
          rubber() +
          "\"\nangular_velocity = [0, 0, 1000]\nvolumetric = \"cell\"\n"
          "shape = { cylinder = { center = [0, 0, 0], axis = \"z\", radius = 0.01, height = 2 } }\n",
      "disk.toml");
  solver::Simulation simulation(setup, parallel::world());
  const Spin start = spin_of(simulation.particles());
  EnergyWatch energy;
  run_to(simulation, setup.time.end, [&](const solver::Simulation& s) { energy(s); });
  const Spin now = spin_of(simulation.particles());
  EXPECT_NEAR(now.angular_momentum / start.angular_momentum, 1.0, 5e-4);
  EXPECT_NEAR(now.kinetic / start.kinetic, 1.0, 2e-3);
  // It stays round, and as large as the centrifugal force makes it.
  EXPECT_NEAR(now.along_x / start.along_x, 1.0, 2e-3);
  EXPECT_NEAR(now.along_y / now.along_x, 1.0, 1e-4);
  EXPECT_LT(energy.worst, 1e-12);
}

}  // namespace
}  // namespace whipple::verification
