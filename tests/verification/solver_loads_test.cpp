// SPDX-License-Identifier: BSD-3-Clause
// Loads of a case (docs/theory/mpm.md, equations 3.5b to 3.5d) and the initial stress under the own weight: exact
// impulse and work, rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/verification/contact_problems.hpp"

namespace whipple::verification {
namespace {

constexpr double cell = 1e-3;

/// Returns the case of a cube of 4 cells, far from all faces, and a second one beside it.
cases::Case cubes(const std::string& loads, double end, const std::string& of_cube = {}) {
  const std::string sides = "[domain]\nlower = [0, 0, 0]\nupper = [0.02, 0.01, 0.01]\ncell_size = 0.001\n";
  return cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() + "[output]\nmaximum_energy_error = 10.0\n" + sides + loads +
          BodyOptions{"cube",
                      elastic_aluminium(),
                      box({3 * cell, 3 * cell, 3 * cell}, {7 * cell, 7 * cell, 7 * cell}),
                      {3, 1, 0},
                      of_cube}
              .toml() +
          BodyOptions{"other",
                      elastic_aluminium(),
                      box({12 * cell, 3 * cell, 3 * cell}, {16 * cell, 7 * cell, 7 * cell}),
                      {0, 2, 0}}
              .toml(),
      "cubes.toml");
}

struct Balance {
  double energy = 0.0, momentum = 0.0;
  void operator()(const solver::Simulation& s) {
    energy = std::max(energy, std::abs(s.state().ledger.energy_error(s.totals())));
    momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
  }
  void expect_exact() const {
    EXPECT_LT(energy, 1e-13);
    EXPECT_LT(momentum, 1e-13);
  }
};

TEST(AppliedLoad, AForceByATableGivesExactlyItsImpulseToItsBody) {
  constexpr double end = 5e-6;
  const cases::Case setup = cubes(
      "[[load]]\nbody = \"cube\"\nforce = [\"40 N\", \"0 N\", \"-10 N\"]\n"
      "times = [\"0.3 us\", \"1.1 us\", \"2.9 us\", \"3.3 us\"]\nfactors = [0, 2, 1, -1]\n",
      end);
  solver::Simulation simulation(setup, parallel::world());
  const BodySums start = sums_of(simulation.particles(), 0, 0.0);
  const Vector3 other = sums_of(simulation.particles(), 1, 0.0).momentum;
  Balance balance;
  run_to(simulation, end, [&](const solver::Simulation& s) { balance(s); });
  balance.expect_exact();
  // Trapezoids: 0.8 x 1 + 1.8 x 1.5 + 0.4 x 0, then -1 until the end
  const double seconds = (0.8 + 2.7 + 0.0 - 1.7) * 1e-6;
  const Vector3 gained = sums_of(simulation.particles(), 0, 0.0).momentum - start.momentum;
  const Vector3 exact = seconds * Vector3(40, 0, -10);
  EXPECT_LT((gained - exact).norm(), 1e-12 * start.momentum.norm());
  EXPECT_LT((simulation.state().ledger.external_impulse - exact).norm(), 1e-12 * start.momentum.norm());
  EXPECT_LT((sums_of(simulation.particles(), 1, 0.0).momentum - other).norm(), 1e-12 * other.norm());
  // The work of the force on the motion of the whole body is the change of its kinetic energy.
  const double mass = start.mass;
  const double work = 0.5 / mass * ((start.momentum + exact).squaredNorm() - start.momentum.squaredNorm());
  EXPECT_NEAR(simulation.state().ledger.external_work, work, 1e-3 * std::abs(work));
}

TEST(AppliedLoad, AnAccelerationActsOnTheMaterialInItsBox) {
  constexpr double end = 2e-6;
  const cases::Case setup = cubes(
      "[[load]]\nacceleration = [0, 0, 1e6]\nbox = { lower = [0.01, 0, 0], upper = [0.02, 0.01, 0.01] }\n",
      end);
  solver::Simulation simulation(setup, parallel::world());
  const Vector3 before = sums_of(simulation.particles(), 1, 0.0).momentum;
  Balance balance;
  run_to(simulation, end, [&](const solver::Simulation& s) { balance(s); });
  balance.expect_exact();
  const BodySums other = sums_of(simulation.particles(), 1, 0.0);
  EXPECT_NEAR((other.momentum - before)[2], other.mass * 1e6 * end, 1e-12 * other.mass * 2.0);
  EXPECT_LT(std::abs(sums_of(simulation.particles(), 0, 0.0).momentum[2]), 1e-15 * before.norm());
}

TEST(AppliedLoad, DampingTakesTheMotionByTheExponentialAndBooksIt) {
  constexpr double end = 4e-6, rate = 0.5e6;
  const cases::Case setup = cubes("[[load]]\nbody = \"cube\"\ndamping = \"0.5e6 1/s\"\n", end);
  solver::Simulation simulation(setup, parallel::world());
  const BodySums start = sums_of(simulation.particles(), 0, 0.0);
  Balance balance;
  run_to(simulation, end, [&](const solver::Simulation& s) { balance(s); });
  balance.expect_exact();
  const Vector3 now = sums_of(simulation.particles(), 0, 0.0).momentum;
  EXPECT_LT((now - std::exp(-rate * end) * start.momentum).norm(), 1e-12 * start.momentum.norm());
  const double lost = 0.5 * (start.momentum.squaredNorm() - now.squaredNorm()) / start.mass;
  EXPECT_NEAR(simulation.state().ledger.external_work, -lost, 1e-3 * lost);
}

/// A block in front of a wall, pushed away by a pressure behind it: plane strain, rings.
TEST(AppliedLoad, APressureOnAPatchOfAWallPushesWithItsArea) {
  constexpr double end = 3e-6, pressure = 1e6;
  struct Patch {
    std::string dimension, box;
    double area;
  };
  for (const Patch& patch :
       {Patch{"plane_strain", "box = { lower = [0, 0.002], upper = [1, 0.004] }\n", 0.002},
        Patch{"axisymmetric", "", M_PI * 25e-6},  // the face has a radius of 6 mm, the block of 5 mm
        Patch{"axisymmetric", "box = { lower = [0, 0.002], upper = [1, 0.004] }\n", M_PI * (16e-6 - 4e-6)}}) {
    const cases::Case setup = cases::read_case_text(
        Method{}.time_toml(end) + Method{}.toml() + "[domain]\ndimension = \"" + patch.dimension +
            "\"\nlower = [0, 0]\nupper = [0.02, 0.006]\ncell_size = 0.001\nboundary = { x_lower = "
            "\"separating\" }\n"
            "[[load]]\nface = \"x_lower\"\npressure = 1e6\n" +
            patch.box +
            BodyOptions{"block", elastic_aluminium(), box({0, 0, -1}, {4 * cell, 5 * cell, 1})}.toml(),
        "patch.toml");
    solver::Simulation simulation(setup, parallel::world());
    Balance balance;
    run_to(simulation, end, [&](const solver::Simulation& s) { balance(s); });
    balance.expect_exact();
    const double exact = pressure * patch.area * end;
    EXPECT_NEAR(simulation.state().ledger.external_impulse[0], exact, 1e-12 * exact)
        << patch.dimension << patch.box;
    EXPECT_GT(simulation.totals().momentum[0], 0.99 * exact);  // the wall may push as well
  }
}

/// Material that leaves the cell at the face takes its share of the force along; no more than P A acts at any time.
TEST(AppliedLoad, APressureFadesAsMaterialLeavesTheFace) {
  constexpr double end = 40e-6, pressure = 200e6;
  const cases::Case setup = cases::read_case_text(
      Method{}.time_toml(end) + Method{}.toml() +
          "[output]\nmaximum_energy_error = 10.0\n[domain]\ndimension = \"plane_strain\"\nlower = [0, "
          "0]\nupper = [0.02, 0.006]\ncell_size = 0.001\nboundary = { x_lower = \"separating\" }\n"
          "[[load]]\nface = \"x_lower\"\npressure = 200e6\n" +
          BodyOptions{"block", elastic_aluminium(), box({0, 0, -1}, {4 * cell, 5 * cell, 1})}.toml(),
      "leaves.toml");
  solver::Simulation simulation(setup, parallel::world());
  double last = 0.0, most = 0.0;
  double time = 0.0;
  run_to(simulation, end, [&](const solver::Simulation& s) {
    const double impulse = s.state().ledger.external_impulse[0];
    most = std::max(most, (impulse - last) / (s.state().time - time));
    last = impulse;
    time = s.state().time;
  });
  const double force = pressure * 5 * cell;
  EXPECT_LE(most, force * (1.0 + 1e-9));
  // A rigid block on which F (1 - x/dx) acts leaves the cell with the momentum sqrt(F dx m).
  EXPECT_NEAR(last, std::sqrt(force * cell * simulation.totals().mass), 0.02 * last);
}

/// A damping on material at rest changes nothing; a force may begin later.
TEST(AppliedLoad, MaterialAtRestStaysSoUntilAForceBegins) {
  const std::string blocks = "[domain]\nlower = [0, 0, 0]\nupper = [0.02, 0.01, 0.01]\ncell_size = 0.001\n";
  const std::string body = BodyOptions{"cube", elastic_aluminium(),
                                       box({3 * cell, 3 * cell, 3 * cell}, {7 * cell, 7 * cell, 7 * cell})}
                               .toml();
  for (const std::string& scheme : std::array<std::string, 2>{"symplectic", "musl"}) {
    const std::string head = "[time]\nend = 2e-6\nscheme = \"" + scheme + "\"\n" + blocks;
    solver::Simulation damped(cases::read_case_text(head + "[[load]]\ndamping = 1e5\n" + body, "damped.toml"),
                              parallel::world());
    run_to(damped, 2e-6);
    EXPECT_EQ(damped.state().particles_at_rest, static_cast<std::int64_t>(damped.particle_count())) << scheme;
    EXPECT_EQ(damped.state().ledger.external_impulse.norm(), 0.0) << scheme;
    const std::string late = "[[load]]\nforce = [40, 0, 0]\ntimes = [1e-6, 1.1e-6]\nfactors = [0, 1]\n";
    solver::Simulation pushed(
        cases::read_case_text(head + "[[load]]\ndamping = 1e-3\n" + late + body, "late.toml"),
        parallel::world());
    run_to(pushed, 2e-6);
    EXPECT_NEAR(pushed.totals().momentum[0], 40 * 0.95e-6, 1e-6 * 40e-6) << scheme;
  }
}

/// Elements take a force as particles do; a thin box on their surface contains nodes.
TEST(AppliedLoad, NodesOfElementsTakeTheForce) {
  const std::string thin = "box = { lower = [0.00299, 0, 0], upper = [0.00301, 0.01, 0.01] }\n";
  for (const std::string& where : {std::string(), thin}) {
    const cases::Case setup = cubes("[[load]]\nbody = \"cube\"\nforce = [40, 0, 0]\n" + where, 1e-7,
                                    "discretization = { method = \"finite_elements\" }\n");
    solver::Simulation simulation(setup, parallel::world());
    Balance balance;
    run_to(simulation, 1e-7, [&](const solver::Simulation& s) { balance(s); });
    EXPECT_LT(balance.momentum, 1e-13);
    EXPECT_NEAR(simulation.state().ledger.external_impulse[0], 40e-7, 1e-12 * 40e-7) << where;
  }
}

TEST(AppliedLoad, GravityFollowsItsTable) {
  constexpr double end = 2e-6;
  const cases::Case setup =
      cubes("[gravity]\nacceleration = [0, 0, 1e6]\ntimes = [\"0 us\", \"1 us\"]\nfactors = [0, 1]\n", end);
  EXPECT_EQ(setup.gravity.at(0.5e-6)[2], 0.5e6);
  EXPECT_EQ(setup.gravity.at(1.5e-6)[2], 1e6);
  solver::Simulation simulation(setup, parallel::world());
  run_to(simulation, end);
  const double mass = simulation.totals().mass;
  EXPECT_NEAR(simulation.totals().momentum[2] / mass, 1.5, 1e-12);  // the exact mean over each step
}

/// A column of soil in a trough, in its weight from the start.
struct Column {
  int cells = 20;
  double k0 = 0.5, end = 0.5;
  std::string material, more = {};

  [[nodiscard]] cases::Case read() const {
    const double size = 1.0 / cells;  // m, of a column of 1 m
    return cases::read_case_text(
        Method{}.time_toml(end) + Method{}.toml() + "[output]\nmaximum_energy_error = 10.0\n[domain]\n" +
            "dimension = \"plane_strain\"\nlower = [0, 0]\nupper = " + vector3({4 * size, 1.2, 0}) +
            "\ncell_size = " + number(size) +
            "\nboundary = { x_lower = \"symmetry\", x_upper = \"symmetry\", y_lower = \"symmetry\" }\n" +
            "[gravity]\nacceleration = [0, -9.81, 0]\n" + more +
            BodyOptions{"soil", material, box({0, 0, -1}, {4 * size, 1, 1}), Vector3::Zero(),
                        "initial = { lithostatic = { surface = 1, k0 = " + number(k0) + " } }\n"}
                .toml(),
        "column.toml");
  }
};

std::string soil(const std::string& strength) {
  static int number_of_file = 0;
  return write_material("soil" + std::to_string(++number_of_file), R"toml(
name = "soil"
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
)toml" + strength);
}

TEST(Lithostatic, AColumnStaysAtRest) {
  for (const double k0 : {0.5, 1.0}) {
    double last = 0.0;
    for (const int cells : {20, 40}) {
      const Column column{.cells = cells,
                          .k0 = k0,
                          .material = soil(k0 == 1.0 ? "model = \"none\"\n"
                                                     : "model = \"mohr_coulomb\"\nshear_modulus = \"3 MPa\"\n"
                                                       "friction_angle = \"35 deg\"\ncohesion = \"0 Pa\"\n")};
      solver::Simulation simulation(column.read(), parallel::world());
      const Particles initial = simulation.particles();
      const double zero = initial.specific_internal_energy[0];
      const double stored = simulation.totals().internal_energy;
      double fastest = 0.0, lost = 0.0;  // lost relative to the stored energy: nothing else is exchanged
      run_to(simulation, column.end, [&](const solver::Simulation& s) {
        const solver::Ledger& ledger = s.state().ledger;
        lost = std::max(
            lost, std::abs(s.totals().energy() - ledger.initial.energy() - ledger.external_work) / stored);
        for (const Vector3& v : s.particles().velocity) fastest = std::max(fastest, v.norm());
      });
      EXPECT_LT(lost, 1e-12);
      double moved = 0.0, changed = 0.0;
      const Particles& now = simulation.particles();
      std::vector<std::size_t> of_id(now.size());
      for (std::size_t p = 0; p < now.size(); ++p) of_id[now.id[p]] = p;
      for (std::size_t p = 0; p < now.size(); ++p) {
        const std::size_t q = of_id[initial.id[p]];
        moved = std::max(moved, (now.position[q] - initial.position[p]).norm());
        changed = std::max(changed, std::abs(now.pressure[q] - initial.pressure[p]));
      }
      const double weight = 2000 * 9.81 * 1.0;
      std::printf("k0 %.1f, %d cells: moved %.3e m, pressure %.3e of the largest, fastest %.3e m/s, e %.3e\n",
                  k0, cells, moved, changed / weight, fastest, zero);
      EXPECT_LT(moved, 1e-6);                    // of a column of 1 m
      EXPECT_LT(changed, 0.1 / cells * weight);  // a tenth of the weight of a cell
      EXPECT_LT(simulation.totals().kinetic_energy, 1e-6 * weight * 0.5 * column.read().domain.upper[0]);
      if (last > 0.0) {
        EXPECT_LT(moved, 0.3 * last);  // second order
      }
      last = moved;
    }
  }
}

/// A block of soil that collapses on a rough floor: its flow changes the volume up to the bound, and no energy is made.
TEST(SoilHeap, DilatesAndKeepsTheTotalEnergy) {
  const std::string constants =
      "shear_modulus = \"3 MPa\"\nfriction_angle = \"35 deg\"\ncohesion = \"0 Pa\"\ndilation_angle = \"15 "
      "deg\"\nmaximum_dilation = 0.02\n";
  for (const std::string law :
       {"model = \"drucker_prager\"\nmatch = \"plane_strain\"\n", "model = \"mohr_coulomb\"\n"}) {
    const cases::Case setup = cases::read_case_text(
        Method{}.time_toml(0.4) + Method{}.toml() +
            "[output]\nmaximum_energy_error = 10.0\n[domain]\ndimension = \"plane_strain\"\nlower = [0, "
            "0]\nupper = "
            "[1, 0.3]\ncell_size = 0.02\nboundary = { x_lower = \"symmetry\", y_lower = \"no_slip\" }\n"
            "[gravity]\nacceleration = [0, -9.81, 0]\n" +
            BodyOptions{"soil", soil(law + constants), box({0, 0, -1}, {0.3, 0.2, 1})}.toml(),
        "heap.toml");
    solver::Simulation simulation(setup, parallel::world());
    double lost = 0.0, heat = 0.0;
    run_to(simulation, 0.4, [&](const solver::Simulation& s) {
      const solver::Ledger& ledger = s.state().ledger;
      lost = std::max(lost, std::abs(s.totals().energy() - ledger.initial.energy() - ledger.external_work));
      EXPECT_GE(ledger.plastic_work, heat);
      heat = ledger.plastic_work;
    });
    EXPECT_LT(lost, 1e-12 * simulation.state().ledger.external_work);
    EXPECT_GT(heat, 0.1 * simulation.state().ledger.external_work);
    double most = 1.0;
    std::size_t grown = 0;
    for (const double ratio : simulation.particles().history.scalar("distension")) {
      EXPECT_GE(ratio, 1.0);
      most = std::max(most, ratio);
      grown += ratio > 1.01 ? 1 : 0;
    }
    std::printf("greatest ln J_p %.4f, above 0.01 in %zu of %zu\n", std::log(most), grown,
                simulation.particles().size());
    EXPECT_LE(std::log(most), 0.02 * (1.0 + 1e-12));
    EXPECT_GT(grown, simulation.particles().size() / 20);
  }
}

}  // namespace
}  // namespace whipple::verification
