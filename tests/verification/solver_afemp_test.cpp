// SPDX-License-Identifier: BSD-3-Clause
// Bodies of finite elements in the solver: alone, against walls, in contact with particles, and converted to particles;
// waves through the interface to the grid; restart and threads.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "src/afemp/transition.hpp"
#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/fem/step.hpp"
#include "src/material/update.hpp"
#include "tests/verification/same_state.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

using solver::Simulation;

cases::Case read(const std::string& text) { return cases::read_case_text(text, "afemp.toml"); }

/// Returns the text with one occurrence replaced.
std::string with(std::string text, const std::string& old, const std::string& changed) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw InternalError("the case does not hold " + old);
  return text.replace(at, old.size(), changed);
}

/// Returns a case of an adaptive cube of aluminium on a plate of particles at 2 km/s, a quarter model.
std::string impact(const std::string& method, const std::string& element) {
  static const std::string material = aluminium("afemp_aluminium", "0.3 GPa");
  return fmt::format(R"(
[domain]
lower = ["0 mm", "0 mm", "-6 mm"]
upper = ["12 mm", "12 mm", "8 mm"]
cell_size = "1 mm"
boundary = {{ x_lower = "symmetry", y_lower = "symmetry" }}
[time]
end = "2 us"
[[body]]
name = "plate"
material = "{0}"
shape = {{ box = {{ lower = ["0 mm", "0 mm", "-4 mm"], upper = ["8 mm", "8 mm", "0 mm"] }} }}
[[body]]
name = "cube"
material = "{0}"
velocity = ["200 m/s", "0 m/s", "-2 km/s"]
discretization = {{ method = "{1}", element = "{2}" }}
{3}
shape = {{ box = {{ lower = ["0 mm", "0 mm", "0.5 mm"], upper = ["3 mm", "3 mm", "6.5 mm"] }} }}
)",
                     material, method, element,
                     method == "adaptive" ? "conversion = { plastic_strain = 0.4 }" : "");
}

class Impact : public testing::TestWithParam<const char*> {};

TEST_P(Impact, OfAnAdaptiveBodyKeepsEnergyMassAndMomentum) {
  Simulation simulation(read(impact("adaptive", GetParam())), parallel::world());
  const double mass = simulation.totals().mass;
  const std::size_t elements = simulation.element_count();
  double energy = 0, momentum = 0;
  std::size_t transition = 0;
  run_to(simulation, 2e-6, [&](const Simulation& s) {
    energy = std::max(energy, std::abs(s.state().ledger.energy_error(s.totals())));
    momentum = std::max(momentum, s.state().ledger.momentum_error(s.totals()));
    for (const std::uint8_t flag : s.meshes().front().nodes.in_transition) transition += flag;
  });
  EXPECT_LT(energy, 1e-12);
  EXPECT_LT(momentum, 1e-12);
  EXPECT_NEAR(simulation.totals().mass + simulation.state().ledger.outflow.mass, mass, 1e-13 * mass);
  EXPECT_GT(transition, 0U);
  EXPECT_LT(simulation.element_count(), elements);
  EXPECT_GT(simulation.element_count(), 0U);
  EXPECT_GT(simulation.state().ledger.converted_mass, 0.0);
  // The heat of conversion is small compared with the energy of the impact.
  EXPECT_LT(simulation.state().ledger.conversion_heat, 0.02 * simulation.state().ledger.initial.energy());
  RecordProperty("elements", static_cast<int>(simulation.element_count()));
  fmt::print("{}: {} of {} elements left, energy {:.1e}, momentum {:.1e}, heat of conversion {:.2e} %\n",
             GetParam(), simulation.element_count(), elements, energy, momentum,
             100 * simulation.state().ledger.conversion_heat / simulation.state().ledger.initial.energy());
}
INSTANTIATE_TEST_SUITE_P(Elements, Impact, testing::Values("one_point", "b_bar"));

TEST(Adaptive, WarnsOfThresholdsThatConvertEverythingAndOfContactAtTheStart) {
  const auto log_of_first_step = [](const std::string& text) {
    testing::internal::CaptureStderr();
    Simulation simulation(read(text), parallel::world());
    simulation.advance(1e-9);
    return testing::internal::GetCapturedStderr();
  };
  const std::string contact = impact("adaptive", "one_point") + "\n[contact]\nmethod = \"none\"\n";
  EXPECT_THAT(log_of_first_step(contact), testing::HasSubstr("16 nodes of its surface are within two cells"));
  EXPECT_THAT(log_of_first_step(with(contact, "0.5 mm", "2.5 mm")),
              testing::Not(testing::HasSubstr("within two cells")));
  EXPECT_THAT(log_of_first_step(with(contact, "plastic_strain = 0.4", "time_step_ratio = 1.0")),
              testing::HasSubstr("turn all of its 54 elements into particles"));
}

TEST(Adaptive, ResultIsBitwiseTheSameForOneAndTwoThreads) {
  const cases::Case setup = read(impact("adaptive", "one_point"));
  const int threads = parallel::threads();
  parallel::set_threads(1);
  Simulation one(setup, parallel::world());
  run_to(one, 1e-6);
  parallel::set_threads(2);
  Simulation two(setup, parallel::world());
  run_to(two, 1e-6);
  parallel::set_threads(threads);
  expect_same(one, two);
}

TEST(Adaptive, RestartIsBitwiseTheRunThatGoesOn) {
  const TemporaryFolder folder;
  for (const char* element : {"one_point", "b_bar"}) {
    const cases::Case setup = read(impact("adaptive", element));
    Simulation whole(setup, parallel::world());
    // During contact and conversion; in steps, as end times would shorten them
    for (int step = 0; step < 100; ++step) whole.advance(4e-6);
    Simulation restarted = restored(setup, save(whole, folder.path()), parallel::world());
    for (int step = 0; step < 30; ++step) {
      whole.advance(4e-6);
      restarted.advance(4e-6);
    }
    EXPECT_GT(whole.state().ledger.converted_mass, 0.0);
    expect_same(whole, restarted);
  }
}

// A bar that flies and vibrates freely never reaches the grid: the solver gives the result of the finite element
// library with the same time steps.
TEST(Elements, ABodyByItselfIsThatOfTheLibrary) {
  for (const char* element : {"one_point", "b_bar"}) {
    const cases::Case setup = read(fmt::format(R"(
[domain]
lower = ["-4 mm", "-4 mm", "-12 mm"]
upper = ["4 mm", "4 mm", "12 mm"]
cell_size = "1 mm"
[time]
end = "20 us"
[[body]]
name = "bar"
material = "{}"
velocity = ["10 m/s", "0 m/s", "-30 m/s"]
angular_velocity = ["2e4 rad/s", "0 rad/s", "4e5 rad/s"]
discretization = {{ method = "finite_elements", element = "{}" }}
shape = {{ box = {{ lower = ["-1.5 mm", "-1.5 mm", "-8 mm"], upper = ["1.5 mm", "1.5 mm", "8 mm"] }} }}
)",
                                               aluminium("afemp_bar", "0.2 GPa"), element));
    Simulation simulation(setup, parallel::world());
    fem::Mesh mesh = simulation.meshes().front();
    fem::Motion motion;
    fem::VelocityGradients gradient;
    gradient.resize(mesh.points.size());
    while (simulation.state().time < 5e-6) {
      const double time = simulation.state().time;
      simulation.advance(5e-6);
      const double dt = simulation.state().time_step;
      fem::internal_forces(mesh);
      fem::advance_velocities(mesh, dt, motion);
      fem::deform(mesh, motion, dt, {}, gradient);
      fem::move_nodes(mesh, motion, dt);
      update_material(*setup.materials[0], mesh.points, 0, mesh.points.size(), gradient.from(0),
                      {.time_step = dt, .lengths = mesh.points.length, .time = time + dt});
    }
    const fem::Mesh& same = simulation.meshes().front();
    expect_same(same.nodes, mesh.nodes);
    expect_same(same.points, mesh.points);
    expect_same(same.elements, mesh.elements);
    EXPECT_LT(std::abs(simulation.state().ledger.energy_error(simulation.totals())), 1e-12);
    EXPECT_GT(*std::ranges::max_element(mesh.points.plastic_strain), 1e-3);
  }
}

/// A column of 70 cells of elements and as many of particles, with a smooth velocity pulse in one of them.
struct Interface {
  static constexpr double start = 0.02, width = 0.024, seen = 0.03, speed = 1.0;

  static cases::Case column(const std::string& transfer) {
    return read(fmt::format(R"(
[domain]
lower = ["0 mm", "0 mm", "-75 mm"]
upper = ["2 mm", "2 mm", "75 mm"]
cell_size = "1 mm"
boundary = {{ x_lower = "symmetry", x_upper = "symmetry", y_lower = "symmetry", y_upper = "symmetry" }}
[time]
end = "100 us"
[transfer]
{1}
[artificial_viscosity]
linear = 0
quadratic = 0
[output]
maximum_energy_error = 1e9
[[body]]
name = "elements"
material = "{0}"
discretization = {{ method = "finite_elements" }}
shape = {{ box = {{ lower = ["0 mm", "0 mm", "-70 mm"], upper = ["2 mm", "2 mm", "0 mm"] }} }}
[[body]]
name = "particles"
material = "{0}"
shape = {{ box = {{ lower = ["0 mm", "0 mm", "0 mm"], upper = ["2 mm", "2 mm", "70 mm"] }} }}
)",
                            elastic_aluminium(), transfer));
  }

  /// Returns the fraction of the wave that is reflected by the interface.
  static double reflection(bool from_elements, const std::string& transfer) {
    const cases::Case setup = column(transfer);
    const Simulation seeded(setup, parallel::world());
    Particles particles = seeded.particles();
    std::vector<fem::Mesh> meshes = seeded.meshes();
    const double center = from_elements ? -start : start;
    const auto pulse = [&](double z) {
      const double s = (z - center) / width;
      return std::abs(s) < 0.5 ? speed * std::pow(std::cos(M_PI * s), 2) : 0.0;
    };
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.velocity[p][2] = pulse(particles.position[p][2]);
    }
    fem::Nodes& nodes = meshes[0].nodes;
    for (std::size_t a = 0; a < nodes.size(); ++a) nodes.velocity[a][2] = pulse(nodes.position[a][2]);
    solver::RunState state;
    state.ledger.initial.kinetic_energy = 1.0;  // J, a scale: the velocities are given afterwards
    Simulation simulation(setup, particles, state, parallel::world(), meshes);
    const double c = particles.sound_speed[0];
    // Half of the pulse travels to the interface and 30 mm further; the reflection is then 30 mm in front of it. The
    // other half is at the far end.
    const double end = (start + seen) / c;
    simulation_to(simulation, end);
    double back = 0, through = 0;
    const auto see = [&](double z, double v) {
      const double depth = from_elements ? -z : z;  // on the side where the wave started
      if (std::abs(depth - seen) < 0.5 * width) back = std::max(back, std::abs(v));
      if (std::abs(depth + seen) < 0.5 * width) through = std::max(through, std::abs(v));
    };
    for (std::size_t p = 0; p < simulation.particles().size(); ++p) {
      see(simulation.particles().position[p][2], simulation.particles().velocity[p][2]);
    }
    const fem::Nodes& now = simulation.meshes()[0].nodes;
    for (std::size_t a = 0; a < now.size(); ++a) see(now.position[a][2], now.velocity[a][2]);
    fmt::print("from {}: through {:.4f}, back {:.5f} of {}\n", from_elements ? "elements" : "particles",
               through, back, 0.5 * speed);
    EXPECT_GT(through, 0.45 * speed);
    return back / (0.5 * speed);
  }

  static void simulation_to(Simulation& simulation, double end) {
    while (simulation.state().time < end) simulation.advance(end);
  }
};

TEST(Interface, LetsWavesThroughBothWays) {
  EXPECT_LT(Interface::reflection(true, ""), 0.01);
  EXPECT_LT(Interface::reflection(false, ""), 0.01);
}

// With one particle at the Gauss point of every cell, one step with linear functions equals one step of one-point
// elements whose nodes are those of the grid: the same strain, stress and plastic strain.
TEST(Elements, AStepOfTheirGridIsThatOfParticlesAtTheirGaussPoints) {
  const std::string material = aluminium("afemp_step", "0.02 GPa");
  const std::string common = fmt::format(R"(
[domain]
lower = ["-3 mm", "-3 mm", "-3 mm"]
upper = ["7 mm", "7 mm", "7 mm"]
cell_size = "1 mm"
[time]
end = "1 us"
courant = 0.1
first_step = 1
compression_limit = 1
[output]
maximum_energy_error = 1e9
[[body]]
name = "body"
material = "{}"
shape = {{ box = {{ lower = ["0 mm", "0 mm", "0 mm"], upper = ["4 mm", "3 mm", "4 mm"] }} }}
)",
                                         material);
  const cases::Case of_particles =
      read(common +
           "discretization = { per_cell = 1 }\n[transfer]\nshape_function = \"linear\"\n"
           "particle_update = \"flip\"\n");
  const cases::Case of_elements =
      read(common + "discretization = { method = \"finite_elements\", hourglass_coefficient = 0 }\n");
  const Simulation seeded(of_particles, parallel::world());
  Particles particles = seeded.particles();
  std::srand(3);
  for (Vector3& v : particles.velocity) v = 1000.0 * Vector3::Random();
  solver::RunState state;
  state.ledger.initial.kinetic_energy = 1.0;  // J, a scale: the velocities are given afterwards
  Simulation mpm(of_particles, particles, state, parallel::world());
  std::vector<fem::Mesh> meshes = Simulation(of_elements, parallel::world()).meshes();
  fem::Nodes& nodes = meshes[0].nodes;
  std::ranges::fill(nodes.velocity, Vector3::Zero().eval());
  const auto particle_of = [&](std::size_t e) {
    Vector3 center = Vector3::Zero();
    for (const std::uint32_t a : meshes[0].elements.corners[e]) center += 0.125 * nodes.position[a];
    for (std::size_t p = 0; p < particles.size(); ++p) {
      if ((particles.position[p] - center).norm() < 1e-9) return p;
    }
    throw InternalError("no particle at the centre of an element");
  };
  for (std::size_t e = 0; e < meshes[0].elements.size(); ++e) {
    const Vector3 share = 0.125 * particles.mass[0] * particles.velocity[particle_of(e)];
    for (const std::uint32_t a : meshes[0].elements.corners[e]) nodes.velocity[a] += share / nodes.mass[a];
  }
  constexpr double dt = 1e-9;
  mpm.advance(dt);
  ASSERT_EQ(mpm.state().time_step, dt);
  Simulation fe(of_elements, {}, state, parallel::world(), meshes);
  fe.advance(dt);
  ASSERT_EQ(fe.state().time_step, dt);
  const fem::GaussPoints& points = fe.meshes()[0].points;
  const Particles& q = mpm.particles();
  double plastic = 0;
  for (std::size_t e = 0; e < points.size(); ++e) {
    std::size_t p = 0;
    while (q.id[p] != particles.id[particle_of(e)]) ++p;
    // The volume of the element is exact, that of the particle follows det(I + dt L): equal to second order in dt.
    EXPECT_NEAR(points.volume[e], q.volume[p], 1e-5 * q.volume[p]);
    EXPECT_NEAR(points.plastic_strain[e], q.plastic_strain[p], 1e-2 * q.plastic_strain[p] + 1e-7);
    const SymmetricTensor &s = points.deviatoric_stress[e], &t = q.deviatoric_stress[p];
    EXPECT_LT((s.matrix() - t.matrix()).norm(), 1e-3 * t.matrix().norm());
    plastic = std::max(plastic, points.plastic_strain[e]);
  }
  EXPECT_GT(plastic, 1e-4);
}

// A bar of elements against a rigid wall: energy and the wall's impulse are accounted for.
TEST(Elements, WallsStopThem) {
  for (const char* wall : {"symmetry", "separating", "no_slip"}) {
    const cases::Case setup = read(fmt::format(R"(
[domain]
lower = ["-6 mm", "-6 mm", "0 mm"]
upper = ["6 mm", "6 mm", "14 mm"]
cell_size = "1 mm"
boundary = {{ z_lower = "{}" }}
[time]
end = "40 us"
[[body]]
name = "bar"
material = "{}"
velocity = ["0 m/s", "0 m/s", "-150 m/s"]
discretization = {{ method = "finite_elements" }}
shape = {{ cylinder = {{ center = ["0 mm", "0 mm", "5.5 mm"], radius = "2 mm", height = "10 mm" }} }}
)",
                                               wall, aluminium("afemp_wall", "0.3 GPa")));
    Simulation simulation(setup, parallel::world());
    run_to(simulation, 40e-6);
    EXPECT_LT(std::abs(simulation.state().ledger.energy_error(simulation.totals())), 1e-12) << wall;
    EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-12) << wall;
    const fem::Nodes& nodes = simulation.meshes()[0].nodes;
    double lowest = 1;
    for (const Vector3& x : nodes.position) lowest = std::min(lowest, x[2]);
    EXPECT_GE(lowest, -1e-12) << wall;
    EXPECT_GT(simulation.totals().momentum[2], 0.0) << wall;  // it bounces
  }
}

// Nodal boundary conditions: a pulled bar gains the energy of the work of the prescribed nodes.
TEST(Elements, PrescribedVelocitiesDoWork) {
  const cases::Case setup = read(fmt::format(R"(
[domain]
lower = ["-2 mm", "-2 mm", "-2 mm"]
upper = ["4 mm", "4 mm", "14 mm"]
cell_size = "1 mm"
[time]
end = "5 us"
[[body]]
name = "bar"
material = "{}"
discretization = {{ method = "finite_elements", element = "b_bar" }}
shape = {{ box = {{ lower = ["0 mm", "0 mm", "0 mm"], upper = ["2 mm", "2 mm", "10 mm"] }} }}
[[body.node_condition]]
lower = ["-1 mm", "-1 mm", "-0.1 mm"]
upper = ["3 mm", "3 mm", "0.1 mm"]
directions = ["x", "y", "z"]
[[body.node_condition]]
lower = ["-1 mm", "-1 mm", "9.9 mm"]
upper = ["3 mm", "3 mm", "10.1 mm"]
directions = ["z"]
velocity = ["0 m/s", "0 m/s", "50 m/s"]
)",
                                             elastic_aluminium()));
  Simulation simulation(setup, parallel::world());
  const double before = simulation.totals().energy();
  run_to(simulation, 5e-6);
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_GT(ledger.external_work, 0.0);
  EXPECT_NEAR(simulation.totals().energy() - before, ledger.external_work, 1e-12 * ledger.external_work);
  double top = 0, bottom = 1;
  for (const Vector3& x : simulation.meshes()[0].nodes.position) {
    top = std::max(top, x[2]);
    bottom = std::min(bottom, x[2]);
  }
  EXPECT_NEAR(top, 10.25e-3, 1e-9);
  EXPECT_EQ(bottom, 0.0);
}

TEST(Elements, LeaveTheDomainWithTheirMassMomentumAndEnergy) {
  Simulation simulation(read(with(impact("finite_elements", "one_point"), "-2 km/s", "+6 km/s")),
                        parallel::world());
  const double mass = simulation.totals().mass;
  run_to(simulation, 1.9e-6);
  const solver::Ledger& ledger = simulation.state().ledger;
  EXPECT_EQ(simulation.element_count(), 0U);
  EXPECT_NEAR(simulation.totals().mass + ledger.outflow.mass, mass, 1e-13 * mass);
  EXPECT_LT(std::abs(ledger.energy_error(simulation.totals())), 1e-12);
  EXPECT_LT(ledger.momentum_error(simulation.totals()), 1e-12);
}

}  // namespace
}  // namespace whipple::verification
