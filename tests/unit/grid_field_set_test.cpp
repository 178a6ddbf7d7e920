// SPDX-License-Identifier: BSD-3-Clause
// Sets of velocity fields of more than one word.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "src/contact/first_touches.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/grid/field_set.hpp"

namespace whipple::grid {
namespace {

TEST(FieldSet, CountsAndOrdersItsFields) {
  std::mt19937_64 generator(7);
  std::uniform_int_distribution<unsigned> any(0, maximum_fields - 1);
  for (const int size : {0, 1, 2, 30, 200}) {
    FieldSet set;
    std::set<unsigned> expected;
    for (int n = 0; n < size; ++n) {
      const unsigned field = any(generator);
      set.insert(field);
      expected.insert(field);
    }
    EXPECT_EQ(set.count(), expected.size());
    EXPECT_EQ(set.empty(), expected.empty());
    std::vector<unsigned> visited;
    set.for_each([&](unsigned field) { visited.push_back(field); });
    EXPECT_EQ(visited, std::vector<unsigned>(expected.begin(), expected.end()));
    for (std::size_t n = 0; n < visited.size(); ++n) {
      EXPECT_EQ(set.nth(n), visited[n]);
      EXPECT_EQ(set.count_below(visited[n]), n);
      EXPECT_TRUE(set.contains(visited[n]));
    }
    EXPECT_EQ(set.count_below(maximum_fields), expected.size());
    EXPECT_FALSE(set.is_full());
    FieldSet rest = FieldSet::from(0);
    EXPECT_TRUE(rest.is_full());
    EXPECT_EQ(rest & set, set);
    EXPECT_EQ((rest |= set), FieldSet::from(0));
  }
  EXPECT_EQ(FieldSet::of_bits(0b101), [] {
    FieldSet set = FieldSet::of(0);
    set.insert(2);
    return set;
  }());
  EXPECT_EQ(FieldSet::from(70).count(), FieldSet::size - 70);
  EXPECT_FALSE(FieldSet::from(70).contains(69));
}

TEST(FirstTouches, OfTwoHundredFieldsAreRemembered) {
  contact::FirstTouches touches(200);
  touches.begin_step(0.1, 5.0);
  touches.see(3, 199, 0.5, 10.0);  // touches within the step
  touches.see_face(4, 0.5, 10.0);
  EXPECT_TRUE(touches.end_step(parallel::world()).hard);
  contact::FirstTouches restarted(200);
  restarted.set(touches.words());
  restarted.begin_step(0.1, 5.0);
  restarted.see(3, 199, 0.5, 10.0);
  restarted.see_face(4, 0.5, 10.0);
  EXPECT_FALSE(restarted.end_step(parallel::world()).hard);
  restarted.begin_step(0.1, 5.0);
  restarted.see(3, 135, 0.5, 10.0);  // the same bit of another word
  EXPECT_TRUE(restarted.end_step(parallel::world()).hard);
}

}  // namespace
}  // namespace whipple::grid
