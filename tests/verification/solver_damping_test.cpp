// SPDX-License-Identifier: BSD-3-Clause
// Local damping (docs/theory/mpm.md, equation 3.5e): a column comes to rest at the stress of its weight; exact balances;
// nothing is damped on which no force acts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "src/core/base/error.hpp"
#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double height = 1.0, bulk = 5e6, shear = 3e6, gravity = 9.81, density = 2000.0;

std::string soft() {
  return write_material("soft", R"toml(
name = "soft"
source = "test"
[eos]
model = "polynomial"
source = "test"
reference_density = "2000 kg/m^3"
C1 = "5 MPa"
C4 = 0
C5 = 0
C6 = 0
heat_capacity = "1000 J/(kg K)"
[strength]
source = "test"
model = "elastic"
shear_modulus = "3 MPa"
)toml");
}

/// A column between sliding sides, on a sliding base, that its weight strikes at once.
struct Column {
  std::string damping = {};  // table
  bool elements = false;

  [[nodiscard]] cases::Case read(double end) const {
    constexpr double cell = height / 16;
    const std::string lines =
        "lower = [0, 0, 0]\nupper = " + vector3({2 * cell, 2 * cell, 1.5}) + "\ncell_size = " + number(cell);
    return cases::read_case_text(
        Method{}.time_toml(end) + Method{.linear_viscosity = 0.0, .quadratic_viscosity = 0.0}.toml() +
            "[output]\nmaximum_energy_error = 10.0\n[domain]\n" + lines +
            "\nboundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"symmetry\", y_upper "
            "= "
            "\"symmetry\", z_lower = \"symmetry\" }\n[gravity]\nacceleration = [0, 0, -9.81]\n" +
            damping +
            BodyOptions{"soil", soft(), box({0, 0, 0}, {2 * cell, 2 * cell, height}), Vector3::Zero(),
                        elements ? "discretization = { method = \"finite_elements\", element_size = " +
                                       number(cell) + " }\n"
                                 : ""}
                .toml() +
            "[[force_gauge]]\nname = \"base\"\nface = \"z_lower\"\n",
        "column.toml");
  }
};

struct Rest {
  int steps = 0;  // until the kinetic energy has fallen below a millionth of the work of the weight
  double energy = 0.0, momentum = 0.0, stress_error = 0.0, ratio_error = 0.0, damped = 0.0;
};

constexpr double modulus = bulk + 4.0 / 3.0 * shear;
const double wave_time = height / std::sqrt(modulus / density);  // s

Rest settle(const Column& column, double end) {
  solver::Simulation simulation(column.read(end), parallel::world());
  Rest rest;
  double before = 0.0, work = 0.0;
  int steps = 0, quiet = -1;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    const solver::Ledger& ledger = s.state().ledger;
    rest.energy = std::max(rest.energy, std::abs(ledger.energy_error(s.totals())));
    rest.momentum = std::max(rest.momentum, ledger.momentum_error(s.totals()));
    EXPECT_LE(ledger.damping_work, before) << "never driven";
    before = ledger.damping_work;
    work = std::max(work, ledger.external_work);
    ++steps;
    const double moving = s.totals().kinetic_energy + s.totals().affine_kinetic_energy;
    if (moving > 1e-6 * work) quiet = -1;
    if (moving <= 1e-6 * work && quiet < 0) quiet = steps;
  });
  rest.steps = quiet < 0 ? steps + 1 : quiet;
  rest.damped = -before / work;
  const double weight = sums_of(simulation, 0).mass * gravity;
  const Particles& q = simulation.particles();
  double largest = 0.0, mass = 0.0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double vertical = q.deviatoric_stress[p].zz - q.pressure[p],
                 side = q.deviatoric_stress[p].xx - q.pressure[p];
    const double exact = -density * gravity * (height - q.position[p][2]);
    rest.stress_error += q.mass[p] * std::abs(vertical - exact) / (density * gravity * height);
    mass += q.mass[p];
    if (q.position[p][2] < 0.5 * height)  // K0 of an elastic column
      largest = std::max(largest, std::abs(side / vertical - (bulk - 2.0 / 3.0 * shear) / modulus));
  }
  if (mass > 0.0) rest.stress_error /= mass;
  rest.ratio_error = largest;
  std::printf(
      "%s%s: at rest after %d of %d steps, damped %.4f of the work, stress %.1e, K0 %.1e, weight %.6f, "
      "energy "
      "%.1e, momentum %.1e\n",
      column.damping.empty() ? "undamped" : "damped", column.elements ? ", elements" : "", rest.steps, steps,
      rest.damped, rest.stress_error, rest.ratio_error, weight, rest.energy, rest.momentum);
  return rest;
}

TEST(LocalDamping, AColumnComesToRestAtTheStressOfItsWeight) {
  const double end = 40 * wave_time;
  const Rest free = settle({}, end);
  const Rest damped = settle({.damping = "[damping]\ncoefficient = 0.7\n"}, end);
  EXPECT_LT(damped.energy, 1e-12);
  EXPECT_LT(damped.momentum, 1e-12);
  EXPECT_LT(2 * damped.steps, free.steps) << "sooner than without";
  EXPECT_GT(damped.damped, 0.1);
  EXPECT_EQ(free.damped, 0.0);
  EXPECT_LT(damped.stress_error, 0.01);
  EXPECT_LT(damped.ratio_error, 0.01);
}

TEST(LocalDamping, ElementsComeToRestAsWell) {
  const double end = 30 * wave_time;
  const Rest free = settle({.elements = true}, end);
  const Rest damped = settle({.damping = "[damping]\ncoefficient = 0.7\n", .elements = true}, end);
  EXPECT_LT(damped.energy, 1e-12);
  EXPECT_LT(damped.momentum, 1e-12);
  EXPECT_LT(2 * damped.steps, free.steps);
  EXPECT_GT(damped.damped, 0.1);
}

/// The base carries the weight of a column at rest, though all its nodes were damped on the way.
TEST(LocalDamping, TheForceOnTheBaseIsThatOfTheBase) {
  const double end = 30 * wave_time;
  solver::Simulation simulation(Column{"[damping]\ncoefficient = 0.7\n"}.read(end), parallel::world());
  const double weight = sums_of(simulation, 0).mass * gravity;
  double last = 0.0, force = 0.0, time = 0.0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    force = (s.state().gauged[0].impulse[2] - last) / (s.state().time - time);
    last = s.state().gauged[0].impulse[2];
    time = s.state().time;
  });
  EXPECT_NEAR(force, -weight, 1e-3 * weight);
  // The balance of the column: what it has gained less its weight and the damping is the impulse of the base.
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_NEAR(last, -ledger.wall_impulse[2], 1e-12 * weight * end);
}

/// What flies freely is not damped; a table ends the damping.
TEST(LocalDamping, ActsOnlyWhereForcesDo) {
  constexpr double end = 5e-6;
  solver::Simulation simulation(
      cases::read_case_text(Method{}.time_toml(end) + Method{}.toml() +
                                "[domain]\nlower = [0, 0, 0]\nupper = [0.02, 0.01, 0.01]\ncell_size = "
                                "0.001\n[damping]\ncoefficient = 0.8\n" +
                                BodyOptions{"block",
                                            elastic_aluminium(),
                                            box({0.004, 0.003, 0.003}, {0.008, 0.007, 0.007}),
                                            {100, 0, 0}}
                                    .toml(),
                            "flight.toml"),
      parallel::world());
  const Vector3 start = sums_of(simulation, 0).momentum;
  run_to(simulation, end);
  EXPECT_LT((sums_of(simulation, 0).momentum - start).norm(), 1e-9 * start.norm());

  const double time = 4 * wave_time;
  const std::string until = number(0.5 * time) + ", " + number(0.51 * time);
  solver::Simulation column(
      Column{"[damping]\ncoefficient = 0.7\ntimes = [" + until + "]\nfactors = [1, 0]\n"}.read(time),
      parallel::world());
  run_to(column, 0.52 * time);
  const double damped = column.state().ledger.damping_work;
  EXPECT_LT(damped, 0.0);
  run_to(column, time);
  EXPECT_EQ(column.state().ledger.damping_work, damped);
}

TEST(LocalDamping, RefusesCoefficientsThatWouldDriveOrHold) {
  const auto message = [](const std::string& damping) -> std::string {
    try {
      static_cast<void>(Column{"[damping]\n" + damping}.read(1.0));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  for (const char* wrong : {"coefficient = 1.0\n", "coefficient = -0.1\n", "coefficient = 1.5\n"}) {
    EXPECT_NE(message(wrong).find("'coefficient'"), std::string::npos) << wrong << message(wrong);
  }
  EXPECT_NE(message("coefficient = 0.7\ntimes = [0, 1]\nfactors = [1, 1.5]\n")
                .find("expected 0 or more, and less than 1"),
            std::string::npos);
  EXPECT_NE(message("coefficient = 0.7\ntimes = [0, 1]\nfactors = [1, -0.1]\n").find("expected 0 or more"),
            std::string::npos);
  EXPECT_NE(message("times = [0, 1]\nfactors = [1, 0]\n").find("missing or zero"), std::string::npos);
  EXPECT_EQ(message("coefficient = 0.7\n"), "");
}

}  // namespace
}  // namespace whipple::verification
