// SPDX-License-Identifier: BSD-3-Clause
// The order in which a step visits its particles.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <ranges>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/transfer/sweep.hpp"
#include "tests/property/transfer_support.hpp"

namespace whipple::transfer {
namespace {

/// Particles of which a third lie in one dense block, and their grid.
struct Cloud {
  explicit Cloud(std::size_t n)
      : particles(random_particles(n, Vector3(-1.2, -0.3, 4), Vector3(8, 6.5, 11.8), 5)) {
    bin<QuadraticBSpline>(grid, particles);
  }
  Particles particles;
  grid::BlockGrid grid{geometry(), parallel::world()};
};

TEST(Sweep, VisitsEveryParticleOnceInStretchesOfWholeSlots) {
  Cloud cloud(6000);
  Sweep sweep(cloud.grid);
  std::vector<int> visits(cloud.particles.size(), 0);
  std::map<std::size_t, Stretch> by_number;
  std::mutex mutex;
  for (const Region region : gather_order) {
    sweep.for_each_stretch(region, [&](const Stretch& stretch) {
      const std::lock_guard lock(mutex);
      for (const std::uint32_t p : stretch.particles) ++visits[p];
      EXPECT_TRUE(by_number.emplace(stretch.number, stretch).second) << "a stretch comes twice";
      EXPECT_EQ(stretch.gradients.size(), stretch.particles.size());
    });
  }
  EXPECT_TRUE(std::ranges::all_of(visits, [](int times) { return times == 1; }));
  ASSERT_EQ(by_number.size(), sweep.stretches());
  EXPECT_GT(by_number.size(), 8U);
  std::size_t slot = 0;
  for (const auto& [number, stretch] : by_number) {  // numbers and slots ascend together, without a gap
    EXPECT_EQ(stretch.first_slot, slot) << number;
    slot += stretch.balances.size();
    const bool is_alone =
        std::ranges::count_if(std::views::iota(stretch.first_slot, slot),
                              [&](std::size_t s) { return !cloud.grid.particles_in(s).empty(); }) == 1;
    EXPECT_TRUE(stretch.particles.size() <= Sweep::points_of_stretch || is_alone) << stretch.particles.size();
  }
  EXPECT_EQ(slot, cloud.grid.slots());
}

TEST(Sweep, VisitsTheRegionThatItIsToldAndNoOther) {
  Cloud cloud(2000);
  Sweep sweep(cloud.grid);
  std::size_t visited = 0;
  sweep.for_each_stretch(Region::border, [&](const Stretch&) { ++visited; });
  EXPECT_EQ(visited, 0U);  // a rank alone has no border
}

TEST(Sweep, SumsSlotBySlotWhateverTheOrderOfStretches) {
  Cloud cloud(3000);
  const auto sum = [&](int threads) {
    const int before = parallel::threads();
    parallel::set_threads(threads);
    Sweep sweep(cloud.grid);
    for (const Region region : gather_order) {
      sweep.for_each_stretch(region, [](const Stretch& stretch) {
        for (std::size_t i = 0; i < stretch.balances.size(); ++i) {
          const double value = 1.0 / static_cast<double>(3 + stretch.first_slot + i);
          stretch.balances[i] = {.work = value, .squared_change = value};
        }
      });
    }
    parallel::set_threads(before);
    return sweep.balance();
  };
  double work = 0.0;
  for (std::size_t slot = 0; slot < cloud.grid.slots(); ++slot) work += 1.0 / static_cast<double>(3 + slot);
  for (const int threads : {1, 3}) {
    const TransferBalance balance = sum(threads);
    EXPECT_EQ(balance.work, work) << threads;
    EXPECT_EQ(balance.squared_change, 1.0 / 3.0) << threads;
  }
}

}  // namespace
}  // namespace whipple::transfer
