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

#include "tests/folders.hpp"
#include "tests/verification/compaction_shock.hpp"
#include "tests/verification/solver_problems.hpp"

namespace whipple::verification {
namespace {

const std::string foam_file = whipple::tests::source_folder() + "/cases/foam_block/foam.toml";
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
  // Two particles across the column; their mass is half on either side of their place.
  const auto place = [&](std::size_t k) {
    return 0.5 * (q.position[order[2 * k]].x() + q.position[order[2 * k + 1]].x());
  };
  const double behind =
      0.01 * static_cast<double>(q.size() / 2) - 0.5;  // in rows, from the place of the last one
  const auto row = static_cast<std::size_t>(std::max(0.0, behind));
  result.length = place(row) + (behind - static_cast<double>(row)) * (place(row + 1) - place(row));
  result.energy_error = watch.worst;
  return result;
}

Material foam() { return *thrown_block({.end = 1e-6}, 1e-3).materials[0]; }

ThrownBlockResult formula(const ThrownBlock& block) {
  return locking_block(block, plateau, foam_density, locking);
}

/// Returns the limit of two resolutions of which the second is twice as fine, for errors of first order.
double limit(double coarse, double fine) { return 2.0 * fine - coarse; }

TEST(CompactionShock, ZonesApproachTheLockingFormula) {
  const Material material = foam();
  const ThrownBlock block;
  const double exact = formula(block).length;
  const ThrownBlockResult coarse = throw_in_zones(material, block, 25),
                          fine = throw_in_zones(material, block, 50);
  std::printf("formula %.3f mm; 25 zones %.3f, 50 %.3f\n", 1e3 * exact, 1e3 * coarse.length,
              1e3 * fine.length);
  EXPECT_LT(std::abs(fine.energy_error), 1e-12);
  EXPECT_LT(fine.length - exact, 0.7 * (coarse.length - exact));
  EXPECT_NEAR(limit(coarse.length, fine.length), exact, 0.5e-3);
  EXPECT_NEAR(fine.momentum, formula(block).momentum, 0.02);
}

TEST(CompactionShock, ParticlesStopWhereZonesOfTheSameWidthDo) {
  const ThrownBlock block;
  const ThrownBlockResult zones = throw_in_zones(foam(), block, 50), particles = throw_particles(block, 2e-3);
  std::printf("zones %.3f mm, particles %.3f mm\n", 1e3 * zones.length, 1e3 * particles.length);
  EXPECT_LT(particles.energy_error, 1e-12);
  EXPECT_NEAR(particles.length, zones.length, 1e-3);
  EXPECT_NEAR(particles.momentum, zones.momentum, 0.02);
}

// The table of docs/theory/foam.md, section 3.
TEST(CompactionShockFine, ThreeSpeedsThreeCellsThreeViscosities) {
  const Material material = foam();
  std::printf("| speed, formula | c1 | 4 mm: zones, cells | 2 mm | 1 mm | limit of zones, cells |\n");
  for (const double speed : {50.0, 100.0, 200.0}) {
    double nearest = 1.0;
    for (const double viscosity : {0.25, 0.06, 0.02}) {
      const ThrownBlock block{.speed = speed, .linear_viscosity = viscosity};
      const ThrownBlockResult exact = formula(block);
      std::string row = fmt::format("| {} m/s, {:.2f} mm, {:.4f} | {} |", speed, 1e3 * exact.length,
                                    exact.momentum, viscosity);
      std::vector<ThrownBlockResult> zones, cells;
      for (const std::size_t count : {25, 50, 100}) {
        zones.push_back(throw_in_zones(material, block, count));
        cells.push_back(throw_particles(block, block.length / static_cast<double>(count)));
        row += fmt::format(" {:.2f} {:.4f}, {:.2f} {:.4f} |", 1e3 * zones.back().length,
                           zones.back().momentum, 1e3 * cells.back().length, cells.back().momentum);
        EXPECT_LT(cells.back().energy_error, 1e-12);
        EXPECT_LT(std::abs(zones.back().energy_error), 1e-12);
      }
      const double of_zones = limit(zones[1].length, zones[2].length),
                   of_cells = limit(cells[1].length, cells[2].length);
      std::printf("%s %.2f, %.2f |\n", row.c_str(), 1e3 * of_zones, 1e3 * of_cells);
      std::fflush(stdout);
      // Less viscosity is nearer to the formula; the length of the viscosity shrinks with zones, but not with cells.
      EXPECT_LT(std::abs(of_zones - exact.length), nearest + 1e-4);
      nearest = std::abs(of_zones - exact.length);
      EXPECT_LT(std::abs(cells[2].length - zones[2].length), 0.02 * block.length);
      EXPECT_LT(cells[2].length, cells[1].length);
      EXPECT_LT(cells[1].length, cells[0].length);
    }
    EXPECT_LT(nearest, 1e-3);
  }
}

}  // namespace
}  // namespace whipple::verification
