// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/engine.hpp"
#include "src/device/gpu_space.cuh"
#include "src/device/stepper.hpp"

namespace whipple::device {

bool has_gpu_engine() { return true; }

std::optional<Card> find_card() {
  int count = 0;
  std::size_t free_bytes = 0, bytes = 0;
  if (cudaGetDeviceCount(&count) != cudaSuccess || count == 0) return {};
  if (cudaMemGetInfo(&free_bytes, &bytes) != cudaSuccess) return {};
  return Card{GpuSpace::name(), static_cast<double>(bytes), static_cast<double>(free_bytes)};
}

Rates card_rates() {
  GpuSpace space;
  return measured_rates(space);
}

std::unique_ptr<Engine> gpu_engine(const Problem& problem, const PointsOnHost& points) {
  if (problem.dimension != Dimension::space) return in_section::gpu_engine(problem, points);
  return std::make_unique<Stepper<GpuSpace, SpaceLattice>>(problem, points);
}

}  // namespace whipple::device
