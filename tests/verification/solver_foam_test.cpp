// SPDX-License-Identifier: BSD-3-Clause
// Compaction shock in foam against zones that move with the material, which obey the same law, and against the formula
// of foam that is rigid before the front and locked behind it (docs/theory/foam.md, section 3).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "tests/verification/compaction_shock.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

const std::string foam_file = WHIPPLE_SOURCE_DIR "/cases/foam_block/foam.toml";
constexpr double plateau = 14.83e6, foam_density = 510.0, locking = 1.0 - 510.0 / 2700.0;

cases::Case thrown_block(const ThrownBlock& block, double cell) {
  return cases::read_case_text(
      fmt::format(
          "[domain]\ndimension = \"plane_strain\"\nlower = [0, 0]\nupper = [0.12, {0}]\ncell_size = {0}\n"
          "boundary = {{ x_lower = \"symmetry\", y_lower = \"symmetry\", y_upper = \"symmetry\" }}\n"
          "[time]\nend = {1}\n[artificial_viscosity]\nlinear = {2}\n"
          "[[body]]\nname = \"block\"\nmaterial = \"{3}\"\nvelocity = [{4}, 0, 0]\n"
          "shape = {{ box = {{ lower = [0, 0, -1], upper = [{5}, {0}, 1] }} }}\n",
          cell, block.end, block.linear_viscosity, foam_file, -block.speed, block.length),
      "thrown_block.toml");
}

ThrownBlockResult throw_particles(const ThrownBlock& block, double cell) {
  solver::Simulation simulation(thrown_block(block, cell), parallel::world());
  const double start = -simulation.totals().momentum.x();
  ThrownBlockResult result;
  EnergyWatch watch;
  run_to(simulation, block.half, watch);
  result.momentum = -simulation.totals().momentum.x() / start;
  run_to(simulation, block.end, watch);
  const Particles& q = simulation.particles();
  std::vector<std::size_t> order(q.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, std::greater<>(), [&](std::size_t p) { return q.position[p].x(); });
  double beyond = 0.0;
  for (const std::size_t p : order) {
    beyond += q.mass[p];
    result.length = q.position[p].x();
    if (beyond > 0.01 * simulation.totals().mass) break;
  }
  result.energy_error = watch.worst;
  return result;
}

Material foam() { return *thrown_block({.end = 1e-6}, 1e-3).materials[0]; }

TEST(CompactionShock, ZonesConvergeToTheLockingFormula) {
  const Material material = foam();
  for (const double speed : {50.0, 100.0, 200.0}) {
    const ThrownBlock block{.speed = speed};
    const ThrownBlockResult rigid = locking_block(block, plateau, foam_density, locking);
    const ThrownBlockResult coarse = throw_in_zones(material, block, 50),
                            fine = throw_in_zones(material, block, 100);
    std::printf("%.0f m/s: formula %.3f mm %.4f; 50 zones %.3f %.4f, 100 %.3f %.4f, energy %.1e\n", speed,
                1e3 * rigid.length, rigid.momentum, 1e3 * coarse.length, coarse.momentum, 1e3 * fine.length,
                fine.momentum, fine.energy_error);
  }
}

TEST(CompactionShockFine, Table) {
  const Material material = foam();
  for (const double speed : {50.0, 100.0, 200.0}) {
    for (const double viscosity : {0.25, 0.06, 0.02}) {
      const ThrownBlock block{.speed = speed, .linear_viscosity = viscosity};
      const ThrownBlockResult rigid = locking_block(block, plateau, foam_density, locking);
      std::printf("%.0f m/s, c1 %.2f: formula %.3f mm %.4f\n", speed, viscosity, 1e3 * rigid.length,
                  rigid.momentum);
      for (const int zones : {50, 100, 200, 400}) {
        const ThrownBlockResult a = throw_in_zones(material, block, zones);
        std::printf("  zones %d: %.3f %.4f (%.1e)\n", zones, 1e3 * a.length, a.momentum, a.energy_error);
        if (zones > 200) continue;
        const ThrownBlockResult b = throw_particles(block, block.length / zones);
        std::printf("  cells %d: %.3f %.4f (%.1e)\n", zones, 1e3 * b.length, b.momentum, b.energy_error);
      }
    }
  }
}

}  // namespace
}  // namespace whipple::verification
