// SPDX-License-Identifier: BSD-3-Clause
// Load steps of rings (docs/theory/quasi_static.md, eq. 1): a cylinder in a rigid casing, full or with a free bore, pressed
// along its axis by a driven plate, against the closed forms of the linear law.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "tests/verification/load_step_problems.hpp"

namespace whipple::verification {
namespace load_step_rings_test {

/// Linear elastic material, K = 4/3 MPa and G = 500 kPa: Poisson's ratio 1/3, lambda = 1 MPa.
std::string soft_ring() {
  return write_material("quasi_static_ring", R"toml(
name = "ring"
source = "test"
[eos]
model = "mie_gruneisen"
source = "K = 4/3 MPa"
reference_density = "80 kg/m^3"
hugoniot_intercept = "129.09944487358058 m/s"
hugoniot_slope = 1.0
gruneisen = 1e-6
heat_capacity = "1000 J/(kg K)"
[strength]
model = "elastic"
source = "G of nu = 1/3"
shear_modulus = "500 kPa"
)toml");
}

constexpr double lambda = 1e6, shear = 0.5e6;  // Pa
constexpr double casing = 2.0;                 // radius of the rigid casing b, m
constexpr int steps = 8;

/// Largest errors of a pressed cylinder in its part far from the plate.
struct Errors {
  double axial = 0.0, radial = 0.0, hoop = 0.0;  ///< of the stresses, over the largest axial one
  double displacement = 0.0;                     ///< along the radius, over that of the bore
  double plate = 0.0,
         impulse = 0.0;  ///< floor against plate, and against the stress on the section, relative
};

/// Presses a cylinder of 4 m with the bore a by 1e-5 and returns the errors of its state. With the axial strain
/// -e, u = A (r - b^2/r), which vanishes at the casing r = b, and no stress at the bore:
///   A = lambda e / (2 lambda + 2 G (1 + b^2/a^2)),   sigma_r, sigma_h = lambda (2 A - e) + 2 G A (1 +- b^2/r^2);
/// A = 0 without a bore. e is taken from the axial displacements, as the plate holds nodes of the grid beyond its end.
Errors pressed(double bore, int cells) {
  const double h = 1.0 / cells, length = 4.0;
  solver::Simulation simulation(
      cases::read_case_text(
          "[domain]\ndimension = \"axisymmetric\"\nlower = [0, 0]\nupper = [6, " + number(casing) +
              "]\ncell_size = " + number(h) +
              "\nboundary = { x_lower = \"symmetry\", y_lower = \"symmetry\", y_upper = \"symmetry\" }\n"
              "[time]\nend = 1\nscheme = \"quasi_static\"\n[quasi_static]\nsteps = " +
              std::to_string(steps) +
              "\n[contact]\nmethod = \"none\"\n[[force_gauge]]\nname = \"plate\"\nbody = \"plate\"\n"
              "[[force_gauge]]\nname = \"floor\"\nface = \"x_lower\"\n" +
              BodyOptions{"cylinder", soft_ring(), box({0, bore, -1}, {length, casing, 1})}.toml() +
              BodyOptions{"plate",
                          soft_ring(),
                          box({length, bore, -1}, {length + 1, casing, 1}),
                          {-4e-5, 0, 0},
                          "driven = true\n"}
                  .toml(),
          "cylinder.toml"),
      parallel::world());
  const Particles& q = simulation.particles();
  std::vector<Vector3> began(q.size());
  for (std::size_t p = 0; p < q.size(); ++p) began.at(q.id[p]) = q.position[p];
  run_to(simulation, 1.0);
  EXPECT_EQ(simulation.state().step, steps);  // none was cut
  EXPECT_LT(std::abs(simulation.state().ledger.momentum_error(simulation.totals())), 1e-12);

  const auto far = [&](std::size_t p) { return began.at(q.id[p])[0] < 0.25 * length; };
  double moved = 0.0, place = 0.0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (!far(p)) continue;
    moved -= q.position[p][0] - began.at(q.id[p])[0];
    place += began.at(q.id[p])[0];
  }
  const double e = moved / place, b2 = casing * casing;
  const double a = bore > 0.0 ? lambda * e / (2.0 * lambda + 2.0 * shear * (1.0 + b2 / (bore * bore))) : 0.0;
  const double along = lambda * (2.0 * a - e) - 2.0 * shear * e;  // the same over the section
  Errors error;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double r = began.at(q.id[p])[1];
    if (!far(p) || r < bore + h) continue;  // functions of the cell at the bore reach beyond it
    const double mean = lambda * (2.0 * a - e);
    const SymmetricTensor& s = q.deviatoric_stress[p];
    const auto worse = [&](double& worst, double found, double exact) {
      worst = std::max(worst, std::abs(found - exact) / std::abs(along));
    };
    worse(error.axial, s.xx - q.pressure[p], along);
    worse(error.radial, s.yy - q.pressure[p], mean + 2.0 * shear * a * (1.0 + b2 / (r * r)));
    worse(error.hoop, s.zz - q.pressure[p], mean + 2.0 * shear * a * (1.0 - b2 / (r * r)));
    const double most = bore > 0.0 ? a * (b2 / bore - bore) : e * casing;
    error.displacement =
        std::max(error.displacement, std::abs(q.position[p][1] - r - a * (r - b2 / r)) / most);
  }
  const double on_plate = simulation.state().gauged[0].impulse[0],
               on_floor = simulation.state().gauged[1].impulse[0];
  error.plate = std::abs(on_plate + on_floor) / std::abs(on_floor);
  // Impulse of a force that grows by an eighth with every step, taken at the ends of the steps.
  const double section = std::numbers::pi * (b2 - bore * bore);
  error.impulse =
      std::abs(std::abs(on_floor) / (0.5 * (1.0 + 1.0 / steps) * std::abs(along) * section) - 1.0);
  std::printf(
      "bore %.0f m, %d cells: e %.4e, axial %.1e, radial %.1e, hoop %.1e, u %.1e, plate %.1e, impulse %.1e\n",
      bore, cells, e, error.axial, error.radial, error.hoop, error.displacement, error.plate, error.impulse);
  return error;
}

// No radial strain: the force is that of (lambda + 2 G) e, the lateral stress a half of it, round as along the radius.
TEST(LoadStepsOfRings, AConfinedCylinderIsPressedUniformly) {
  for (const int cells : {2, 4}) {
    const Errors error = pressed(0.0, cells);
    EXPECT_LT(error.plate, 1e-8);
    EXPECT_LT(std::max({error.axial, error.radial, error.hoop}), 3e-3);
    EXPECT_LT(error.displacement, 3e-3);
    EXPECT_LT(error.impulse, 1e-4);
  }
}

// The stresses of Lame: a tube in a rigid casing, with a free bore.
TEST(LoadStepsOfRings, ATubeIsThatOfLame) {
  const Errors coarse = pressed(1.0, 4), fine = pressed(1.0, 8);
  for (const Errors& error : {coarse, fine}) {
    EXPECT_LT(error.plate, 1e-8);
    EXPECT_LT(error.impulse, 2e-3);
  }
  EXPECT_LT(fine.radial, 0.7 * coarse.radial);
  EXPECT_LT(fine.hoop, 0.7 * coarse.hoop);
  EXPECT_LT(fine.displacement, 0.7 * coarse.displacement);
  EXPECT_LT(std::max({fine.axial, fine.radial, fine.hoop}), 3e-3);
}

}  // namespace load_step_rings_test
}  // namespace whipple::verification
