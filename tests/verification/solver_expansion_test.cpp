// SPDX-License-Identifier: BSD-3-Clause
// Free expansion of fluid, and late particle splitting: continuous material remains continuous (docs/theory/mpm.md, 2).
// Reference: zones that move with the material.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "src/solver/carriers/domains.hpp"
#include "src/transfer/shape_function.hpp"
#include "tests/folders.hpp"
#include "tests/verification/lagrangian_expansion.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

std::string gas() {
  return write_material(
      "expanding_gas",
      "name = \"gas\"\nsource = \"verification\"\n[eos]\nmodel = \"ideal_gas\"\nsource = \"verification\"\n"
      "heat_capacity_ratio = 1.4\nreference_density = \"1 kg/m^3\"\nheat_capacity = \"718 J/(kg K)\"\n");
}

/// Describes a body that starts to expand into vacuum.
struct Problem {
  Expansion kind;
  std::string material, initial;
  double end;     ///< s
  double length;  ///< m, of the domain
  double size = 5e-3;
};

std::string case_of(const Problem& problem, double cell, const std::string& more) {
  const bool plane = problem.kind == Expansion::plane;
  const std::string thickness = fmt::format("{}", 4 * cell);
  const std::string domain =
      plane ? fmt::format(
                  "dimension = \"plane_strain\"\nlower = [0, 0]\nupper = [{}, {}]\ncell_size = {}\n"
                  "boundary = {{ x_lower = \"symmetry\", y_lower = \"symmetry\", y_upper = \"symmetry\" }}\n",
                  problem.length, thickness, cell)
            : fmt::format(
                  "dimension = \"axisymmetric\"\nlower = [0, 0]\nupper = [{0}, {0}]\ncell_size = {1}\n"
                  "boundary = {{ x_lower = \"symmetry\" }}\n",
                  problem.length, cell);
  const std::string shape =
      plane ? fmt::format("box = {{ lower = [0, 0, -1], upper = [{}, {}, 1] }}", problem.size, thickness)
            : fmt::format("sphere = {{ center = [0, 0, 0], radius = {} }}", problem.size);
  return fmt::format(
      "{}[domain]\n{}[time]\nend = {}\n[[body]]\nname = \"body\"\nmaterial = \"{}\"\n{}shape = {{ {} }}\n",
      more, domain, problem.end, problem.material, problem.initial, shape);
}

/// Deviations from the reference; temperature 0 if the model has none.
struct Deviation {
  double internal, kinetic, temperature;  ///< of the exact values
  double partition;                       ///< of both energies, of the energy of the run
};

Deviation deviation(const Problem& problem, double cell, const std::string& more = {}) {
  const cases::Case setup = cases::read_case_text(case_of(problem, cell, more), "expansion.toml");
  solver::Simulation simulation(setup, parallel::world());
  const Particles& q = simulation.particles();
  const double density = q.mass[0] / q.volume[0], energy = q.specific_internal_energy[0];
  const double mass = simulation.totals().mass;
  run_to(simulation, problem.end);
  EXPECT_LT(std::abs(simulation.state().ledger.energy_error(simulation.totals())), 1e-13);
  EXPECT_LT(simulation.state().ledger.momentum_error(simulation.totals()), 1e-12);
  EXPECT_EQ(simulation.state().ledger.limited_densities, 0.0);
  EXPECT_EQ(simulation.state().ledger.refused_divisions, 0.0);
  ExpansionState exact =
      expand_in_zones(*setup.materials[0]->eos, problem.kind, problem.size, density, energy, problem.end);
  const double all = exact.kinetic + exact.internal;
  // The whole sphere is twice its half at the plane of symmetry.
  const double scale = mass * energy / all;
  exact.kinetic *= scale;
  exact.internal *= scale;
  double temperature = 0.0;
  for (std::size_t p = 0; p < q.size(); ++p) temperature += q.mass[p] * q.temperature[p];
  temperature /= simulation.totals().mass;
  const solver::Totals& totals = simulation.totals();
  const double de = totals.internal_energy - exact.internal, dk = totals.kinetic_energy - exact.kinetic;
  const Deviation result = {de / exact.internal, dk / exact.kinetic,
                            exact.temperature > 0.0 ? temperature / exact.temperature - 1.0 : 0.0,
                            (std::abs(de) + std::abs(dk)) / (mass * energy)};
  std::printf(
      "%6.3f mm: %6zu particles, internal %.5g (exact %.5g, %+.2f %%), kinetic %.5g (%.5g, %+.2f %%), "
      "unresolved %.2g, T %.5g (%.5g, %+.2f %%), held %.0f, outflow %.1e\n",
      1e3 * cell, q.size(), totals.internal_energy, exact.internal, 100 * result.internal,
      totals.kinetic_energy, exact.kinetic, 100 * result.kinetic, totals.unresolved_energy, temperature,
      exact.temperature, 100 * result.temperature, simulation.state().ledger.held_pressures,
      simulation.state().ledger.outflow.mass / mass);
  return result;
}

void expect_convergence(const Problem& problem, std::initializer_list<double> cells) {
  std::vector<Deviation> found;
  for (const double cell : cells) {
    found.push_back(deviation(problem, cell));
    EXPECT_LT(std::abs(found.back().internal), 0.05);
    EXPECT_LT(std::abs(found.back().kinetic), 0.06);
    EXPECT_LT(std::abs(found.back().temperature), 0.03);
  }
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LT(found[i].partition, found[i - 1].partition);
}

const Problem slab = {Expansion::plane, gas(), "initial = { density = \"1 kg/m^3\", pressure = \"1 MPa\" }\n",
                      16e-6, 0.15};
const Problem sphere = {Expansion::spherical, gas(),
                        "initial = { density = \"1 kg/m^3\", pressure = \"1 MPa\" }\n", 12e-6, 0.09};
const Problem products = {Expansion::spherical, "composition_b", "detonation = \"instantaneous\"\n", 8e-6,
                          0.08};
const Problem vapour = {Expansion::plane, "copper",
                        "initial = { density = \"8930 kg/m^3\", temperature = \"60000 K\" }\n", 6e-6, 0.3};

TEST(FreeExpansion, SlabOfGas) { expect_convergence(slab, {0.5e-3, 0.25e-3}); }
TEST(FreeExpansion, SphereOfGas) { expect_convergence(sphere, {0.625e-3, 0.5e-3}); }
TEST(FreeExpansion, SphereOfDetonationProducts) { expect_convergence(products, {0.5e-3, 0.4e-3}); }
TEST(FreeExpansion, SlabOfCopperVapour) { expect_convergence(vapour, {0.5e-3, 0.25e-3}); }

TEST(FreeExpansionFine, SlabOfGas) { expect_convergence(slab, {0.5e-3, 0.25e-3, 0.125e-3}); }
TEST(FreeExpansionFine, SphereOfGas) { expect_convergence(sphere, {0.5e-3, 0.25e-3}); }
TEST(FreeExpansionFine, SphereOfDetonationProducts) { expect_convergence(products, {0.5e-3, 0.25e-3}); }
TEST(FreeExpansionFine, SlabOfCopperVapour) { expect_convergence(vapour, {0.5e-3, 0.25e-3, 0.125e-3}); }

// Reason for splitting fluid: its particles separate, and isolated ones drive their affine fields with their heat.
TEST(FreeExpansionFine, LosesItsHeatWithoutSplittingAndMoreOfItWithFinerCells) {
  for (const Problem& problem : {slab, sphere, products, vapour}) {
    const std::string none = "[splitting]\nlength = 0\n";
    const Deviation coarse = deviation(problem, 0.5e-3, none), fine = deviation(problem, 0.25e-3, none);
    EXPECT_LT(coarse.internal, -0.5);
    EXPECT_LT(fine.internal, coarse.internal);
    EXPECT_LT(fine.kinetic, -0.1);
  }
}

/// Returns two particles; the second provides space for a half of the first.
Particles particle_and_room() {
  Particles particles;
  particles.mass.resize(2);
  particles.affine_velocity.resize(2);
  particles.extent.resize(2);
  particles.unresolved_energy.resize(2);
  resize(particles, 2);
  for (std::size_t p = 0; p < 2; ++p) {
    particles.position[p].setZero();
    particles.velocity[p].setZero();
    particles.affine_velocity[p].setZero();
  }
  return particles;
}

// For any length: material that heals, or vapour that was a fragment, is split late.
TEST(Division, OfAParticleOfAnyLengthKeepsEverySumAndLetsNothingGrow) {
  constexpr double dx = 1e-3, inertia = dx * dx / 4.0;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto vector = [&](double scale) {
    return Vector3(scale * Vector3(normal(random), normal(random), normal(random)));
  };
  for (const double length : {0.1, 1.0, 1.9, 2.1, 3.0, 10.0, 100.0}) {
    for (int trial = 0; trial < 20; ++trial) {
      Particles q = particle_and_room();
      const Vector3 half_edge = 0.5 * length * dx * vector(1.0).normalized();
      q.mass = {2e-6, 0.0};
      q.volume = {1e-9, 0.0};
      q.position[0] = vector(1e-2);
      q.velocity[0] = vector(1e3);
      for (int a = 0; a < 3; ++a) q.affine_velocity[0].col(a) = vector(1e6);
      q.extent[0] = SymmetricTensor::from(half_edge * half_edge.transpose());
      const auto moments = [&] {
        Matrix3 sum = Matrix3::Zero();
        for (std::size_t p = 0; p < 2; ++p) {
          sum += q.mass[p] * (q.position[p] * q.position[p].transpose() + q.extent[p].matrix() / 3.0);
        }
        return sum;
      };
      const solver::Totals before = solver::totals_of(q, inertia);
      const Matrix3 moments_before = moments();
      const double loss = solver::domains::divide(q, 0, 1, half_edge, inertia);
      const solver::Totals after = solver::totals_of(q, inertia);
      const double energy = before.energy();
      EXPECT_EQ(after.mass, before.mass);
      EXPECT_LT((after.momentum - before.momentum).norm(), 1e-14 * before.momentum_scale);
      EXPECT_LT(
          (after.angular_momentum - before.angular_momentum).norm(),
          1e-13 * (before.angular_momentum.norm() + before.mass * inertia * q.affine_velocity[0].norm()));
      EXPECT_LT((moments() - moments_before).norm(), 1e-14 * moments_before.norm());
      EXPECT_LT(std::abs(after.energy() - energy), 1e-13 * energy);
      EXPECT_NEAR(after.unresolved_energy, loss, 1e-13 * energy);
      EXPECT_GE(loss, -1e-14 * energy);
      EXPECT_LE(after.affine_kinetic_energy, before.affine_kinetic_energy * (1.0 + 1e-13));
      EXPECT_LE(after.kinetic_energy + after.affine_kinetic_energy,
                (before.kinetic_energy + before.affine_kinetic_energy) * (1.0 + 1e-13));
    }
  }
}

/// The lead sphere of cases/lead_sphere_on_plate_gray as a section, 14 cells across.
cases::Case lead_section(const std::string& more_of_material,
                         std::vector<std::pair<std::string, std::string>> overrides) {
  const std::string folder = whipple::tests::source_folder() + "/cases/lead_sphere_on_plate_gray/";
  std::ifstream file(folder + "lead_linear.toml");
  std::stringstream text;
  text << file.rdbuf() << more_of_material;
  const std::string lead = "\"" + write_material("lead", text.str()) + "\"";
  overrides.insert(
      overrides.end(),
      {{"domain.dimension", "axisymmetric"}, {"body.0.material", lead}, {"body.1.material", lead}});
  return cases::read_case(folder + "case.toml", overrides);
}

// A material that heals is split when it is already long.
TEST(FreeExpansion, LeadThatHealsIsDividedLateAndNothingBlowsUp) {
  const cases::Case setup = lead_section("response = \"opening\"\n", {{"splitting.of", "all"}});
  solver::Simulation simulation(setup, parallel::world());
  EnergyWatch watch;
  double fastest = 0.0;
  run_to(simulation, 26e-6, [&](const solver::Simulation& s) {
    watch(s);
    for (const Vector3& v : s.particles().velocity) fastest = std::max(fastest, v.norm());
  });
  std::printf("fastest %.4g m/s\n", fastest);
  EXPECT_LT(watch.worst, 1e-12);
  EXPECT_LT(fastest, 7e3);  // the sphere flies at 6580 m/s
}

/// @param cell  of the grid, a text with its unit
void expect_vapour_above_the_floor(const std::string& cell) {
  const cases::Case setup = lead_section("", {{"domain.cell_size", cell}});
  solver::Simulation simulation(setup, parallel::world());
  run_to(simulation, setup.time.end);
  EXPECT_EQ(simulation.state().ledger.limited_densities, 0.0);
  EXPECT_GT(simulation.state().ledger.held_pressures, 0.0);
}
TEST(FreeExpansion, VapourOfAnImpactIsHeldBeforeItReachesTheDensityFloor) {
  expect_vapour_above_the_floor("1.0714285714 mm");
}
TEST(FreeExpansionFine, VapourOfAnImpactIsHeldBeforeItReachesTheDensityFloor) {
  expect_vapour_above_the_floor("0.2678571429 mm");
}

TEST(Division, IsRefusedBeyondTheNumberOfParticlesThatTheCaseTakes) {
  const std::string bound = "[splitting]\nmaximum_particles = 200\n";
  solver::Simulation simulation(cases::read_case_text(case_of(slab, 0.5e-3, bound), "bound.toml"),
                                parallel::world());
  run_to(simulation, slab.end);
  EXPECT_GT(simulation.particle_count(), 100U);
  EXPECT_LE(simulation.particle_count(), 200U);
  EXPECT_GT(simulation.state().ledger.refused_divisions, 0.0);
  EXPECT_GT(simulation.state().ledger.held_pressures, 0.0);
  EXPECT_LT(std::abs(simulation.state().ledger.energy_error(simulation.totals())), 1e-13);
}

}  // namespace
}  // namespace whipple::verification
