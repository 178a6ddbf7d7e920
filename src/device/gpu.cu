// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/engine.hpp"
#include "src/device/gpu_space.cuh"
#include "src/device/stepper.hpp"

namespace whipple::device {

bool has_gpu_engine() { return true; }

std::unique_ptr<Engine> gpu_engine(const Problem& problem, const PointsOnHost& points) {
  if (problem.dimension != Dimension::space) return in_section::gpu_engine(problem, points);
  return std::make_unique<Stepper<GpuSpace, SpaceLattice>>(problem, points);
}

}  // namespace whipple::device
