// SPDX-License-Identifier: BSD-3-Clause
// The kernel that times are laid beside does compute a step: it keeps mass and momentum, and takes from the
// motion what it gives to the internal energy.
#include <gtest/gtest.h>

#include "src/bench/laws.hpp"
#include "src/bench/reference_kernel.hpp"

namespace whipple::bench {
namespace {

TEST(ReferenceKernel, KeepsMassAndMomentumAndNearlyTheEnergy) {
  ReferenceKernel kernel(10);
  const double mass = kernel.mass(), scale = mass * 40.0;
  const double before = kernel.kinetic_energy() + kernel.internal_energy(), kinetic = kernel.kinetic_energy();
  for (int i = 0; i < 30; ++i) kernel.step();
  EXPECT_EQ(kernel.mass(), mass);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(kernel.momentum(a), 0.0, 1e-12 * scale) << a;
  EXPECT_GT(kernel.largest_plastic_strain(), 0.01);
  EXPECT_LT(kernel.kinetic_energy(), 0.9 * kinetic);
  // Stress last with FLIP does not conserve it exactly.
  EXPECT_NEAR(kernel.kinetic_energy() + kernel.internal_energy(), before, 0.02 * before);
}

TEST(Laws, AreReadAndTakeTimeInMultiplesOfTheFirst) {
  const std::vector<LawMeasurement> laws = measure_laws(1);
  ASSERT_GT(laws.size(), 15U);
  EXPECT_EQ(laws.front().name, "johnson_cook");
  EXPECT_EQ(laws.front().multiple, 1.0);
  for (const LawMeasurement& law : laws) {
    EXPECT_GT(law.nanoseconds, 0.0) << law.name;
    EXPECT_NEAR(law.multiple, law.nanoseconds / laws.front().nanoseconds, 1e-12) << law.name;
  }
}

}  // namespace
}  // namespace whipple::bench
