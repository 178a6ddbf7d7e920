// SPDX-License-Identifier: BSD-3-Clause
// Heat conduction on the grid: exact decay in a rod with measured order, energy to round-off, insulation,
// a step that ends at one temperature everywhere, stability at the bound of the time step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/transfer/conduction.hpp"
#include "src/transfer/fill.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple {
namespace {

using transfer::ShapeFunction;
using transfer::ThermalConstants;

constexpr double density = 1000.0, length = 0.01;

/// A rod of one cell across along x, `per_cell` particles per cell along it, between adiabatic planes.
struct Rod {
  double dx;
  grid::BlockGrid grid;
  Particles particles;

  static grid::Geometry geometry(int cells) {
    grid::Geometry g;
    g.lower = Vector3::Zero();
    g.cell_size = length / cells;
    g.cells = {cells, 1, 1};
    g.boundary.fill(grid::Boundary::symmetry);
    return g;
  }
  Rod(int cells, int per_cell, double shift = 0.0, ShapeFunction of_run = ShapeFunction::quadratic_bspline)
      : dx(length / cells), grid(geometry(cells), parallel::world()) {
    const grid::Stencil stencil = transfer::stencil(of_run);
    const int n = cells * per_cell;
    resize(particles, static_cast<std::size_t>(n) * 4);
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(-shift, shift);
    for (std::size_t p = 0; p < particles.size(); ++p) {
      const int along = static_cast<int>(p) / 4, y = static_cast<int>(p) % 2, z = static_cast<int>(p) / 2 % 2;
      particles.id[p] = p;
      particles.body[p] = 0;
      particles.position[p] = {(along + 0.5 + uniform(generator)) * length / n, (0.25 + 0.5 * y) * dx,
                               (0.25 + 0.5 * z) * dx};
      particles.velocity[p] = Vector3::Zero();
      particles.volume[p] = length / n * dx * dx / 4;
      particles.mass[p] = density * particles.volume[p];
      particles.void_volume[p] = 0.0;
    }
    if (!grid.bin(particles.position, stencil)) {
      grid.adapt(particles.position, particles.velocity, 0.0, stencil);
      grid.activate(particles.position, particles.velocity, 0.0, stencil);
      EXPECT_TRUE(grid.bin(particles.position, stencil));
    }
  }
  void advance(double dt, int steps, std::span<const ThermalConstants> constants) {
    for (int n = 0; n < steps; ++n) {
      transfer::conduct_heat(particles, grid, dt, constants);
      for (std::size_t p = 0; p < particles.size(); ++p) {
        particles.temperature[p] =
            particles.specific_internal_energy[p] / constants[particles.body[p]].heat_capacity;
      }
    }
  }
  template <class Temperature>
  void set(std::span<const ThermalConstants> constants, Temperature&& temperature) {
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.temperature[p] = temperature(particles.position[p][0]);
      particles.specific_internal_energy[p] =
          constants[particles.body[p]].heat_capacity * particles.temperature[p];
    }
  }
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      sum += particles.mass[p] * particles.specific_internal_energy[p];
    }
    return sum;
  }
};

constexpr ThermalConstants copper_like{.conductivity = 400.0, .heat_capacity = 400.0};
double diffusivity(const ThermalConstants& c) { return c.conductivity / (density * c.heat_capacity); }

/// Root mean square error of the rod at the time where the amplitude is 1/e, over that amplitude.
double error_of_decay(int cells, double shift, ShapeFunction of_run = ShapeFunction::quadratic_bspline) {
  Rod rod(cells, 2, shift, of_run);
  const std::array constants = {copper_like};
  const double k = std::numbers::pi / length, a = diffusivity(copper_like);
  rod.set(constants, [&](double x) { return 300.0 + 100.0 * std::cos(k * x); });
  const double before = rod.energy(), end = 1.0 / (a * k * k);
  const int steps = static_cast<int>(std::ceil(end / (rod.dx * rod.dx / (18.0 * a))));
  rod.advance(end / steps, steps, constants);
  EXPECT_NEAR(rod.energy(), before, 1e-13 * before);
  double sum = 0.0;
  for (std::size_t p = 0; p < rod.particles.size(); ++p) {
    const double exact = 300.0 + 100.0 * std::exp(-1.0) * std::cos(k * rod.particles.position[p][0]);
    sum += std::pow(rod.particles.temperature[p] - exact, 2);
  }
  return std::sqrt(sum / static_cast<double>(rod.particles.size())) / (100.0 * std::exp(-1.0));
}

TEST(Conduction, RodDecaysAtTheExactRateWithSecondOrder) {
  const double coarse = error_of_decay(8, 0.0), middle = error_of_decay(16, 0.0),
               fine = error_of_decay(32, 0.0);
  RecordProperty("errors",
                 std::to_string(coarse) + " " + std::to_string(middle) + " " + std::to_string(fine));
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / middle), 1.8);
  EXPECT_GT(std::log2(middle / fine), 1.8);
}

// Heat goes by quadratic functions, whatever carries the momentum: places of wider stencils are not theirs.
TEST(Conduction, IsTheSameWithEveryShapeFunctionOfTheRun) {
  for (const double shift : {0.0, 0.3}) {
    const double expected = error_of_decay(16, shift);
    for (const ShapeFunction of_run :
         {ShapeFunction::gimp, ShapeFunction::convected_gimp, ShapeFunction::cubic_bspline}) {
      EXPECT_NEAR(error_of_decay(16, shift, of_run), expected, 1e-9)
          << static_cast<int>(of_run) << ' ' << shift;
    }
  }
}

// Full cells are full for every shape function, also at the planes where a run of linear functions has no
// node beyond.
TEST(Fill, IsThatOfTheCellsWithEveryShapeFunctionOfTheRun) {
  for (const ShapeFunction of_run :
       {ShapeFunction::linear, ShapeFunction::gimp, ShapeFunction::convected_gimp,
        ShapeFunction::quadratic_bspline, ShapeFunction::cubic_bspline}) {
    Rod rod(8, 2, 0.0, of_run);
    for (const double filled : transfer::fill_of_cells(rod.particles, {}, rod.grid)) {
      ASSERT_NEAR(filled, 1.0, 1e-12) << static_cast<int>(of_run);
    }
  }
}

// The volume of elements is not on the grid: near them nothing is said.
TEST(Fill, IsUnknownNearNodesOfElements) {
  constexpr ShapeFunction shape = ShapeFunction::quadratic_bspline;
  Rod rod(16, 2);
  transfer::TransitionNodes nodes;
  nodes.resize(1);
  nodes.position[0] = {4.3 * rod.dx, 0.5 * rod.dx, 0.5 * rod.dx};
  ASSERT_TRUE(rod.grid.bin(rod.particles.position, transfer::stencil(shape), nodes.position));
  const std::vector<double> fill = transfer::fill_of_cells(rod.particles, nodes, rod.grid);
  for (std::size_t p = 0; p < fill.size(); ++p) {
    const double away = std::abs(rod.particles.position[p][0] - nodes.position[0][0]) / rod.dx;
    if (away < 1.5) {
      EXPECT_EQ(fill[p], std::numeric_limits<double>::infinity()) << away;
    } else if (away > 3.0) {
      EXPECT_NEAR(fill[p], 1.0, 1e-12) << away;
    }
  }
}

TEST(Conduction, DisorderedParticlesConductAsWell) {
  const double error = error_of_decay(32, 0.3);
  std::printf("disordered particles: error of the decay %.4f\n", error);
  EXPECT_LT(error, 0.01);  // quadrature: volumes stay those of the even lattice
}

double entropy(const Rod& rod, const ThermalConstants& constants) {
  double sum = 0.0;
  for (std::size_t p = 0; p < rod.particles.size(); ++p) {
    sum += rod.particles.mass[p] * constants.heat_capacity * std::log(rod.particles.temperature[p]);
  }
  return sum;
}

// What differs within a cell is no gradient on the grid, and has to go as well.
TEST(Conduction, StepEndsAtOneTemperatureEverywhere) {
  const std::array constants = {copper_like};
  for (const double shift : {0.0, 0.4}) {
    Rod rod(8, 2, shift);
    rod.set(constants, [](double x) { return x < 0.25 * length ? 600.0 : 300.0; });
    const double before = rod.energy(), dt = rod.dx * rod.dx / (18.0 * diffusivity(copper_like));
    double mean = 0.0, mass = 0.0;
    for (std::size_t p = 0; p < rod.particles.size(); ++p) {
      mass += rod.particles.mass[p];
      mean += rod.particles.mass[p] * rod.particles.temperature[p];
    }
    mean /= mass;
    double last = entropy(rod, copper_like), lowest = 300.0, highest = 600.0;
    for (int block = 0; block < 60; ++block) {  // of 20 steps each, one time length^2/a in all
      rod.advance(dt, 20, constants);
      const double now = entropy(rod, copper_like);
      EXPECT_GE(now, last * (1.0 - 1e-14));
      last = now;
      const auto [low, high] = std::ranges::minmax(rod.particles.temperature);
      lowest = std::min(lowest, low);
      highest = std::max(highest, high);
    }
    EXPECT_NEAR(rod.energy(), before, 1e-12 * before);
    EXPECT_GT(lowest, 299.0) << shift;
    EXPECT_LT(highest, 601.0) << shift;
    for (const double t : rod.particles.temperature) ASSERT_NEAR(t, mean, 1e-4 * mean) << shift;
  }
}

// Without a gradient on the grid, the mixing alone: neighbours that differ meet within the time of diffusion
// over a cell.
TEST(Conduction, DifferencesWithinACellDecayAtTheRateOfDiffusionOverIt) {
  const std::array constants = {copper_like};
  Rod rod(16, 2);
  for (std::size_t p = 0; p < rod.particles.size(); ++p) {
    rod.particles.temperature[p] = 300.0 + (p / 4 % 2 == 0 ? 1.0 : -1.0);
    rod.particles.specific_internal_energy[p] = copper_like.heat_capacity * rod.particles.temperature[p];
  }
  const double time = rod.dx * rod.dx / diffusivity(copper_like);
  rod.advance(time / 100.0, 100, constants);
  for (std::size_t p = 4 * 8; p < rod.particles.size() - 4 * 8; ++p) {  // away from the ends
    EXPECT_NEAR(-std::log(std::abs(rod.particles.temperature[p] - 300.0)), 4.0, 0.3);
  }
}

/// Largest errors of two half-spaces over the jump of their temperature: of all particles, of those away from
/// the interface. Exact is the mean of both temperatures by effusivity at the interface.
struct InterfaceErrors {
  double all = 0.0, away = 0.0;
};
InterfaceErrors errors_at_interface(int cells) {
  const std::array constants = {ThermalConstants{400.0, 400.0}, ThermalConstants{50.0, 900.0}};
  Rod rod(cells, 2);
  for (std::size_t p = 0; p < rod.particles.size(); ++p) {
    rod.particles.body[p] = rod.particles.position[p][0] < 0.5 * length ? 0 : 1;
  }
  rod.set(constants, [](double x) { return x < 0.5 * length ? 500.0 : 300.0; });
  const double a1 = diffusivity(constants[0]), a2 = diffusivity(constants[1]);
  const double before = rod.energy(), dt = rod.dx * rod.dx / (18.0 * a1);
  const double end = 0.012 * length * length / a1;  // the ends know nothing of it yet
  const int steps = static_cast<int>(end / dt);
  rod.advance(dt, steps, constants);
  EXPECT_NEAR(rod.energy(), before, 1e-13 * before);
  const double b1 = std::sqrt(400.0 * 400.0), b2 = std::sqrt(50.0 * 900.0);  // at one density
  const double interface = (b1 * 500.0 + b2 * 300.0) / (b1 + b2), t = dt * steps;
  InterfaceErrors errors;
  for (std::size_t p = 0; p < rod.particles.size(); ++p) {
    const double x = rod.particles.position[p][0] - 0.5 * length;
    const double a = x < 0.0 ? a1 : a2, far = x < 0.0 ? 500.0 : 300.0;
    const double exact = interface + (far - interface) * std::erf(std::abs(x) / std::sqrt(4.0 * a * t));
    const double error = std::abs(rod.particles.temperature[p] - exact) / 200.0;
    errors.all = std::max(errors.all, error);
    if (std::abs(x) > length / 16.0) errors.away = std::max(errors.away, error);
  }
  std::printf("interface of two materials, %d cells: largest error %.3f of the jump, away from it %.3f\n",
              cells, errors.all, errors.away);
  return errors;
}

// The kernels of both sides meet within a cell: first order, up to the particles next to the interface.
TEST(Conduction, InterfaceOfTwoMaterialsTakesTheTemperatureOfTheirEffusivities) {
  const InterfaceErrors coarse = errors_at_interface(32), fine = errors_at_interface(64);
  EXPECT_LT(fine.all, 0.07);
  EXPECT_LT(fine.all, 0.8 * coarse.all);
  EXPECT_LT(fine.away, 0.035);
  EXPECT_LT(fine.away, 0.6 * coarse.away);
}

TEST(Conduction, EveryMoveOfHeatIsBalancedAndUniformTemperatureStays) {
  const std::array constants = {copper_like};
  Rod rod(16, 2, 0.4);
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> uniform(200.0, 3000.0);
  rod.set(constants, [&](double) { return uniform(generator); });
  const std::vector<double> start = rod.particles.specific_internal_energy;
  const double before = rod.energy();
  rod.advance(rod.dx * rod.dx / (18.0 * diffusivity(copper_like)), 200, constants);
  EXPECT_NEAR(rod.energy(), before, 1e-13 * before);
  double moved = 0.0;
  for (std::size_t p = 0; p < start.size(); ++p) {
    moved = std::max(moved, std::abs(rod.particles.specific_internal_energy[p] - start[p]));
    EXPECT_GT(rod.particles.temperature[p], 0.0);
  }
  EXPECT_GT(moved, 1e5);
  rod.set(constants, [](double) { return 700.0; });
  const std::vector<double> even = rod.particles.specific_internal_energy;
  rod.advance(1e-6, 1, constants);
  for (std::size_t p = 0; p < even.size(); ++p) {
    EXPECT_NEAR(rod.particles.specific_internal_energy[p], even[p], 1e-12 * even[p]);
  }
}

TEST(Conduction, IsStableAtTwiceItsBoundForAnyArrangement) {
  const std::array constants = {copper_like};
  for (const double shift : {0.0, 0.49, 3.0}) {
    Rod rod(8, 2, 0.0);
    std::mt19937_64 generator(4);
    std::uniform_real_distribution<double> uniform(-shift, shift), noise(-1.0, 1.0);
    for (Vector3& x : rod.particles.position) {
      x[0] = std::clamp(x[0] + uniform(generator) * rod.dx, 1e-9, length - 1e-9);
    }
    rod.grid.particles_reordered();
    rod.grid.adapt(rod.particles.position, rod.particles.velocity, 0.0, {});
    rod.grid.activate(rod.particles.position, rod.particles.velocity, 0.0, {});
    ASSERT_TRUE(rod.grid.bin(rod.particles.position, {}));
    rod.set(constants, [&](double) { return 300.0 + 10.0 * noise(generator); });
    rod.advance(rod.dx * rod.dx / (9.0 * diffusivity(copper_like)), 500, constants);
    for (const double t : rod.particles.temperature) ASSERT_NEAR(t, 300.0, 40.0) << shift;
  }
}

}  // namespace
}  // namespace whipple
