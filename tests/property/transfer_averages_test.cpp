// SPDX-License-Identifier: BSD-3-Clause
// Means of pressure and volume rate over cells (docs/theory/mpm.md, 4.12 to 4.14): their values, and the identity of work.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/transfer/averages.hpp"
#include "tests/property/transfer_support.hpp"

namespace whipple::transfer {
namespace {

/// Particles of two bodies of which the second is averaged, with random volume rates.
struct TwoBodies {
  TwoBodies() {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      particles.body[p] = p < 1500 ? 0 : 1;
      gradient.push_back(Matrix3::NullaryExpr([&] { return normal(random); }));
      rate.push_back(normal(random));
    }
    bin<QuadraticBSpline>(grid, particles);
  }

  /// Fills the stretches with gradients and rates, averages them, and stores what they hold then.
  /// @param average  average(stretch)
  template <class Average>
  TransferBalance sweep(Average&& average) {
    Sweep sweep(grid);
    for (const Region region : gather_order) {
      sweep.for_each_stretch(region, [&](const Stretch& stretch) {
        for (TransferBalance& balance : stretch.balances) balance = {};
        for (std::size_t k = 0; k < stretch.particles.size(); ++k) {
          stretch.gradients[k] = gradient[stretch.particles[k]];
          stretch.volume_rates[k] = rate[stretch.particles[k]];
        }
        average(stretch);
        for (std::size_t k = 0; k < stretch.particles.size(); ++k) {
          gradient[stretch.particles[k]] = stretch.gradients[k];
        }
      });
    }
    return sweep.balance();
  }

  Particles particles = random_particles(3000, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 3);
  grid::BlockGrid grid{geometry(), parallel::world()};
  AveragedBodies averaged{{0, 1}};
  SharedCells alone;  // no other rank
  std::vector<Matrix3> gradient;
  std::vector<double> rate;
};

/// Means by volume over the particles of the second body by cell.
std::vector<double> means_by_cell(const Particles& q, const std::vector<double>& value) {
  std::map<std::array<long, 3>, std::array<double, 2>> cells;
  const auto cell_of = [&](std::size_t p) {
    std::array<long, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<int>(a);
      cell[a] = std::lround(std::floor((q.position[p][axis] - geometry().lower[axis]) / dx));
    }
    return cell;
  };
  for (std::size_t p = 1500; p < q.size(); ++p) {
    auto& [volume, product] = cells[cell_of(p)];
    volume += q.volume[p];
    product += q.volume[p] * value[p];
  }
  std::vector<double> means = value;
  for (std::size_t p = 1500; p < q.size(); ++p) means[p] = cells[cell_of(p)][1] / cells[cell_of(p)][0];
  return means;
}

TEST(Averages, AreMeansByVolumeOverTheParticlesOfABodyInACell) {
  TwoBodies two;
  const Particles& q = two.particles;
  std::vector<double> own, stress(q.size()), trace;
  for (std::size_t p = 0; p < q.size(); ++p) {
    own.push_back(-(q.pressure[p] + q.artificial_viscosity[p]));
    trace.push_back(two.gradient[p].trace());
  }
  const std::vector<Matrix3> before = two.gradient;
  average_stress(q, two.grid, two.averaged, two.alone, stress);
  two.sweep(
      [&](const Stretch& stretch) { average_volume_rate(q, two.grid, two.averaged, two.alone, stretch); });
  const std::vector<double> exact_stress = means_by_cell(q, own), exact_trace = means_by_cell(q, trace);
  for (std::size_t p = 0; p < q.size(); ++p) {
    if (p < 1500) {
      EXPECT_EQ(stress[p], own[p]);
      EXPECT_EQ(two.gradient[p], before[p]);
      continue;
    }
    EXPECT_NEAR(stress[p], exact_stress[p], 1e-13);
    EXPECT_NEAR(two.gradient[p].trace(), exact_trace[p], 1e-13);
    const Matrix3 change = two.gradient[p] - before[p];  // a change of volume without shape
    EXPECT_LT((change - change.trace() / 3.0 * Matrix3::Identity()).norm(), 1e-14);
  }
}

TEST(Averages, TheWorkOfOwnPressureOnMeanRatesIsThatOfMeanPressureOnOwnRates) {
  TwoBodies two;
  Particles& q = two.particles;
  constexpr double dt = 0.125;
  std::vector<double> stress(q.size());
  average_stress(q, two.grid, two.averaged, two.alone, stress);
  double by_forces = 0.0, by_own = 0.0, energy = 0.0, scale = 0.0;
  const std::vector<double> before = q.specific_internal_energy;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double own = -(q.pressure[p] + q.artificial_viscosity[p]) * two.rate[p] * q.volume[p] * dt;
    by_forces += stress[p] * two.rate[p] * q.volume[p] * dt;
    by_own += own;
    scale += std::abs(own);
  }
  const TransferBalance balance = two.sweep([&](const Stretch& stretch) {
    average_volume_rate_and_work(q, two.grid, two.averaged, two.alone, stretch, dt);
  });
  for (std::size_t p = 0; p < q.size(); ++p)
    energy += q.mass[p] * (q.specific_internal_energy[p] - before[p]);
  EXPECT_GT(std::abs(by_forces - by_own), 1e-3 * scale);
  EXPECT_NEAR(energy, by_forces - by_own, 1e-14 * scale);
  EXPECT_NEAR(balance.work, by_forces - by_own, 1e-14 * scale);
  for (std::size_t p = 0; p < 1500; ++p) EXPECT_EQ(q.specific_internal_energy[p], before[p]);
}

}  // namespace
}  // namespace whipple::transfer
