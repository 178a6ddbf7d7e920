// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "src/device/check/arrangements.hpp"
#include "src/device/check/compare.hpp"
#include "src/device/check/json.hpp"
#include "src/device/cost.hpp"

namespace whipple::device::check {

/// Times of the step of some particles.
struct Timing {
  std::string arrangement, fault;  ///< fault: why there are no times; empty: there are
  StepSize size;
  std::size_t steps = 0;
  double bytes = 0.0;  ///< of the device's memory
  double step = 0.0;   ///< s per particle and step, without waiting between the stages
  std::array<double, stage_count> of_stages{};  ///< the same for each stage, with it
};

/// Times steps after two that are not timed: twenty, which sort the particles once, first as a whole, then stage by
/// stage. Lack of memory is a fault of the timing, not an error.
Timing measure(const std::string& name, const Arrangement& arrangement, const MakeEngine& make);

/// Returns the least time of the step per particle: the sum of the rooflines of its stages, s.
double roofline_of_step(const StepSize& size, const Rates& rates);

/// Prints the times with the roofline of each stage: the larger of its least bytes over the bandwidth of a copy and its
/// flops over the rate of multiply-adds.
void print(const Timing& timing, const Rates& rates);
Json to_json(const Timing& timing, const Rates& rates);

}  // namespace whipple::device::check
