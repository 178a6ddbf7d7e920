// SPDX-License-Identifier: BSD-3-Clause
// Time that a rank of several gives itself after a signal: little to the end of a step, much for what is written.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "src/run/signal_control.hpp"

namespace whipple::run {
namespace {

/// Returns the seconds that are left to this process, and takes the limit away. 0: there was none.
unsigned time_left() { return ::alarm(0); }

TEST(SignalControl, LimitsAStepAndGivesFilesMoreTime) {
  SignalControl control(true);
  control.writing_begins();
  EXPECT_EQ(time_left(), 0U) << "there was no signal";
  control.step_begins();
  std::raise(SIGTERM);
  EXPECT_NEAR(::alarm(5), SignalControl::patience, 1);
  std::raise(SIGTERM);
  EXPECT_LE(time_left(), 5U) << "the clock of the first signal goes on";
  control.writing_begins();
  EXPECT_NEAR(time_left(), SignalControl::patience_of_writing, 1);
}

TEST(SignalControl, ASignalAmidFilesLeavesThemTheirTimeAndLimitsTheStepAfterThem) {
  SignalControl control(true);
  control.writing_begins();
  std::raise(SIGUSR2);
  EXPECT_NEAR(time_left(), SignalControl::patience_of_writing, 1);
  control.step_begins();
  EXPECT_NEAR(time_left(), SignalControl::patience, 1);
}

TEST(SignalControl, LimitsNoProcessThatIsAlone) {
  SignalControl control(false);
  std::raise(SIGTERM);
  EXPECT_EQ(time_left(), 0U);
}

}  // namespace
}  // namespace whipple::run
