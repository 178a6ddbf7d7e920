// SPDX-License-Identifier: BSD-3-Clause
// A clamped plate of elements against Timoshenko's deflection (docs/theory/fem.md, section 8); with water on it: case
// column_on_plate.
#include "tests/verification/plate_problem.hpp"

namespace whipple::verification::plate_problem {
namespace {

TEST(ClampedPlate, ComesToTheDeflectionOfTimoshenko) {
  constexpr double weight = density * gravity * thickness;
  EXPECT_NEAR(1e6 * timoshenko(water), 66.6, 0.05);
  EXPECT_NEAR(1e6 * timoshenko(water + weight), 71.1, 0.05);
  const Rest coarse = settle(2, true), fine = settle(4, true), water_alone = settle(2, false);
  for (const Rest& rest : {coarse, fine, water_alone}) {
    EXPECT_LT(rest.moving, 1e-8);
    EXPECT_LT(rest.energy, 1e-12);
  }
  // Loads add up, but for what is left of the motion.
  EXPECT_NEAR(water_alone.deflection, water / (water + weight) * coarse.deflection, 5e-4 * coarse.deflection);
  EXPECT_NEAR(coarse.deflection, timoshenko(water + weight), 0.05 * fine.deflection);
  EXPECT_NEAR(fine.deflection, timoshenko(water + weight), 0.005 * fine.deflection);
}

}  // namespace
}  // namespace whipple::verification::plate_problem
