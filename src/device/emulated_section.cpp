// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/engine.hpp"
#include "src/device/host_space.hpp"
#include "src/device/stepper.hpp"

namespace whipple::device::in_section {

std::unique_ptr<Engine> emulated_engine(const Problem& problem, const PointsOnHost& points) {
  return std::make_unique<Stepper<HostSpace, SectionLattice>>(problem, points);
}

}  // namespace whipple::device::in_section
