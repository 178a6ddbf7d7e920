// SPDX-License-Identifier: BSD-3-Clause
// Planar impacts across gaps: the complete set sampled by solver_gap_test.cpp.
#include "tests/verification/gap_problems.hpp"

namespace whipple::verification {
namespace {

TEST(GapSweep, MakesNoDifferenceToAPlanarImpact) {
  for (const double speed : {200.0, 500.0, 2000.0, 6000.0}) {
    const std::vector<double> offsets = {0.0, 0.25, 0.5};
    const Touching touching({.speed = speed}, offsets);
    for (const double offset : offsets) {
      const PlanarGap set{.speed = speed, .offset = offset};
      for (const double gap : {0.1, 0.5, 1.0, 2.0, 5.0, 20.0})
        expect_like_touching(set.across(gap), touching);
    }
  }
}

TEST(GapSweep, MakesNoDifferenceToElements) {
  for (const double speed : {200.0, 500.0, 2000.0}) {
    for (const auto& [flyer, target] : {std::pair(elements, std::string()),
                                        std::pair(std::string(), elements), std::pair(elements, elements)}) {
      const PlanarGap set{.speed = speed, .of_flyer = flyer, .of_target = target};
      const Touching touching(set);
      for (const double gap : {0.5, 2.0, 5.0}) expect_like_touching(set.across(gap), touching);
    }
  }
}

TEST(GapSweep, MakesNoDifferenceInOtherMethods) {
  for (const char* shape : {"quadratic_bspline", "cubic_bspline"}) {
    for (const char* update : {"relaxed_affine", "apic", "flip", "pic"}) {
      const PlanarGap set{.method = {.shape_function = shape, .particle_update = update}};
      const Touching touching(set);
      for (const double gap : {0.5, 2.3}) expect_like_touching(set.across(gap), touching);
    }
  }
}

}  // namespace
}  // namespace whipple::verification
