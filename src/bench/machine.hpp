// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Measures the limits of the machine in the same call as the problems: speeds of the code are meaningful only relative
/// to them.
namespace whipple::bench {

struct MachineRates {
  double bandwidth = 0.0;         ///< bytes/s, triad a = b + s c over arrays far larger than the caches
  double arithmetic = 0.0;        ///< flop/s, fused multiply-adds of four doubles in registers
  double reference_kernel = 0.0;  ///< s per particle and step of a ReferenceKernel on every thread at once
};

/// Measures the combined rates of `threads` threads of this process, best of several repetitions (about two seconds).
MachineRates measure_machine(int threads);

}  // namespace whipple::bench
