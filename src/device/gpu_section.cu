// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/engine.hpp"
#include "src/device/gpu_space.cuh"
#include "src/device/stepper.hpp"

namespace whipple::device::in_section {

std::unique_ptr<Engine> gpu_engine(const Problem& problem, const PointsOnHost& points) {
  return std::make_unique<Stepper<GpuSpace, SectionLattice>>(problem, points);
}

}  // namespace whipple::device::in_section
