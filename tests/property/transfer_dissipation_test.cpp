// SPDX-License-Identifier: BSD-3-Clause
// Conduction inside shocks and the booking of losses (docs/theory/dissipation.md): energy to round-off,
// bounds of the temperature, growth of the entropy, rest, mirror planes; who gets which loss.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/core/parallel/mpi.hpp"
#include "src/transfer/losses.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/shock_conduction.hpp"
#include "tests/property/transfer_support.hpp"

namespace whipple::transfer {

/// As GoogleTest shows the parameter.
static void PrintTo(ShapeFunction shape, std::ostream* out) { *out << word_of(shape); }

namespace {

constexpr double dt = 0.02;

/// Particles with random temperatures, every second of them inside a shock.
Particles conducting_particles(unsigned seed) {
  Particles q = random_particles(600, {-1.5, -0.5, 3.5}, {6.5, 5.5, 9.5}, seed);
  use_stores(q);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  for (std::size_t p = 0; p < q.size(); ++p) {
    q.body[p] = p < q.size() / 2 ? 0 : 1;
    q.temperature[p] = 300.0 + 3000.0 * uniform(random);
    q.closing_rate[p] = p % 2 == 0 ? 2.0 * uniform(random) : 0.0;
  }
  return q;
}

constexpr std::array<ShockConductivity, 2> bodies = {ShockConductivity{400.0, 0.25, 1.0},
                                                     ShockConductivity{900.0, 0.5, 2.0}};
constexpr ShockConduction conduction() {
  return {.scale = 1.0, .onset = 0.01, .rise = 0.05, .of_body = bodies};
}

double energy(const Particles& q) {
  double sum = 0.0;
  for (std::size_t p = 0; p < q.size(); ++p) sum += q.mass[p] * q.specific_internal_energy[p];
  return sum;
}

class ShockConductionOf : public testing::TestWithParam<ShapeFunction> {};

TEST_P(ShockConductionOf, KeepsTheEnergyAndTheRangeOfTemperaturesAndRaisesTheEntropy) {
  for (const bool mirrored : {false, true}) {
    std::array<grid::Boundary, 6> faces{};
    if (mirrored) faces[0] = faces[2] = grid::Boundary::symmetry;
    with_shape(GetParam(), [&]<class Shape>(Shape) {
      Particles q = conducting_particles(7);
      if (mirrored) {
        for (Vector3& x : q.position) x = x.cwiseMax(Vector3(-1.99, -0.99, 3.0));
      }
      const std::vector<double> before = q.specific_internal_energy;
      grid::BlockGrid grid(geometry(faces), parallel::world());
      bin<Shape>(grid, q);
      const double moved = conduct_in_shocks(Shape::kind, q, grid, dt, conduction());
      Particles old = q;
      old.specific_internal_energy = before;
      EXPECT_GT(moved, 0.0);
      EXPECT_NEAR(energy(q), energy(old), 1e-13 * moved);
      const auto [coldest, hottest] = std::ranges::minmax(q.temperature);
      double entropy = 0.0, taken_up = 0.0;
      for (std::size_t p = 0; p < q.size(); ++p) {
        const double gain = q.specific_internal_energy[p] - before[p];
        const double after = q.temperature[p] + gain / bodies[q.body[p]].heat_capacity;
        EXPECT_GE(after, coldest * (1.0 - 1e-12));
        EXPECT_LE(after, hottest * (1.0 + 1e-12));
        entropy += q.mass[p] * gain / q.temperature[p];
        taken_up += q.mass[p] * std::max(gain, 0.0);
      }
      EXPECT_GT(entropy, 0.0);
      EXPECT_NEAR(taken_up, moved, 1e-12 * moved);
    });
  }
}

TEST_P(ShockConductionOf, IsQuietWithoutAShockOrADifference) {
  with_shape(GetParam(), [&]<class Shape>(Shape) {
    Particles q = conducting_particles(8);
    grid::BlockGrid grid(geometry(), parallel::world());
    bin<Shape>(grid, q);
    const std::vector<double> before = q.specific_internal_energy;
    std::ranges::fill(q.temperature, 500.0);
    conduct_in_shocks(Shape::kind, q, grid, dt, conduction());
    for (std::size_t p = 0; p < q.size(); ++p) {
      EXPECT_NEAR(q.specific_internal_energy[p], before[p], 1e-9 * 900.0 * 500.0);
    }
    q = conducting_particles(8);
    for (double& rate : q.closing_rate) rate = 0.5 * 0.01 / dx;  // below the onset: the sound speed is 1 to 2
    EXPECT_EQ(conduct_in_shocks(Shape::kind, q, grid, dt, conduction()), 0.0);
    EXPECT_EQ(q.specific_internal_energy, before);
  });
}

// Blocks far from the shock take no part; the result must be that of all taking part.
TEST(ShockConduction, DoesNotDependOnWhatElseTheGridHolds) {
  using Shape = QuadraticBSpline;
  Particles near = random_particles(300, {-1.5, -0.5, 3.5}, {-0.5, 0.5, 4.5}, 3), all = near;
  const Particles far = random_particles(100, {7.0, 6.0, 10.0}, {8.5, 7.0, 12.0}, 4);
  resize(all, near.size() + far.size());
  for_each_field(far, [&](const auto& field) {
    const auto& from = field.of(far);
    if (!from.empty())
      std::ranges::copy(from, field.of(all).begin() + static_cast<std::ptrdiff_t>(near.size()));
  });
  const auto run = [](Particles& q, std::size_t hot) {
    use_stores(q);
    for (std::size_t p = 0; p < q.size(); ++p) {
      q.temperature[p] = 300.0 + static_cast<double>(p % 17);
      q.closing_rate[p] = p < hot && p % 3 == 0 ? 1.0 : 0.0;
    }
    grid::BlockGrid grid(geometry(), parallel::world());
    bin<Shape>(grid, q);
    conduct_in_shocks(Shape::kind, q, grid, dt, conduction());
  };
  run(near, near.size());
  run(all, near.size());
  for (std::size_t p = 0; p < near.size(); ++p) {
    EXPECT_EQ(all.specific_internal_energy[p], near.specific_internal_energy[p]);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ShockConductionOf,
                         testing::Values(ShapeFunction::linear, ShapeFunction::gimp,
                                         ShapeFunction::quadratic_bspline, ShapeFunction::cubic_bspline));

/// One particle of a body that starts with 1000 kg/m^3.
Particles one_particle(double density, double pressure) {
  Particles q;
  resize(q, 1);
  use_stores(q);
  q.mass[0] = 1.0;
  q.volume[0] = 1.0 / density;
  q.pressure[0] = pressure;
  q.unresolved_energy[0] = 50.0;
  q.artificial_viscosity[0] = 4.0;
  q.heating_viscosity[0] = 1.0;
  return q;
}
constexpr std::array initial_density = {1000.0};
constexpr Losses losses{.become = LossesBecome::unresolved_energy,
                        .heat_share = 0.1,
                        .collision_rate = 1.0,
                        .initial_density = initial_density};

TEST(Losses, InTightMatterHeatAsFarAsTheViscosityThatHeatsDoesWork) {
  const Particles q = one_particle(1100.0, 1e9);
  const DividedLosses b = divide_losses(losses, q, 0, 30.0, 7.0, 80.0, -5.0, 0.01);
  EXPECT_DOUBLE_EQ(b.cooling, 60.0);  // three quarters of the work of the viscosity
  EXPECT_DOUBLE_EQ(b.heat, 2.0);      // a tenth of the quarter that heats
  EXPECT_DOUBLE_EQ(b.kept, 28.0 + 60.0);
  EXPECT_EQ(b.returned, 0.0);
  EXPECT_EQ(b.of_contact, 7.0);
  const DividedLosses small = divide_losses(losses, q, 0, 1.5, 0.0, 80.0, -5.0, 0.01);
  EXPECT_DOUBLE_EQ(small.heat, 1.5);
  const DividedLosses opening = divide_losses(losses, q, 0, 30.0, 7.0, -3.0, 5.0, 0.01);
  EXPECT_EQ(opening.heat, 0.0);
  EXPECT_EQ(opening.cooling, 0.0);
  EXPECT_EQ(opening.kept, 30.0);
}

// The losses of a steady shock come in steps in which its viscosity rests: its work counts for a while.
TEST(Losses, TakeWhatEarlierViscosityAllowedUntilItIsUsedUpOrForgotten) {
  Losses with_memory = losses;
  with_memory.allowance_length = 4.0;  // m
  Particles q = one_particle(1100.0, 1e9);
  q.sound_speed[0] = 200.0;
  const DividedLosses shock = divide_losses(with_memory, q, 0, 0.5, 0.0, 80.0, -5.0, 0.01);
  EXPECT_DOUBLE_EQ(shock.heat, 0.5);
  EXPECT_DOUBLE_EQ(shock.allowance, 1.5);
  q.heat_allowance[0] = shock.allowance;
  const double kept = std::exp(-200.0 * 0.01 / 4.0);
  const DividedLosses rest = divide_losses(with_memory, q, 0, 0.5, 0.0, 0.0, -5.0, 0.01);
  EXPECT_DOUBLE_EQ(rest.heat, 0.5);
  EXPECT_DOUBLE_EQ(rest.allowance, 1.5 * kept - 0.5);
  EXPECT_EQ(rest.kept, 0.0);
  const DividedLosses too_much = divide_losses(with_memory, q, 0, 30.0, 0.0, 0.0, -5.0, 0.01);
  EXPECT_DOUBLE_EQ(too_much.heat, 1.5 * kept);
  EXPECT_EQ(too_much.allowance, 0.0);
  const DividedLosses without = divide_losses(losses, q, 0, 0.5, 0.0, 0.0, -5.0, 0.01);
  EXPECT_EQ(without.heat, 0.0);
  q.pressure[0] = -1e6;  // gaps that close have none
  EXPECT_EQ(divide_losses(with_memory, q, 0, 0.5, 0.0, 80.0, -5.0, 0.01).allowance, 0.0);
}

TEST(Losses, WhereGapsCloseAllHeatsAndTheStoreReturnsWithTheVolume) {
  for (const bool thin : {true, false}) {
    Particles q = one_particle(thin ? 900.0 : 1100.0, thin ? 1e9 : -1e6);
    const DividedLosses b = divide_losses(losses, q, 0, 30.0, 7.0, 80.0, -5.0, 0.01);
    EXPECT_EQ(b.heat, 30.0);
    EXPECT_EQ(b.kept, 0.0);
    EXPECT_EQ(b.cooling, 0.0);
    EXPECT_DOUBLE_EQ(b.returned, 50.0 * -std::expm1(-0.05));
    const DividedLosses opens = divide_losses(losses, q, 0, 30.0, 7.0, 0.0, 5.0, 0.01);
    EXPECT_EQ(opens.returned, 0.0);
    EXPECT_EQ(opens.kept, 37.0);
    EXPECT_EQ(opens.of_contact, 0.0);
    EXPECT_EQ(b.of_contact, 7.0);
  }
}

}  // namespace
}  // namespace whipple::transfer
