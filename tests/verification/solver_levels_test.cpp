// SPDX-License-Identifier: BSD-3-Clause
// Two cell sizes in one domain (docs/theory/levels.md): the weights, what is exact, and what stops a run.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "src/transfer/shape_function.hpp"
#include "tests/verification/every_method.hpp"
#include "tests/verification/same_state.hpp"

namespace whipple::verification {
namespace {

/// Sum of the quadratic splines of the coarse nodes whose cells k - 2 to k + 1 are all in the box (2), along one axis.
double sum_of_splines(double x, double from, double to) {
  double sum = 0.0;
  for (double k = std::ceil(from) + 2; k <= to - 2; ++k) {
    const double y = std::abs(x - k);
    sum += y < 0.5 ? 0.75 - y * y : y < 1.5 ? 0.5 * (1.5 - y) * (1.5 - y) : 0.0;
  }
  return sum;
}

TEST(Levels, WeightsAreSumsOfCoarseSplinesWithTheirGradients) {
  constexpr double none = grid::RefinedBox::no_end, fine = 0.25;  // m
  const grid::Levels levels(std::vector<grid::RefinedBox>{{{2, -none, -none}, {9, 7, none}}});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 24.0);
  for (int i = 0; i < 2000; ++i) {
    const Lanes x = {place(random), place(random), place(random), 0.0};  // fine cells
    const grid::Blend blend = levels.at(x, fine);
    const double expected = sum_of_splines(0.5 * x[0], 2, 9) * sum_of_splines(0.5 * x[1], -50, 7);
    ASSERT_NEAR(blend.fine, expected, 1e-14);
    for (int a = 0; a < 3; ++a) {
      constexpr double h = 1e-5;
      Lanes before = x, behind = x;
      before[a] -= h;
      behind[a] += h;
      const double slope = (levels.at(behind, fine).fine - levels.at(before, fine).fine) / (2 * h * fine);
      ASSERT_NEAR(blend.gradient[a], slope, 1e-4) << x[0] << " " << x[1];
    }
    // Where a level is not needed, it has no share.
    if (!levels.may_need(grid::Level::fine, x, Lanes{})) {
      EXPECT_EQ(blend.fine, 0.0);
    }
    if (!levels.may_need(grid::Level::coarse, x, Lanes{})) {
      EXPECT_EQ(blend.fine, 1.0);
    }
    if (!levels.is_refined(x)) {
      EXPECT_EQ(blend.fine, 0.0);
    }
  }
  EXPECT_EQ(levels.at(Lanes{11, 2, 5, 0}, fine).fine, 1.0);
}

TEST(Levels, OverlappingRegionsAreOneAndTheSharesOfBothLevelsAddUp) {
  constexpr double none = grid::RefinedBox::no_end;
  const grid::Levels levels(std::vector<grid::RefinedBox>{{{0, -none, -none}, {10, none, none}},
                                                          {{6, -none, -none}, {18, none, none}}});
  for (double x = 6.0; x < 30.0; x += 0.1) EXPECT_GT(levels.at(Lanes{x, 0, 0, 0}, 1.0).fine, 0.0) << x;
  const grid::Blend blend = levels.at(Lanes{2.9, 0, 0, 0}, 1.0);
  ASSERT_TRUE(blend.is_mixed());
  EXPECT_EQ(blend.share(grid::Level::fine) + blend.share(grid::Level::coarse), 1.0);
  EXPECT_EQ(blend.slope(grid::Level::fine), -blend.slope(grid::Level::coarse));
}

/// A block that lies around the corner of a region.
std::string block_at_corner(const std::string& material, const std::string& options = "") {
  return "[domain]\nlower = [0, 0, 0]\nupper = [0.016, 0.016, 0.012]\ncell_size = 0.0005\n"
         "[[domain.refinement]]\nlower = [0, 0, 0]\nupper = [0.0081, 0.0077, 0.012]\n"
         "[[body]]\nname = \"block\"\nmaterial = \"" +
         material +
         "\"\nshape = { box = { lower = [0.0044, 0.0041, 0.0047], upper = [0.0104, 0.0101, 0.0067] } }\n" +
         options;
}

cases::Case read(const Method& method, double end, const std::string& rest) {
  return cases::read_case_text(
      method.time_toml(end) + method.toml() + "[output]\nmaximum_energy_error = 1e9\n" + rest, "levels.toml");
}

solver::Simulation simulation_of(const cases::Case& setup, Particles particles) {
  solver::RunState state;
  const double inertia = transfer::affine_inertia(setup.transfer.shape_function, setup.domain.cell_size);
  state.ledger.initial = solver::totals_of(particles, {inertia, setup.geometry});
  return {setup, std::move(particles), state, parallel::world()};
}

bool is_affine(const Method& method) {
  return method.particle_update == "relaxed_affine" || method.particle_update == "apic";
}

// One step of a random state that an interface with a corner goes through.
TEST(EveryMethodOnTwoLevels, KeepsMassMomentumAndEnergyInEveryFrame) {
  const Vector3 common(3000, -2000, 1000);
  for (Method method : all_methods()) {
    if (method.particle_update == "fmpm") continue;
    constexpr double dt = 1e-8;
    method.first_step = 1.0;
    const cases::Case setup = read(method, 1.0, block_at_corner(elastic_aluminium()));
    Particles particles = cases::seed(setup).particles;
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      for (int a = 0; a < 3; ++a) particles.position[p][a] += 5e-5 * normal(random);
      particles.velocity[p] = 10 * Vector3(normal(random), normal(random), normal(random));
      particles.deviatoric_stress[p] = {
          1e6 * normal(random), 1e6 * normal(random), 0, 1e6 * normal(random), 0, 0};
      if (is_affine(method)) {
        for (int i = 0; i < 9; ++i) particles.affine_velocity[p].data()[i] = 1e3 * normal(random);
      }
    }
    Particles moving = particles;
    for (Vector3& v : moving.velocity) v += common;
    solver::Simulation a = simulation_of(setup, particles), b = simulation_of(setup, std::move(moving));
    a.advance(dt);
    b.advance(dt);
    const auto mixed = std::ranges::count_if(
        particles.position, [&](const Vector3& x) { return setup.geometry.blend(x).is_mixed(); });
    ASSERT_GT(mixed, static_cast<std::ptrdiff_t>(particles.size() / 10));
    const Particles& p = a.particles();
    const Particles& q = b.particles();
    double velocity = 0, position = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      ASSERT_EQ(p.id[i], q.id[i]);
      velocity = std::max(velocity, (q.velocity[i] - p.velocity[i] - common).norm());
      position = std::max(position, (q.position[i] - p.position[i] - dt * common).norm());
    }
    EXPECT_LT(velocity, 1e-8) << name_of(method);
    EXPECT_LT(position, 1e-15) << name_of(method);
    for (solver::Simulation* simulation : {&a, &b}) {
      EXPECT_LT(simulation->state().ledger.momentum_error(simulation->totals()), 1e-13) << name_of(method);
      EXPECT_NEAR(simulation->totals().mass / simulation->state().ledger.initial.mass, 1.0, 1e-13);
      if (method.scheme != "symplectic") continue;
      EXPECT_LT(std::abs(simulation->state().ledger.energy_error(simulation->totals())), 1e-12)
          << name_of(method);
    }
  }
}

// A linear velocity field stays one: velocities, affine fields and the rates of strain are exact wherever the functions
// are mixed, for particles at any place.
TEST(TwoLevels, KeepALinearVelocityField) {
  Matrix3 gradient;
  gradient << 3, -2, 1, 4, -1, 2, -3, 5, -2;
  gradient *= 1e3;  // 1/s
  for (const char* shape : {"quadratic_bspline", "cubic_bspline"}) {
    Method method;
    method.shape_function = shape;
    method.first_step = 1.0;
    method.linear_viscosity = method.quadratic_viscosity = 0.0;
    const cases::Case setup = read(method, 1.0, block_at_corner(elastic_aluminium()));
    Particles particles = cases::seed(setup).particles;
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      for (int a = 0; a < 3; ++a) particles.position[p][a] += 5e-5 * normal(random);
      particles.velocity[p] = gradient * particles.position[p];
      particles.affine_velocity[p] = gradient;
    }
    constexpr double dt = 1e-9;
    solver::Simulation simulation = simulation_of(setup, particles);
    simulation.advance(dt);
    Matrix3 carried = gradient * (Matrix3::Identity() + dt * gradient).inverse();
    carried *= std::min(1.0, gradient.norm() / carried.norm());  // it never grows
    const Particles& after = simulation.particles();
    for (std::size_t p = 0; p < after.size(); ++p) {
      const auto before =
          static_cast<std::size_t>(std::ranges::find(particles.id, after.id[p]) - particles.id.begin());
      ASSERT_LT((after.velocity[p] - particles.velocity[before]).norm(), 1e-11 * gradient.norm() * 0.01)
          << shape;
      const double density = after.mass[p] / after.volume[p] * (1.0 + dt * gradient.trace());
      ASSERT_NEAR(density / (particles.mass[before] / particles.volume[before]), 1.0, 1e-9) << shape;
      if (setup.geometry.cell_size_at(after.position[p]) !=
          setup.geometry.cell_size_at(particles.position[before]))
        continue;  // its field fits other cells now
      ASSERT_LT((after.affine_velocity[p] - carried).norm(), 1e-9 * gradient.norm()) << shape;
    }
  }
}

/// A bullet that flies through a region into a plate: splits, shocks, release, spall, walls.
cases::Case impact(const std::string& dimension, const std::string& rest = "") {
  const bool planar = dimension != "3d";
  const std::string material = aluminium("aluminium_of_levels", "0.3 GPa");
  const auto corner = [&](const char* x, const char* y) {
    return planar ? fmt::format("[{}, {}]", x, y) : fmt::format("[{}, {}, {}]", x, y, y);
  };
  return cases::read_case_text(
      Method{}.time_toml(3e-6) + Method{}.toml() +
          "[output]\nmaximum_energy_error = 1e9\n[domain]\ndimension = \"" + dimension +
          "\"\nlower = " + corner("-0.012", "0") + "\nupper = " + corner("0.02", "0.016") +
          "\ncell_size = 0.0005\nboundary = { y_lower = \"symmetry\"" +
          (planar ? "" : ", z_lower = \"symmetry\"") +
          " }\n[[domain.refinement]]\nlower = " + corner("-0.006", "0") +
          "\nupper = " + corner("0.006", "0.014") + "\n[[body]]\nname = \"bullet\"\nmaterial = \"" +
          material + "\"\nvelocity = " + (planar ? "[1500, 0]" : "[1500, 0, 0]") +
          "\nshape = { box = { lower = " + corner("-0.009", "0") + ", upper = " + corner("-0.001", "0.003") +
          " } }\n[[body]]\nname = \"plate\"\nmaterial = \"" + material + "\"\nshape = { box = { lower = " +
          corner("0", "0") + ", upper = " + corner("0.012", "0.012") + " } }\n" + rest,
      "impact.toml");
}

TEST(TwoLevels, KeepMassMomentumAndEnergyWhileParticlesEnterAndSplit) {
  for (const char* dimension : {"axisymmetric", "plane_strain", "3d"}) {
    solver::Simulation simulation(impact(dimension), parallel::world());
    const std::size_t before = simulation.particles().size();
    EnergyWatch watch;
    run_to(simulation, dimension == std::string("3d") ? 0.6e-6 : 3e-6, std::ref(watch));
    EXPECT_LT(watch.worst, 1e-12) << dimension;
    const solver::Ledger& ledger = simulation.state().ledger;
    EXPECT_LT(ledger.momentum_error(simulation.totals()), 1e-12) << dimension;
    EXPECT_NEAR(simulation.totals().mass / ledger.initial.mass, 1.0, 1e-12) << dimension;
    EXPECT_GT(simulation.particles().size(), before + 20) << dimension;  // the tail of the bullet came in
  }
}

/// A column of aluminium without strength along x, two coarse cells wide, with small cells up to a place, everywhere, or
/// nowhere.
enum class Cells { two_sizes, fine, coarse };
struct Column {
  double lower, upper, change;  ///< m
  double end;                   ///< s
  double velocity = 0.0;        ///< m/s
  double linear_viscosity = 0.25;
};
cases::Case column(Cells cells, const Column& of) {
  Method method;
  method.linear_viscosity = of.linear_viscosity;
  const std::string region =
      fmt::format("[[domain.refinement]]\nlower = [{}, 0]\nupper = [{}, 0.001]\n", of.lower, of.change);
  return cases::read_case_text(
      method.time_toml(of.end) + method.toml() +
          fmt::format(
              "[domain]\ndimension = \"plane_strain\"\nlower = [{}, 0]\nupper = [{}, 0.001]\n"
              "cell_size = {}\nboundary = {{ x_lower = \"symmetry\", y_lower = \"symmetry\", y_upper = "
              "\"symmetry\" }}\n{}[[body]]\nname = \"column\"\nmaterial = \"aluminium_mie_gruneisen\"\n"
              "velocity = [{}, 0]\nshape = {{ box = {{ lower = [{}, 0], upper = [{}, 0.001] }} }}\n",
              of.lower, of.upper, cells == Cells::coarse ? 0.0005 : 0.00025,
              cells == Cells::two_sizes ? region : "", of.velocity, of.lower, of.upper),
      "column.toml");
}

/// Kinetic energy behind a pulse that has gone by, over that of the pulse.
double left_behind(Cells cells) {
  const Column problem{
      .lower = -0.03, .upper = 0.05, .change = 0.015, .end = 5.5e-6, .linear_viscosity = 0.0};
  const cases::Case setup = column(cells, problem);
  Particles particles = cases::seed(setup).particles;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    // Half of it goes to either side: its width is four coarse cells.
    const double x = particles.position[p][0] / 0.002;
    particles.velocity[p][0] = std::exp(-0.5 * x * x);
    particles.affine_velocity[p](0, 0) = -x / 0.002 * std::exp(-0.5 * x * x);
  }
  solver::Simulation simulation = simulation_of(setup, std::move(particles));
  run_to(simulation, problem.end);  // the pulse is at 29 mm
  double gone = 0.0, left = 0.0;
  const Particles& after = simulation.particles();
  for (std::size_t p = 0; p < after.size(); ++p) {
    const double energy = 0.5 * after.mass[p] * after.velocity[p].squaredNorm();
    if (after.position[p][0] > 0.02) gone += energy;
    if (std::abs(after.position[p][0] - 0.001) < 0.009) left += energy;  // where a reflected one is by now
  }
  return left / gone;
}

// Acoustic waves go from cells of one size to those of the other without a reflection that could be told from the
// dispersion of either.
TEST(TwoLevels, ReflectNoPulse) {
  const double both = left_behind(Cells::two_sizes), fine = left_behind(Cells::fine),
               coarse = left_behind(Cells::coarse);
  std::printf("left behind by a pulse: %.2e with two sizes, %.2e fine, %.2e coarse\n", both, fine, coarse);
  EXPECT_LT(both, std::max(fine, coarse) + 1e-4);
}

// A shock that crosses the change is as fast and as strong behind it, and the crossing is counted.
TEST(TwoLevels, LetAShockThroughAndCountIt) {
  const Column problem{.lower = -0.02, .upper = 0.025, .change = -0.005, .end = 5.5e-6, .velocity = -1000.0};
  const auto state_behind = [&](Cells cells, double* counted) {
    solver::Simulation simulation(column(cells, problem), parallel::world());
    EnergyWatch watch;
    run_to(simulation, problem.end, std::ref(watch));  // the shock is at 11 mm
    EXPECT_LT(watch.worst, 1e-12);
    if (counted != nullptr) *counted = simulation.state().ledger.shocks_at_change;
    double pressure = 0.0, energy = 0.0, mass = 0.0;
    const Particles& p = simulation.particles();
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.position[i][0] < 0.0 || p.position[i][0] > 0.007) continue;
      mass += p.mass[i];
      pressure += p.mass[i] * p.pressure[i];
      energy += p.mass[i] * p.specific_internal_energy[i];
    }
    return std::pair(pressure / mass, energy / mass);
  };
  double counted = 0.0;
  const auto [p, e] = state_behind(Cells::two_sizes, &counted);
  const auto [exact_p, exact_e] = state_behind(Cells::fine, nullptr);
  EXPECT_GT(counted, 100.0);
  std::printf("behind a shock: p %.4f, e %.4f of uniform cells, %.0f counted\n", p / exact_p, e / exact_e,
              counted);
  EXPECT_NEAR(p / exact_p, 1.0, 0.01);
  EXPECT_NEAR(e / exact_e, 1.0, 0.05);
}

TEST(TwoLevels, ARestartIsBitwiseTheRunThatGoesOn) {
  const cases::Case setup = impact("axisymmetric");
  solver::Simulation simulation(setup, parallel::world());
  const TemporaryFolder folder;
  std::filesystem::path checkpoint;
  run_to(simulation, 1.5e-6, [&](const solver::Simulation& s) {
    if (s.state().step == 40) checkpoint = save(s, folder.path());
  });
  solver::Simulation restarted = restored(setup, checkpoint, parallel::world());
  run_to(restarted, 1.5e-6);
  EXPECT_EQ(restarted.state().step, simulation.state().step);
  expect_same(simulation, restarted);
}

// A rod that is hit at one end, with a region in its middle: the wave wakes the blocks of both levels in time.
TEST(TwoLevels, LeaveMatterAtRestAheadOfWaves) {
  const std::string rod =
      "[domain]\nlower = [0, 0, 0]\nupper = [0.06, 0.002, 0.002]\ncell_size = 0.0005\nboundary = { y_lower = "
      "\"symmetry\", y_upper = \"symmetry\", z_lower = \"symmetry\", z_upper = \"symmetry\" }\n"
      "[[domain.refinement]]\nlower = [0.02, 0, 0]\nupper = [0.028, 0.002, 0.002]\n[[body]]\nname = "
      "\"hammer\"\n"
      "material = \"" +
      elastic_aluminium() +
      "\"\nvelocity = [\"500 m/s\", 0, 0]\nshape = { box = { lower = [0.002, 0, 0], upper = [0.005, 0.004, "
      "0.004] } }\n"
      "[[body]]\nname = \"rod\"\nmaterial = \"" +
      elastic_aluminium() +
      "\"\nshape = { box = { lower = [0.005, 0, 0], upper = [0.058, 0.002, 0.002] } }\n";
  constexpr double end = 4.5e-6;
  Method method;
  method.options = "rest_tolerance = 0\n";
  solver::Simulation all(read(method, 1.0, rod), parallel::world());
  method.options = "";
  solver::Simulation awake(read(method, 1.0, rod), parallel::world());
  std::size_t most = 0;
  while (all.state().time < end) {
    all.advance(end);
    awake.advance(end);
    most = std::max(most, static_cast<std::size_t>(awake.state().particles_at_rest));
  }
  EXPECT_GT(most, awake.particles().size() / 2);
  EXPECT_LT(awake.state().particles_at_rest,
            static_cast<std::int64_t>(most / 2));  // the wave is through the region
  const Particles& p = all.particles();
  const Particles& q = awake.particles();
  ASSERT_EQ(p.size(), q.size());
  std::vector<std::size_t> place(p.size());
  for (std::size_t i = 0; i < q.size(); ++i) place.at(q.id[i]) = i;
  double velocity = 0, stress = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    velocity = std::max(velocity, (q.velocity[place[p.id[i]]] - p.velocity[i]).norm());
    stress = std::max(stress, std::abs(q.pressure[place[p.id[i]]] - p.pressure[i]));
  }
  EXPECT_LT(velocity, 500 * 1e-9);
  EXPECT_LT(stress, 4e9 * 1e-9);
  EXPECT_LT(awake.state().ledger.momentum_error(awake.totals()), 1e-12);
  EXPECT_LT(std::abs(awake.state().ledger.energy_error(awake.totals())), 1e-12);
}

TEST(TwoLevels, StopWhereBodiesMeetBetweenTheCellSizes) {
  const std::string material = elastic_aluminium();
  const auto body = [&](const char* name, double from, double to, double speed) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nvelocity = [{}, 0]\n"
        "shape = {{ box = {{ lower = [{}, 0.001], upper = [{}, 0.005] }} }}\n",
        name, material, speed, from, to);
  };
  const cases::Case setup =
      cases::read_case_text(Method{}.time_toml(3e-6) + Method{}.toml() +
                                "[domain]\ndimension = \"plane_strain\"\nlower = [-0.02, 0]\nupper = [0.02, "
                                "0.006]\ncell_size = 0.0005\n"
                                "[[domain.refinement]]\nlower = [0, 0]\nupper = [0.01, 0.006]\n" +
                                body("left", -0.008, -0.001, 1000) + body("right", 0.002, 0.009, 0),
                            "meeting.toml");
  solver::Simulation simulation(setup, parallel::world());
  try {
    run_to(simulation, 3e-6);
    ADD_FAILURE() << "no error";
  } catch (const StateError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("bodies meet where the cells change their size"));
    EXPECT_THAT(error.what(), testing::HasSubstr("body \""));
  }
}

/// A bullet of elements that become particles, onto a plate that leaves the small cells.
/// @param region  upper end along x of the small cells, m; 0: small cells everywhere
cases::Case bullet_of_elements(const std::string& dimension, double region) {
  const bool planar = dimension != "3d";
  const std::string material = "aluminium_6061_t6";  // domains that deform with one cell size too
  const auto corner = [&](double x, double y) {
    return planar ? fmt::format("[{}, {}]", x, y) : fmt::format("[{}, {}, {}]", x, y, y);
  };
  const auto box = [&](double from, double to, double half) {
    return fmt::format("shape = {{ box = {{ lower = {}, upper = {} }} }}\n", corner(from, 0),
                       corner(to, half));
  };
  const std::string levels = region > 0.0 ? fmt::format("[[domain.refinement]]\nlower = {}\nupper = {}\n",
                                                        corner(-0.012, 0), corner(region, 0.008))
                                          : "";
  return cases::read_case_text(
      Method{}.time_toml(3e-6) + Method{}.toml() +
          fmt::format("[domain]\ndimension = \"{}\"\nlower = {}\nupper = {}\ncell_size = 0.0005\n"
                      "boundary = {{ y_lower = \"symmetry\"{} }}\n{}",
                      dimension, corner(-0.012, 0), corner(0.016, 0.012),
                      planar ? "" : ", z_lower = \"symmetry\"", levels) +
          "[[body]]\nname = \"bullet\"\nmaterial = \"" + material +
          "\"\ndiscretization = { method = \"adaptive\" }\nconversion = { plastic_strain = 0.2 }\nvelocity "
          "= " +
          (planar ? "[1200, 0]" : "[1200, 0, 0]") + "\n" + box(-0.004, 0, 0.002) +
          "[[body]]\nname = \"plate\"\nmaterial = \"" + material + "\"\n" + box(0, 0.01, 0.01),
      "bullet.toml");
}

TEST(TwoLevels, HoldElementsInSmallCells) {
  for (const char* dimension : {"axisymmetric", "plane_strain", "3d"}) {
    solver::Simulation both(bullet_of_elements(dimension, 0.007), parallel::world());
    solver::Simulation small(bullet_of_elements(dimension, 0.0), parallel::world());
    EXPECT_LT(both.particles().size(), small.particles().size()) << dimension;
    const std::size_t elements = both.element_count();
    // What is beyond the change has no part in this: the shock has not arrived there.
    EnergyWatch watch;
    run_to(both, 0.12e-6, std::ref(watch));
    run_to(small, 0.12e-6);
    const solver::Totals a = both.totals(), b = small.totals();
    EXPECT_EQ(both.element_count(), small.element_count()) << dimension;
    EXPECT_NEAR(a.internal_energy / b.internal_energy, 1.0, 1e-9) << dimension;
    EXPECT_NEAR(a.kinetic_energy / b.kinetic_energy, 1.0, 1e-9) << dimension;
    run_to(both, dimension == std::string("3d") ? 0.5e-6 : 1.5e-6, std::ref(watch));
    EXPECT_LT(both.element_count(), elements) << dimension;  // some became particles
    EXPECT_LT(watch.worst, 1e-12) << dimension;
    EXPECT_LT(both.state().ledger.momentum_error(both.totals()), 1e-12) << dimension;
  }
}

TEST(TwoLevels, StopAnElementThatIsNotInSmallCells) {
  solver::Simulation simulation(bullet_of_elements("axisymmetric", 0.002), parallel::world());
  try {
    run_to(simulation, 3e-6);
    ADD_FAILURE() << "no error";
  } catch (const StateError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("body \"bullet\": a node of its elements or bars"));
    EXPECT_THAT(error.what(), testing::HasSubstr("domain.refinement"));
  }
}

TEST(Refinement, NamesWhatItCannotBe) {
  const auto faults_of = [](const std::string& region, const std::string& rest = "") -> std::string {
    try {
      cases::read_case_text(
          "[time]\nend = 1e-6\n[domain]\nlower = [0, 0, 0]\nupper = [0.016, 0.016, 0.016]\n"
          "cell_size = 0.0005\n[[domain.refinement]]\n" +
              region +
              "[[body]]\nname = \"block\"\nmaterial = \"aluminium\"\n"
              "shape = { box = { lower = [0, 0, 0], upper = [0.008, 0.008, 0.008] } }\n" +
              rest,
          "region.toml");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string box = "lower = [0, 0, 0]\nupper = [0.01, 0.01, 0.01]\n";
  using testing::HasSubstr;
  EXPECT_EQ(faults_of(box), "");
  EXPECT_EQ(faults_of("body = \"block\"\nmargin = \"2 mm\"\n"), "");
  EXPECT_THAT(faults_of(""), HasSubstr("corners, 'lower' and 'upper', or a 'body'"));
  EXPECT_THAT(faults_of("body = \"plate\"\n"), HasSubstr("no body \"plate\""));
  EXPECT_THAT(faults_of(box + "body = \"block\"\n"), HasSubstr("not both"));
  EXPECT_THAT(faults_of(box + "margin = 0.001\n"), HasSubstr("'margin'"));
  EXPECT_THAT(faults_of("lower = [0.004, 0, 0]\nupper = [0.007, 0.01, 0.01]\n"),
              HasSubstr("3 cells of 0.001 m thick along x"));
  EXPECT_THAT(faults_of("lower = [0.02, 0, 0]\nupper = [0.04, 0.01, 0.01]\n"),
              HasSubstr("no cell of the domain"));
  EXPECT_THAT(faults_of(box, "[transfer]\nrandom_shift = true\n"), HasSubstr("no random shift"));
  EXPECT_THAT(faults_of(box, "volumetric = \"cell\"\n"), HasSubstr("no means over cells"));
  EXPECT_EQ(faults_of(box, "discretization = { method = \"finite_elements\" }\n"), "");
}

}  // namespace
}  // namespace whipple::verification
