// SPDX-License-Identifier: BSD-3-Clause
// The finest pair of docs/generated/orders_of_convergence.md, with particles that cross cells: cubic B-splines keep
// their order, quadratic ones have reached the floor of their quadrature, which is part of every accuracy statement for
// the default.
#include <gtest/gtest.h>

#include "tests/verification/solver_orders.hpp"

namespace whipple::verification {
namespace {

TEST(FinestPair, CubicSplinesKeepTheirOrderAndQuadraticOnesStandAtTheirFloor) {
  const ManufacturedWaves waves;
  Method cubic;
  cubic.shape_function = "cubic_bspline";
  const double coarse = motion_error(waves, cubic, 32), fine = motion_error(waves, cubic, 64);
  EXPECT_GT(order_of(coarse, fine), 1.8);
  EXPECT_LT(fine, 2e-3);
  EXPECT_NEAR(motion_error(waves, Method{}, 64), 0.011, 0.002);
}

}  // namespace
}  // namespace whipple::verification
