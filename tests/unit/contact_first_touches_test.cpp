// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "src/contact/first_touches.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::contact {
namespace {

TEST(FirstTouches, TellsTheNextTouchAndForgetsWhatHasTouched) {
  FirstTouches touches(4);
  touches.begin_step(0.1, 5.0);
  touches.see(0, 1, 3.0, 10.0);  // in 0.3 s
  touches.see(0, 2, 2.0, 10.0);  // in 0.2 s
  touches.see(1, 2, 0.4, 4.0);   // in 0.1 s, but too slowly to limit the step
  touches.see(2, 3, 1.0, -10.0);
  FirstTouches::Outcome seen = touches.end_step(parallel::world());
  EXPECT_DOUBLE_EQ(seen.next, 0.2);
  EXPECT_FALSE(seen.hard);

  touches.begin_step(0.1, 5.0);
  touches.see(0, 2, 0.9, 10.0);  // touches within the step
  touches.see(0, 1, 2.0, 10.0);
  seen = touches.end_step(parallel::world());
  EXPECT_TRUE(seen.hard);
  EXPECT_DOUBLE_EQ(seen.next, 0.2);

  touches.begin_step(0.1, 5.0);
  touches.see(0, 2, -1.0, 10.0);  // has touched before
  touches.see(1, 2, 0.0, 4.0);    // touches slowly
  touches.see_face(5, 1.4, 7.0);  // in 0.2 s
  seen = touches.end_step(parallel::world());
  EXPECT_FALSE(seen.hard);
  EXPECT_DOUBLE_EQ(seen.next, 0.2);

  FirstTouches restarted(4);
  restarted.set(touches.words());
  restarted.begin_step(0.1, 5.0);
  restarted.see(1, 2, 1.0, 10.0);
  restarted.see_face(5, 0.0, 7.0);
  seen = restarted.end_step(parallel::world());
  EXPECT_TRUE(seen.hard);
  EXPECT_EQ(seen.next, 1e300);
}

}  // namespace
}  // namespace whipple::contact
