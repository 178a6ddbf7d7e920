// SPDX-License-Identifier: BSD-3-Clause
// Removal by moving the last items of a group into the gaps: whichever items are removed, the remaining ones are
// complete, grouped, and mostly in their original positions.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "src/core/base/gaps.hpp"

namespace whipple {
namespace {

TEST(Gaps, AreFilledWithoutLosingAnItemOrMixingGroups) {
  std::mt19937 generator(11);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<std::uint32_t> group, id, leaving, staying;
    const auto groups = static_cast<std::uint32_t>(generator() % 5);
    for (std::uint32_t g = 0; g < groups; ++g) group.resize(group.size() + generator() % 12, g);
    const double share = static_cast<double>(generator() % 5) / 4.0;  // from none to all
    for (std::uint32_t i = 0; i < group.size(); ++i) {
      id.push_back(i);
      (std::bernoulli_distribution(share)(generator) ? leaving : staying).push_back(i);
    }
    const std::vector<std::uint32_t> group_of_id = group;
    const std::vector<Move> moves = moves_into_gaps(group, leaving);
    EXPECT_LE(moves.size(), leaving.size() * std::max<std::size_t>(groups, 1));
    close_gaps(id, moves, staying.size());
    close_gaps(group, moves, staying.size());
    EXPECT_TRUE(std::ranges::is_sorted(group)) << trial;
    for (std::size_t i = 0; i < id.size(); ++i) EXPECT_EQ(group[i], group_of_id[id[i]]) << trial;
    std::ranges::sort(id);
    EXPECT_EQ(id, staying) << trial;
  }
}

TEST(Gaps, MoveOnlyAsManyItemsAsLeave) {
  const std::vector<std::uint32_t> group(1000, 0), leaving = {3, 500, 998};
  const std::vector<Move> moves = moves_into_gaps(group, leaving);
  ASSERT_EQ(moves.size(), 2U);  // 998 is behind the new end
  EXPECT_EQ(moves[0].to, 3U);
  EXPECT_EQ(moves[0].from, 997U);
  EXPECT_EQ(moves[1].to, 500U);
  EXPECT_EQ(moves[1].from, 999U);
}

}  // namespace
}  // namespace whipple
