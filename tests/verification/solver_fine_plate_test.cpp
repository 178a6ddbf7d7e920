// SPDX-License-Identifier: BSD-3-Clause
// A clamped plate of two, four and eight elements through its thickness: order, and the limit of the elements.
#include "tests/verification/plate_problem.hpp"

namespace whipple::verification::plate_problem {
namespace {

// Timoshenko's plate is no limit of the elements: their clamped end does not contract across the plate, and the shear is
// not that of k = 5/6 there.
TEST(ClampedPlate, ConvergesWithSecondOrderToLessThanAHundredthFromTimoshenko) {
  const double coarse = settle(2, true).deflection, middle = settle(4, true).deflection,
               fine = settle(8, true).deflection;
  const double order = std::log2((coarse - middle) / (middle - fine));
  const double limit = fine + (fine - middle) / (std::exp2(order) - 1.0);
  const double exact = timoshenko(water + density * gravity * thickness);
  std::printf("plate: order %.2f, limit %.3f um, %+.2f %% from Timoshenko\n", order, 1e6 * limit,
              100.0 * (limit / exact - 1.0));
  EXPECT_GT(order, 1.8);
  EXPECT_NEAR(limit, exact, 0.01 * exact);
}

}  // namespace
}  // namespace whipple::verification::plate_problem
