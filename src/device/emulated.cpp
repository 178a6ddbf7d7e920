// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/engine.hpp"
#include "src/device/host_space.hpp"
#include "src/device/stepper.hpp"

namespace whipple::device {

std::unique_ptr<Engine> emulated_engine(const Problem& problem, const PointsOnHost& points) {
  if (problem.dimension != Dimension::space) return in_section::emulated_engine(problem, points);
  return std::make_unique<Stepper<HostSpace, SpaceLattice>>(problem, points);
}

}  // namespace whipple::device
