// SPDX-License-Identifier: BSD-3-Clause
// Cracks as velocity fields (docs/theory/cracks.md): faces separate without an impulse and are in contact when pushed
// together; energy and momentum remain exact with planes, walls and other bodies, in two and three dimensions; a
// restart needs no stored data. A bar that tears dissipates an energy per area.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tests/verification/crack_problems.hpp"
#include "tests/verification/same_state.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple {
namespace {

using solver::Simulation;
using namespace verification;

/// Describes discretization and motion of the halves of a block.
struct Problem {
  std::string dimension;
  std::string cracks = "fields";
  double speed = 0.0;                    ///< v, m/s
  std::string right_half = "particles";  ///< discretization
  double gap = 0.0;                      ///< mm, between the column and the right half
  double slide = 0.0;                    ///< m/s, of the right half along z
  std::string contact = "";              ///< lines of that table
};

/// Two halves of an elastic block with a failed column of particles between them, moving at -v and v.
class Halves {
 public:
  explicit Halves(const Problem& problem)
      : simulation_([&] {
          const bool in_space = problem.dimension == "3d";
          const cases::Case setup = cases::read_case_text(
              fmt::format("[domain]\ndimension = \"{}\"\nlower = [-0.012, 0{}]\nupper = [0.012, 0.006{}]\n"
                          "cell_size = 0.001\nboundary = {{ y_lower = \"symmetry\" }}\n[time]\nend = 4e-6\n"
                          "[contact]\n{}\n",
                          problem.dimension, in_space ? ", -0.003" : "", in_space ? ", 0.003" : "",
                          problem.contact) +
                  part("left", -8.0, -0.25, {-problem.speed, 0.0, 0.0}) + "failure = { cracks = \"" +
                  problem.cracks + "\" }\n" + part("column", -0.25, 0.25, {-problem.speed, 0.0, 0.0}) +
                  part("right", 0.25 + problem.gap, 8.25 + problem.gap, {problem.speed, 0.0, problem.slide}) +
                  "discretization = { method = \"" + problem.right_half + "\" }\n",
              "halves.toml");
          const Simulation seeded(setup, parallel::world());
          Particles particles = *seeded.contents().particles;
          for (std::size_t p = 0; p < particles.size(); ++p) {
            // Across a gap there is a failed row on each face: a single row could join either face.
            const bool faces_gap = problem.gap > 0.0 && particles.body[p] == 2 &&
                                   particles.position[p].x() < 1e-3 * (0.6 + problem.gap);
            if (particles.body[p] == 1 || faces_gap) particles.failed[p] = 1;
          }
          return Simulation(setup, std::move(particles), seeded.state(), parallel::world(), seeded.meshes());
        }()) {}

  Simulation& simulation() { return simulation_; }
  /// Returns the largest difference of the velocity of a body's particles from a speed (m/s).
  double deviation(std::uint32_t body, double speed) const {
    double worst = 0.0;
    for (std::size_t p = 0; p < simulation_.particles().size(); ++p) {
      if (simulation_.particles().body[p] != body) continue;
      worst = std::max(worst, (simulation_.particles().velocity[p] - Vector3(speed, 0.0, 0.0)).norm());
    }
    return worst;
  }
  /// Returns the largest difference for nodes of elements.
  double deviation_of_nodes(double speed) const {
    double worst = 0.0;
    for (const fem::Mesh& mesh : simulation_.meshes()) {
      for (const Vector3& v : mesh.nodes.velocity) {
        worst = std::max(worst, (v - Vector3(speed, 0.0, 0.0)).norm());
      }
    }
    return worst;
  }
  /// Returns the momentum along x per mass of a body (m/s).
  double mean_speed(std::uint32_t body) const {
    double mass = 0.0, momentum = 0.0;
    for (std::size_t p = 0; p < simulation_.particles().size(); ++p) {
      if (simulation_.particles().body[p] != body) continue;
      mass += simulation_.particles().mass[p];
      momentum += simulation_.particles().mass[p] * simulation_.particles().velocity[p].x();
    }
    return momentum / mass;
  }

 private:
  static std::string part(const char* name, double from, double to, const Vector3& velocity) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\ncontact_group = \"block\"\nvelocity = [{}, {}, {}]\n"
        "shape = {{ box = {{ lower = [{}, 0, -0.002], upper = [{}, 0.004, 0.002] }} }}\n",
        name, elastic_aluminium(), velocity.x(), velocity.y(), velocity.z(), 1e-3 * from, 1e-3 * to);
  }
  Simulation simulation_;
};

class CracksInDimension : public testing::TestWithParam<const char*> {};

TEST_P(CracksInDimension, PartWithoutAnImpulse) {
  constexpr double speed = 100.0;
  Halves apart({.dimension = GetParam(), .speed = speed});
  Halves whole({.dimension = GetParam(), .cracks = "none", .speed = speed});
  for (int step = 0; step < 40; ++step) apart.simulation().advance(1.0);
  for (int step = 0; step < 40; ++step) whole.simulation().advance(1.0);
  EXPECT_LT(apart.deviation(0, -speed), 1e-9 * speed);
  EXPECT_LT(apart.deviation(2, speed), 1e-9 * speed);
  EXPECT_GT(whole.deviation(2, speed), 0.1 * speed);  // the failed column still connects the halves
}

TEST(Cracks, PartElementsFromParticles) {
  constexpr double speed = 100.0;
  Halves apart({.dimension = "3d", .speed = speed, .right_half = "finite_elements"});
  Halves whole({.dimension = "3d", .cracks = "none", .speed = speed, .right_half = "finite_elements"});
  for (int step = 0; step < 40; ++step) apart.simulation().advance(1.0);
  for (int step = 0; step < 40; ++step) whole.simulation().advance(1.0);
  // Not exact: where the damage is below its minimum there are nodes that both sides reach with small weights.
  EXPECT_LT(apart.deviation(0, -speed), 1e-3 * speed);
  EXPECT_LT(apart.deviation_of_nodes(speed), 1e-3 * speed);
  EXPECT_GT(whole.deviation_of_nodes(speed), 0.1 * speed);
}

TEST_P(CracksInDimension, PressLikeOneField) {
  constexpr double speed = -100.0;
  Halves apart({.dimension = GetParam(), .speed = speed});
  Halves whole({.dimension = GetParam(), .cracks = "none", .speed = speed});
  EnergyWatch watch;
  run_to(apart.simulation(), 1.5e-6, std::ref(watch));
  run_to(whole.simulation(), 1.5e-6);
  EXPECT_LT(watch.worst, 1e-12);
  // Half of the block has transferred its momentum to the wave.
  EXPECT_GT(whole.mean_speed(2), 0.5 * speed);
  EXPECT_NEAR(apart.mean_speed(2), whole.mean_speed(2), 0.02 * std::abs(speed));
}

// Column and right half are half a cell apart; the gap closes after 2.5 us.
TEST_P(CracksInDimension, DoNotPressBeforeTheyTouch) {
  constexpr double speed = -100.0;
  Halves faces({.dimension = GetParam(), .speed = speed, .gap = 0.5});
  Halves early({.dimension = GetParam(), .speed = speed, .gap = 0.5, .contact = "gap_test = false"});
  EnergyWatch watch;
  run_to(faces.simulation(), 2.4e-6, std::ref(watch));
  run_to(early.simulation(), 2.4e-6);
  for (const std::uint32_t body : {0U, 1U})
    EXPECT_LT(faces.deviation(body, -speed), 1e-9 * std::abs(speed)) << body;
  EXPECT_LT(faces.deviation(2, speed), 1e-9 * std::abs(speed));
  EXPECT_GT(early.deviation(2, speed), 0.1 * std::abs(speed));
  run_to(faces.simulation(), 4e-6, std::ref(watch));
  EXPECT_GT(faces.mean_speed(2), 0.6 * speed);
  EXPECT_LT(watch.worst, 1e-12);
  EXPECT_LT(faces.simulation().state().ledger.momentum_error(faces.simulation().totals()), 1e-12);
}

// Pushed together while one face slides: friction is at most its coefficient times the normal impulse.
TEST(Cracks, FacesRubOnOneAnother) {
  const auto ledger_with = [](const std::string& contact) {
    Halves halves({.dimension = "3d", .speed = -100.0, .slide = 100.0, .contact = contact});
    EnergyWatch watch;
    run_to(halves.simulation(), 1.5e-6, std::ref(watch));
    EXPECT_LT(watch.worst, 1e-12);
    EXPECT_LT(halves.simulation().state().ledger.momentum_error(halves.simulation().totals()), 1e-12);
    return halves.simulation().state().ledger;
  };
  const auto smooth = ledger_with("crack_friction = 0.0"), rough = ledger_with("crack_friction = 0.2"),
             usual = ledger_with("");
  EXPECT_EQ(smooth.friction_impulse, 0.0);
  EXPECT_GT(rough.friction_heat, 0.0);
  // Where they stick it is less.
  EXPECT_LE(rough.friction_impulse, 0.2 * rough.contact_impulse);
  EXPECT_GT(rough.friction_impulse, 0.16 * rough.contact_impulse);
  EXPECT_LE(usual.friction_impulse, 0.3 * usual.contact_impulse);
  EXPECT_GT(usual.friction_impulse, 1.1 * rough.friction_impulse);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, CracksInDimension, testing::Values("plane_strain", "3d"));

/// Balances of a run with cracks.
void expect_exact(const std::string& dimension, double end) {
  Simulation simulation(breaking_plate(dimension, "fields"), parallel::world());
  EnergyWatch watch;
  run_to(simulation, end, std::ref(watch));
  EXPECT_LT(watch.worst, 1e-12);
  EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-12);
  const Particles& particles = simulation.particles();
  const auto failed = std::ranges::count_if(particles.failed, [](std::uint8_t code) { return code != 0; });
  EXPECT_GT(failed, 0);
  EXPECT_LT(static_cast<std::size_t>(failed), particles.size());
  Simulation whole(breaking_plate(dimension, "none"), parallel::world());
  run_to(whole, end);
  EXPECT_GT(largest_distance(particles, whole.particles()), 1e-5);  // the cracks did open
}

TEST(Cracks, KeepEnergyAndMomentumBesidePlanesWallsAndOtherBodies) {
  for (const char* dimension : {"plane_strain", "axisymmetric", "3d"}) {
    SCOPED_TRACE(dimension);
    expect_exact(dimension, 3e-6);
  }
}

/// Work of the deviator per area of a crack (J/m^2), from the first damage on.
struct CrackWork {
  double in_tension = 0.0, in_all = 0.0;
};

/// Stretches a bar at 4e4 1/s that may tear in `width` cells of its middle, until nearly all of these have failed.
CrackWork work_of_a_crack(double cell, double width, double energy_per_area) {
  const std::string solid = aluminium("plain_aluminium", "300 MPa");
  const std::string tears =
      aluminium("tearing_aluminium", "300 MPa",
                fmt::format("[[failure]]\nmodel = \"tearing\"\nsource = \"test\"\nfailure_strain = 0.05\n"
                            "energy_per_area = \"{} J/m^2\"\n",
                            energy_per_area));
  constexpr double height = 2e-3, half_length = 10e-3;
  const auto part = [&](const char* name, const std::string& material, double from, double to) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\ncontact_group = \"bar\"\nexpansion_rate = [4e4, 0, 0]\n"
        "shape = {{ box = {{ lower = [{}, 0, -0.001], upper = [{}, {}, 0.001] }} }}\n",
        name, material, from, to, height);
  };
  const double edge = 0.5 * width * cell;
  solver::Simulation simulation(
      cases::read_case_text(
          fmt::format(
              "[domain]\ndimension = \"plane_strain\"\nlower = [-0.02, -0.004]\nupper = [0.02, 0.006]\n"
              "cell_size = {}\n[time]\nend = 5e-6\n",
              cell) +
              part("left", solid, -half_length, -edge) + part("middle", tears, -edge, edge) +
              part("right", solid, edge, half_length),
          "bar.toml"),
      parallel::world());
  const Particles& particles = simulation.particles();
  std::vector<double> strain(particles.size(), 0.0), stress(particles.size(), 0.0);
  CrackWork work;
  double failed = 0.0;
  while (failed < 0.9 && simulation.state().time < 5e-6) {
    simulation.advance(5e-6);
    const std::vector<double>& damage = particles.history.scalar("damage");
    double broken = 0.0, whole = 0.0;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const double now = std::sqrt(1.5 * particles.deviatoric_stress[p].squared_norm());
      if (damage[p] > 0.0) {
        const double of_step = 0.5 * (now + stress[p]) * (particles.plastic_strain[p] - strain[p]) *
                               particles.volume[p] / height;
        work.in_all += of_step;
        if (particles.pressure[p] <= 0.0) work.in_tension += of_step;
      }
      stress[p] = now;
      strain[p] = particles.plastic_strain[p];
      if (particles.body[p] == 1) (particles.failed[p] != 0 ? broken : whole) += 1.0;
    }
    failed = broken / (broken + whole);
  }
  EXPECT_GT(failed, 0.4) << "the bar holds";
  return work;
}

// A middle as wide as the band of the law, one cell, dissipates the energy of the law in tension on three grids.
// Damaged material that is strained under pressure, when waves return from the ends, adds a fifth to two fifths.
TEST(Tearing, OfABarTakesItsEnergyPerAreaOnThreeGrids) {
  constexpr double energy = 5e3;
  for (const double cell : {1e-3, 0.5e-3, 0.25e-3}) {
    const CrackWork work = work_of_a_crack(cell, 1.0, energy);
    std::printf("cells of %g mm: in tension %.3f, in all %.3f of the energy per area\n", 1e3 * cell,
                work.in_tension / energy, work.in_all / energy);
    EXPECT_NEAR(work.in_tension, energy, 0.2 * energy) << cell;
    EXPECT_LT(work.in_all, 1.5 * energy) << cell;
  }
}

// Softening that no lattice confines to a cell spreads to the next one: two cells that may tear dissipate up to twice
// as much.
TEST(Tearing, SpreadsOverTwoCells) {
  constexpr double energy = 5e3;
  for (const double cell : {1e-3, 0.5e-3}) {
    const CrackWork work = work_of_a_crack(cell, 2.0, energy);
    std::printf("cells of %g mm: in tension %.3f, in all %.3f of the energy per area\n", 1e3 * cell,
                work.in_tension / energy, work.in_all / energy);
    EXPECT_GT(work.in_tension, 0.8 * energy) << cell;
    EXPECT_LT(work.in_tension, 2.4 * energy) << cell;
  }
}

TEST(Cracks, RestartBitwise) {
  const cases::Case setup = breaking_plate("plane_strain", "fields");
  Simulation whole(setup, parallel::world());
  run_to(whole, 1.5e-6);
  const TemporaryFolder folder;
  Simulation restarted = restored(setup, save(whole, folder.path()), parallel::world());
  while (whole.state().time < 2.5e-6) {
    whole.advance(2.5e-6);
    restarted.advance(2.5e-6);
  }
  expect_same(whole, restarted);
}

TEST(Cracks, ChangeNothingUntilSomethingFails) {
  Simulation with(breaking_plate("plane_strain", "fields", 1e3), parallel::world());
  Simulation without(breaking_plate("plane_strain", "none", 1e3), parallel::world());
  run_to(with, 1e-6);
  run_to(without, 1e-6);
  expect_same(with, without);
}

}  // namespace
}  // namespace whipple
