// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals in plane strain and axisymmetry: their forces do the work of the stress, uniform pressure leaves rings
// at rest, a ring breathes with its frequency, a Taylor bar equals three dimensions; energy and momentum are exact in
// contact and through conversion to four particles.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "src/fem/facets.hpp"
#include "tests/unit/fem_support.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

using fem::Quadrature;

/// Returns the section of a box of n x n quadrilaterals of size 1 mm, from a radius on, with moved nodes.
fem::Mesh section(Quadrature quadrature, std::size_t n, double radius, double share) {
  const auto edge = static_cast<double>(n) * 1e-3;
  fem::Hexahedra box = fem::make_box({0.0, radius, 0.0}, {edge, radius + edge, 1e-3}, {n, n, 1});
  fem::Hexahedra flat = fem::section_of(box, 1e-9);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-share, share);
  for (Vector3& x : flat.nodes) x += 1e-3 * Vector3(uniform(generator), uniform(generator), 0.0);
  fem::Mesh mesh = fem::make_mesh(flat, quadrature);
  fem::set_density(mesh, 2700.0);
  const Material material = fem_test::Solid{}.material();
  initialise(material, mesh.points, 0, mesh.points.size());
  return mesh;
}

class Flat : public testing::TestWithParam<Quadrature> {};

TEST_P(Flat, ForcesDoTheWorkOfTheStressAndVolumesAreExact) {
  fem::Mesh mesh = section(GetParam(), 9, 2e-3, 0.25);
  EXPECT_EQ(mesh.elements.size(), 81U);
  EXPECT_EQ(mesh.nodes.size(), 100U);
  EXPECT_EQ(fem::surface_facets(mesh).size(), 36U);
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    mesh.points.pressure[e] = 1e9 * uniform(generator);
    SymmetricTensor& s = mesh.points.deviatoric_stress[e];
    s.xx = 1e8 * uniform(generator);
    s.yy = 1e8 * uniform(generator);
    s.zz = -s.xx - s.yy;
    s.xy = 1e8 * uniform(generator);
    mesh.elements.hourglass_3x[e] = 1e3 * uniform(generator);
    mesh.elements.hourglass_3y[e] = 1e3 * uniform(generator);
    mesh.elements.hourglass_energy[e] = 1.0;
  }
  fem::internal_forces(mesh);
  fem::Motion motion;
  double power = 0.0, scale = 0.0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const Vector3 v(100.0 * uniform(generator), 100.0 * uniform(generator), 0.0);
    motion.mean.push_back(v);
    motion.end.push_back(v);
    power += mesh.nodes.force[a].dot(v);
    scale += mesh.nodes.force[a].norm() * v.norm();
    EXPECT_EQ(mesh.nodes.force[a][2], 0.0);
  }
  const std::vector<double> before = mesh.points.volume;
  const double dt = 1e-7;
  fem::VelocityGradients gradients;
  gradients.resize(mesh.points.size());
  const fem::DeformationReport report = fem::deform(mesh, motion, dt, fem_test::stiffness, gradients);
  EXPECT_NEAR(report.work + report.hourglass_work, -dt * power, 1e-14 * dt * scale);
  fem::move_nodes(mesh, motion, dt);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const double ratio = (Matrix3::Identity() + dt * gradients.at(e)).determinant();
    EXPECT_NEAR(fem::volume(mesh, e), before[e] * ratio, 1e-13 * before[e]);
  }
}

TEST_P(Flat, AStepBelowTheBoundIsStable) {
  // A fluid has the highest frequency of the bound; just below its step the energy of small motions stays bounded.
  fem::Mesh mesh = section(GetParam(), 6, 0.0, 0.15);
  const std::vector<std::uint32_t> axis = fem::nodes_on_plane(mesh, 1, 0.0, 0.2e-3);
  for (const std::uint32_t a : axis) mesh.nodes.position[a][1] = 0.0;
  fem::constrain(mesh, axis, fem::constraint::y);
  const Material material = fem_test::Solid{}.material();
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    mesh.points.volume[e] = fem::volume(mesh, e);
    mesh.points.mass[e] = material.reference.density * mesh.points.volume[e];
  }
  fem::lump_masses(mesh);
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const bool held = mesh.nodes.constrained[a] != 0;
    mesh.nodes.velocity[a] = Vector3(uniform(generator), held ? 0.0 : uniform(generator), 0.0);
  }
  const double start = fem::totals(mesh).kinetic_energy;
  fem::Motion motion;
  fem::VelocityGradients gradients;
  gradients.resize(mesh.points.size());
  double most = 0.0;
  for (int step = 0; step < 2000; ++step) {
    const double dt = 0.99 * fem::critical_time_step(mesh, {0.0, 0.0});
    fem::internal_forces(mesh);
    fem::advance_velocities(mesh, dt, motion);
    UpdateSettings settings;
    settings.time_step = dt;
    settings.lengths = mesh.points.length;
    fem::deform(mesh, motion, dt, fem_test::stiffness, gradients, [&](std::size_t begin, std::size_t end) {
      update_material(material, mesh.points, begin, end, gradients.from(begin), settings);
    });
    fem::move_nodes(mesh, motion, dt);
    most = std::max(most, fem::totals(mesh).kinetic_energy);
  }
  EXPECT_LT(most, 1.5 * start);
}

INSTANTIATE_TEST_SUITE_P(Sections, Flat, testing::Values(Quadrature::plane, Quadrature::ring),
                         [](const auto& test) {
                           return test.param == Quadrature::plane ? std::string("Plane")
                                                                  : std::string("Ring");
                         });

TEST(RingElements, UniformPressureLeavesThemAtRest) {
  fem::Mesh mesh = section(Quadrature::ring, 6, 0.0, 0.0);
  for (double& p : mesh.points.pressure) p = 1e9;
  fem::internal_forces(mesh);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const Vector3& x = mesh.nodes.position[a];
    const bool inside = x[0] > 1e-4 && x[0] < 5.9e-3 && x[1] > 1e-4 && x[1] < 5.9e-3;
    if (!inside) continue;
    EXPECT_LT(mesh.nodes.force[a].norm(), 1e-12 * 1e9 * 2.0 * std::numbers::pi * x[1] * 1e-3);
  }
}

TEST(RingElements, AThinRingBreathesWithItsFrequency) {
  // omega = sqrt(E/rho)/R of a thin ring; 30 mm radius, two by two elements of 1 mm.
  const fem_test::Solid solid;
  const double radius = 30e-3, omega = std::sqrt(solid.young() / solid.density) / radius;
  fem::Mesh mesh = section(Quadrature::ring, 2, radius - 1e-3, 0.0);
  const Material material = solid.material();
  for (Vector3& v : mesh.nodes.velocity) v = Vector3(0.0, 1.0, 0.0);
  fem::Motion motion;
  fem::VelocityGradients gradients;
  gradients.resize(mesh.points.size());
  double time = 0.0, before = 0.0, turned = 0.0;
  while (turned == 0.0 && time < 1.0) {
    const double dt = 0.5 * fem::critical_time_step(mesh, {0.0, 0.0});
    fem::internal_forces(mesh);
    fem::advance_velocities(mesh, dt, motion);
    UpdateSettings settings;
    settings.time_step = dt;
    settings.lengths = mesh.points.length;
    fem::deform(mesh, motion, dt, fem_test::stiffness, gradients, [&](std::size_t begin, std::size_t end) {
      update_material(material, mesh.points, begin, end, gradients.from(begin), settings);
    });
    fem::move_nodes(mesh, motion, dt);
    const double speed = fem::totals(mesh).momentum[1] / fem::totals(mesh).mass;
    if (speed < 0.0) turned = time + dt * before / (before - speed);
    before = speed;
    time += dt;
  }
  EXPECT_NEAR(turned, 0.5 * std::numbers::pi / omega, 0.01 * turned);
}

// --- In the solver -----------------------------------------------------------------------------------------

std::string bar(const std::string& dimension, const std::string& method, const std::string& more = {}) {
  return fmt::format(R"(
[time]
end = "80 us"
[domain]
{}
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["28.88 mm", "13.68 mm", "13.68 mm"]
cell_size = "0.76 mm"
boundary = {{ x_lower = "symmetry", y_lower = "symmetry", z_lower = "symmetry" }}
[[body]]
name = "bar"
material = "copper_taylor.toml"
velocity = ["-190 m/s", "0 m/s", "0 m/s"]
discretization = {{ method = "{}" }}
shape = {{ cylinder = {{ center = ["12.73 mm", "0 mm", "0 mm"], axis = "x", radius = "3.8 mm", height = "25.46 mm" }} }}
{})",
                     dimension.empty() ? "" : "dimension = \"" + dimension + "\"", method, more);
}

struct Ends {
  double length, foot;  // mm
};
Ends run_bar(const std::string& text) {
  const cases::Case setup = cases::read_case_text(text, "section.toml");
  solver::Simulation simulation(setup, parallel::world());
  EnergyWatch watch;
  run_to(simulation, setup.time.end, std::ref(watch));
  EXPECT_LT(watch.worst, 1e-12);
  Ends ends{0.0, 0.0};
  for (const Vector3& x : simulation.meshes().front().nodes.position) {
    ends.length = std::max(ends.length, 1e3 * x[0]);
    ends.foot = std::max(ends.foot, 2e3 * std::hypot(x[1], x[2]));
  }
  std::printf("Taylor bar of elements: length %.3f mm, foot %.3f mm\n", ends.length, ends.foot);
  return ends;
}

TEST(RingElements, TaylorBarEqualsThreeDimensions) {
  const Ends rings = run_bar(bar("axisymmetric", "finite_elements")),
             space = run_bar(bar("", "finite_elements"));
  EXPECT_NEAR(rings.length, space.length, 0.005 * space.length);
  EXPECT_NEAR(rings.foot, space.foot, 0.02 * space.foot);
}

TEST(RingElements, ASphereHasItsMass) {
  const double pi = std::numbers::pi;
  const std::vector<std::pair<std::string, double>> shapes = {
      {"sphere = { center = [\"0 mm\", \"0 mm\"], radius = \"3 mm\" }", 36e-9 * pi},
      {"moved = { axis = [0, 1, 0], angle = \"90 degree\", shape = { cylinder = { center = [\"0 mm\", \"0 "
       "mm\", "
       "\"0 mm\"], axis = \"z\", radius = \"3 mm\", height = \"4 mm\" } } }",
       36e-9 * pi},
      {"box = { lower = [\"-2 mm\", \"0 mm\"], upper = [\"2 mm\", \"3 mm\"] }", 36e-9 * pi}};
  for (const auto& [shape, volume] : shapes) {
    const std::string text = R"(
[time]
end = "1 us"
[domain]
dimension = "axisymmetric"
lower = ["-4 mm", "0 mm"]
upper = ["4 mm", "4 mm"]
cell_size = "0.75 mm"
[[body]]
name = "body"
material = "copper_taylor.toml"
discretization = { method = "finite_elements" }
shape = { )" + shape + " }\n";
    const cases::Case setup = cases::read_case_text(text, "section.toml");
    const solver::Simulation simulation(setup, parallel::world());
    const double mass = setup.materials[0]->reference.density * volume;
    EXPECT_NEAR(simulation.totals().mass, mass, 1e-9 * mass);
  }
}

class Converting : public testing::TestWithParam<const char*> {};

TEST_P(Converting, EnergyAndMomentumAreExactThroughContactAndConversion) {
  const cases::Case setup =
      cases::read_case_text(fmt::format(R"(
[time]
end = "4 us"
[domain]
dimension = "{}"
lower = ["-8 mm", "0 mm"]
upper = ["12 mm", "9 mm"]
cell_size = "0.5 mm"
boundary = {{ y_lower = "symmetry" }}
[[body]]
name = "rod"
material = "copper_taylor.toml"
velocity = ["1 km/s", "0 m/s"]
discretization = {{ method = "adaptive" }}
conversion = {{ plastic_strain = 0.4 }}
shape = {{ box = {{ lower = ["-6.1 mm", "0 mm"], upper = ["-0.1 mm", "2 mm"] }} }}
[[body]]
name = "plate"
material = "{}"
discretization = {{ method = "adaptive" }}
conversion = {{ plastic_strain = 0.4 }}
shape = {{ box = {{ lower = ["0 mm", "0 mm"], upper = ["2 mm", "8 mm"] }} }}
)",
                                        GetParam(), aluminium("section_plate", "0.3 GPa")),
                            "section.toml");
  solver::Simulation simulation(setup, parallel::world());
  const double mass = simulation.totals().mass, momentum = simulation.totals().momentum[0];
  std::size_t before = 0;
  for (const fem::Mesh& mesh : simulation.meshes()) before += mesh.elements.size();
  EnergyWatch watch;
  run_to(simulation, setup.time.end, std::ref(watch));
  EXPECT_LT(watch.worst, 1e-12);
  EXPECT_NEAR(simulation.totals().momentum[0], momentum, 1e-12 * momentum);
  EXPECT_NEAR(simulation.totals().mass, mass, 1e-13 * mass);
  std::size_t left = 0;
  for (const fem::Mesh& mesh : simulation.meshes()) left += mesh.elements.size();
  EXPECT_GT(before - left, 20U);
  EXPECT_EQ(simulation.particles().size(), 4 * (before - left));
  const std::vector<std::uint64_t>& ids = simulation.particles().id;
  EXPECT_EQ(std::set<std::uint64_t>(ids.begin(), ids.end()).size(), ids.size());
  // The plate has taken momentum: contact of elements and particles in the section.
  double of_plate = 0.0;
  for (const fem::Mesh& mesh : simulation.meshes()) {
    if (mesh.body == 1) of_plate += fem::totals(mesh).momentum[0];
  }
  for (std::size_t p = 0; p < ids.size(); ++p) {
    const Particles& q = simulation.particles();
    if (q.body[p] == 1) of_plate += q.mass[p] * q.velocity[p][0];
  }
  EXPECT_GT(of_plate, 0.1 * momentum);
}

INSTANTIATE_TEST_SUITE_P(Sections, Converting, testing::Values("plane_strain", "axisymmetric"),
                         [](const auto& test) { return std::string(test.param); });

// --- Bars --------------------------------------------------------------------------------------------------

/// Returns a ring of aluminium under a sudden pressure on its outside, with hoops and bars along the axis.
/// @param hoops  number of each of three hoops
cases::Case reinforced(double hoops) {
  const std::string steel = write_material("section_steel", R"toml(
name = "steel"
source = "test"
[eos]
model = "mie_gruneisen"
source = "test"
reference_density = "7.85 g/cm^3"
hugoniot_intercept = "4.57 km/s"
hugoniot_slope = 1.49
gruneisen = 1.9
heat_capacity = "450 J/(kg K)"
reference_temperature = "300 K"
[strength]
model = "von_mises"
source = "test"
shear_modulus = "80 GPa"
yield_stress = "0.6 GPa"
)toml");
  return cases::read_case_text(fmt::format(R"(
[time]
end = "40 us"
[domain]
dimension = "axisymmetric"
lower = ["-3 mm", "0 mm"]
upper = ["3 mm", "32 mm"]
cell_size = "0.5 mm"
boundary = {{ y_upper = "separating" }}
[[body]]
name = "ring"
material = "{}"
shape = {{ box = {{ lower = ["-2 mm", "28 mm"], upper = ["2 mm", "32 mm"] }} }}
[[body]]
name = "bars"
material = "{}"
discretization = {{ method = "bars", bar_diameter = "0.5 mm" }}
[[body.bar]]
from = ["-1 mm", "30 mm"]
to = ["-1 mm", "30 mm"]
count = 3
step = ["1 mm", "0 mm"]
number = {}
[[body.bar]]
from = ["-1.5 mm", "29 mm"]
to = ["1.5 mm", "29 mm"]
number = 20
[[load]]
face = "y_upper"
pressure = "10 MPa"
)",
                                           aluminium("section_ring", "300 MPa"), steel, hoops),
                               "reinforced.toml");
}

TEST(SectionBars, HoopsCarryTheirShareAndKeepEnergyAndAxialMomentum) {
  // The pressure p on the width w makes the hoop force p R_o w; twice the strain of rest, p R_o w/sum(E A), is reached.
  const double young_of_ring = 72.3e9, young_of_steel = 206e9, hoop = 0.25e-6 * 0.25 * std::numbers::pi;
  for (const double hoops : {1e-3, 40.0}) {
    solver::Simulation simulation(reinforced(hoops), parallel::world());
    EnergyWatch watch;
    const auto mean_radius = [&] {
      double mass = 0.0, moment = 0.0;
      for (std::size_t p = 0; p < simulation.particles().size(); ++p) {
        mass += simulation.particles().mass[p];
        moment += simulation.particles().mass[p] * simulation.particles().position[p][1];
      }
      return moment / mass;
    };
    const double start = mean_radius();
    double least = start;
    run_to(simulation, 40e-6, [&](const solver::Simulation& s) {
      watch(s);
      least = std::min(least, mean_radius());
    });
    EXPECT_LT(watch.worst, 1e-12);
    const solver::Totals totals = simulation.totals();
    EXPECT_LT(std::abs(totals.momentum[0]), 1e-12 * totals.momentum_scale);
    const double stiffness = young_of_ring * 16e-6 + 3.0 * hoops * young_of_steel * hoop;
    const double expected = 2.0 * 10e6 * 32e-3 * 4e-3 / stiffness;
    const double found = std::log(start / least);
    std::printf("%g hoops: strain %.3e, expected %.3e\n", hoops, found, expected);
    EXPECT_NEAR(found, expected, 0.15 * expected);
  }
}

TEST(RingElements, BBarIsRefusedByName) {
  std::string text = bar("axisymmetric", "finite_elements");
  text.replace(text.find("\"finite_elements\""), 17, "\"finite_elements\", element = \"b_bar\"");
  try {
    cases::read_case_text(text, "section.toml");
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("one_point"));
  }
}

}  // namespace
}  // namespace whipple::verification
