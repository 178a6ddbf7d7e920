// SPDX-License-Identifier: BSD-3-Clause
// The block grid is adapted to the particles: blocks exist where stencils reach, particles are listed by block, empty
// space costs nothing, and a position outside of the domain is an error.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <random>
#include <set>
#include <thread>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/grid/block_grid.hpp"

namespace whipple::grid {
namespace {

Geometry geometry() {
  return {.lower = Vector3(0, 0, 0), .cells = {50, 37, 410}, .cell_size = 1.0, .boundary = {}, .levels = {}};
}

std::vector<Vector3> random_positions(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<Vector3> x;
  for (std::size_t i = 0; i < n; ++i) {
    x.emplace_back(50 * uniform(random), 37 * uniform(random), 410 * uniform(random));
  }
  return x;
}

/// Bins particles as in a step: the forest is adapted only if a particle has left the active blocks.
void bin(BlockGrid& grid, const std::vector<Vector3>& x, const std::vector<Vector3>& v, double lookahead,
         Stencil stencil) {
  if (grid.bin(x, stencil)) return;
  grid.adapt(x, v, lookahead, stencil);
  grid.activate(x, v, lookahead, stencil);
  ASSERT_TRUE(grid.bin(x, stencil));
}

void check_lists(const BlockGrid& grid, const std::vector<Vector3>& x) {
  std::vector<int> seen(x.size(), 0);
  std::set<BlockCoordinate> blocks;
  for (std::size_t s = 0; s < grid.slots(); ++s) {
    EXPECT_TRUE(blocks.insert(grid.coordinate(s)).second);
    EXPECT_EQ(grid.neighbours(s)[neighbour_index(1, 1, 1)], static_cast<std::int32_t>(s));
    std::uint32_t former = 0;
    for (const std::uint32_t p : grid.particles_in(s)) {
      ++seen[p];
      EXPECT_GE(p, former);
      former = p;
      for (int a = 0; a < 3; ++a) {
        const double local = x[p][a] - 4 * grid.coordinate(s)[static_cast<std::size_t>(a)];
        EXPECT_TRUE(local >= 0 && local < 4);
        const PlaceInStencil& place = grid.places(BlockGrid::Points::particles)[p];
        const double from_first = place.from_first(static_cast<std::size_t>(a));
        EXPECT_TRUE(from_first >= 0.5 && from_first <= 1.5);  // of a quadratic B-spline
        EXPECT_NEAR(place.first_node(Stencil{})[static_cast<std::size_t>(a)] + from_first, local, 1e-15);
      }
      // All 27 nodes of a quadratic B-spline are in active blocks.
      for (int n = 0; n < 27; ++n) {
        BlockCoordinate block{};
        const std::array<int, 3> offset = {n / 9, n / 3 % 3, n % 3};
        for (std::size_t a = 0; a < 3; ++a) {
          const double node = std::floor(x[p][static_cast<Eigen::Index>(a)] - 0.5) + offset[a];
          block[a] = static_cast<std::int32_t>(std::floor(node / 4));
        }
        bool active = false;
        for (const std::int32_t neighbour : grid.neighbours(s)) {
          active =
              active || (neighbour >= 0 && grid.coordinate(static_cast<std::size_t>(neighbour)) == block);
        }
        EXPECT_TRUE(active);
      }
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  // In the order by stencil every particle occurs once, and those of one stencil are consecutive.
  std::vector<std::uint32_t> ordered;
  grid.list_by_stencil(ordered);
  EXPECT_TRUE(std::ranges::is_permutation(ordered, grid.particles_by_block()));
  const auto places = grid.places(BlockGrid::Points::particles);
  for (std::size_t s = 0; s < grid.slots(); ++s) {
    const auto of_slot = std::span(ordered).subspan(grid.place_of(s), grid.particles_in(s).size());
    EXPECT_TRUE(std::ranges::is_permutation(of_slot, grid.particles_in(s)));
    EXPECT_TRUE(std::ranges::is_sorted(of_slot, {}, [&](std::uint32_t p) { return places[p].first_node(); }));
  }
}

/// Four positions are within the faces if each of them is.
TEST(Geometry, ContainsFourIfItContainsEach) {
  Geometry box;
  box.lower = Vector3(-1.0, 2.0, -3.0);
  box.cells = {2, 4, 6};
  box.cell_size = 0.5;
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> around(-0.15, 1.1);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 12> x;
    bool expected = true;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const int axis = static_cast<int>(k % 3);
      const double low = box.lower[axis], high = box.upper(axis);
      x[k] = std::clamp(low + around(generator) * (high - low), i % 2 == 0 ? low : -1e9, 1e9);
      expected = expected && x[k] >= low && x[k] <= high;
    }
    inside += expected ? 1 : 0;
    EXPECT_EQ(box.contains_four({load(&x[0]), load(&x[4]), load(&x[8])}), expected);
  }
  EXPECT_GT(inside, 100);
  EXPECT_LT(inside, 1900);
}

/// Tests that slots processed concurrently reach different nodes, for single blocks (few slots) and for cubes of
/// blocks.
TEST(BlockGrid, SlotsAtWorkTogetherReachDifferentNodes) {
  const int threads = parallel::threads();
  parallel::set_threads(4);
  for (const std::size_t particles : {30U, 3000U}) {
    const std::vector<Vector3> x = random_positions(particles, 7), v(x.size(), Vector3::Zero());
    BlockGrid grid(geometry(), parallel::world());
    bin(grid, x, v, 0.0, {.shift = 0.5, .count = 3});
    EXPECT_EQ(grid.slots() >= 1024, particles == 3000);
    const std::array<std::size_t, 3> nodes = {60, 50, 420};
    std::vector<std::atomic<int>> at_work(nodes[0] * nodes[1] * nodes[2]);
    std::vector<std::atomic<int>> visits(grid.slots());
    std::atomic<int> met = 0;
    const auto for_reach = [&](std::size_t slot, auto&& f) {
      const auto node = [&](std::size_t a, int i) {
        return static_cast<std::size_t>(grid.block_shape().edge * grid.coordinate(slot)[a] + i + 4);
      };
      for (int i = -1; i < grid.block_shape().edge + 2; ++i) {
        for (int j = -1; j < grid.block_shape().edge + 2; ++j) {
          for (int k = -1; k < grid.block_shape().edge + 2; ++k) {
            f(at_work[(node(0, i) * nodes[1] + node(1, j)) * nodes[2] + node(2, k)]);
          }
        }
      }
    };
    grid.for_each_apart([&](std::size_t slot) {
      ++visits[slot];
      for_reach(slot, [&](std::atomic<int>& node) { met += node++; });
      std::this_thread::yield();
      for_reach(slot, [](std::atomic<int>& node) { --node; });
    });
    EXPECT_EQ(met, 0);
    for (std::size_t s = 0; s < grid.slots(); ++s) EXPECT_EQ(visits[s], grid.particles_in(s).empty() ? 0 : 1);
  }
  parallel::set_threads(threads);
}

TEST(BlockGrid, FollowsMovingParticles) {
  std::vector<Vector3> x = random_positions(300, 1);
  const std::vector<Vector3> v(x.size(), Vector3(0.3, -0.2, 0.4));
  BlockGrid grid(geometry(), parallel::world());
  const Stencil stencil{.shift = 0.5, .count = 3};
  bin(grid, x, v, 8.0, stencil);
  check_lists(grid, x);
  const std::size_t adaptations = grid.adaptations();
  for (int step = 0; step < 40; ++step) {
    for (std::size_t p = 0; p < x.size(); ++p) {
      for (int a = 0; a < 3; ++a) {
        const double limit = a == 0 ? 50 : a == 1 ? 37 : 410;
        x[p][a] = std::clamp(x[p][a] + v[p][a], 0.0, limit);
      }
    }
    bin(grid, x, v, 8.0, stencil);
  }
  check_lists(grid, x);
  EXPECT_GT(grid.adaptations(), adaptations);
  EXPECT_LT(grid.adaptations(), adaptations + 40) << "the active set must foresee the motion";
}

TEST(BlockGrid, EmptySpaceCostsNothing) {
  Geometry huge = geometry();
  huge.cells = {100000, 100000, 100000};
  BlockGrid grid(huge, parallel::world());
  const std::vector<Vector3> x = {Vector3(50000, 50000, 50000), Vector3(2, 99990, 3)};
  const std::vector<Vector3> v(2, Vector3::Zero());
  bin(grid, x, v, 0.0, {.shift = 0.5, .count = 3});
  EXPECT_LE(grid.slots(), 2U * 27U);
  EXPECT_LT(grid.forest_leaves(), 5000U);
  check_lists(grid, x);
}

TEST(BlockGrid, RefusesPositionsOutsideOfTheDomain) {
  BlockGrid grid(geometry(), parallel::world());
  const std::vector<Vector3> v(1, Vector3::Zero());
  for (const double bad : {-2.0, 60.0, std::numeric_limits<double>::quiet_NaN()}) {
    const std::vector<Vector3> x = {Vector3(bad, 1, 1)};
    EXPECT_THROW(bin(grid, x, v, 0.0, {.shift = 0.5, .count = 3}), StateError);
  }
}

/// Describes a row of particles, one per cell along z, of which those with z below `end` move.
struct Row {
  std::vector<Vector3> x;
  double end = 0.0;

  Row() {
    for (int i = 0; i < 400; ++i) x.emplace_back(22.25, 18.25, i + 0.5);
  }
  /// Processes the row as in one step.
  /// @returns number of particles at rest
  std::size_t bin_and_rest(BlockGrid& grid) const {
    const std::vector<Vector3> v(x.size(), Vector3::Zero());
    bin(grid, x, v, 0.0, {.shift = 0.5, .count = 3});
    return grid.let_rest(1, [&](std::size_t slot) {
      return std::ranges::any_of(grid.particles_in(slot), [&](std::uint32_t p) { return x[p][2] < end; });
    });
  }
};

std::size_t listed(const BlockGrid& grid) { return grid.particles_by_block().size(); }

TEST(BlockGrid, BlocksAtRestStayOffTheListsUntilMotionComesToThem) {
  BlockGrid grid(geometry(), parallel::world());
  Row row;
  row.end = 8.0;  // the first two blocks; the third shares nodes with the second
  EXPECT_EQ(row.bin_and_rest(grid), 400U - 12U);
  EXPECT_EQ(listed(grid), 12U);
  EXPECT_EQ(row.bin_and_rest(grid), 400U - 12U) << "what rested is not asked again";
  row.end = 12.0;
  EXPECT_EQ(row.bin_and_rest(grid), 400U - 16U);
  // A particle flies into an inactive block: all particles of that block are listed from the next `bin`.
  row.x[0] = Vector3(22.25, 18.25, 15.9);
  row.bin_and_rest(grid);
  row.x[0][2] = 16.1;
  row.bin_and_rest(grid);
  ASSERT_TRUE(grid.bin(row.x, {.shift = 0.5, .count = 3}));
  const auto slot = static_cast<std::size_t>(grid.slot_at(row.x[0]));
  EXPECT_EQ(grid.particles_in(slot).size(), 5U);
  EXPECT_EQ(grid.particles_in(slot).front(), 0U);
  grid.wake();
  EXPECT_EQ(listed(grid), 400U);
  check_lists(grid, row.x);
}

TEST(BlockGrid, AReleasedParticleKeepsItsBlockAwake) {
  BlockGrid grid(geometry(), parallel::world());
  Row row;  // nothing moves
  EXPECT_EQ(row.bin_and_rest(grid), 400U);
  ASSERT_TRUE(grid.bin(row.x, {.shift = 0.5, .count = 3}));
  const std::array<std::uint32_t, 2> released = {201U, 202U};
  grid.release(released);
  const auto none_moves = [](std::size_t) { return false; };
  EXPECT_EQ(grid.let_rest(1, none_moves), 400U - 12U);
  EXPECT_EQ(listed(grid), 10U) << "three blocks without the two";
  row.x[201][2] += 4.0;  // may continue to fly into another block
  ASSERT_TRUE(grid.bin(row.x, {.shift = 0.5, .count = 3}));
  grid.wake();
  check_lists(grid, row.x);
}

TEST(BlockGrid, AnOtherArrangementWakesEverything) {
  BlockGrid grid(geometry(), parallel::world());
  Row row;
  EXPECT_EQ(row.bin_and_rest(grid), 400U);
  EXPECT_TRUE(grid.chunk_rests(0));
  const std::size_t arrangement = grid.arrangement();
  std::ranges::reverse(row.x);
  grid.particles_reordered();
  EXPECT_FALSE(grid.chunk_rests(0));
  EXPECT_NE(grid.arrangement(), arrangement);
  ASSERT_TRUE(grid.bin(row.x, {.shift = 0.5, .count = 3}));
  check_lists(grid, row.x);
}

}  // namespace
}  // namespace whipple::grid
