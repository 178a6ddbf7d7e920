// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Limits of the machine, measured in the same call as the problems: speeds of the code are worth something
/// beside these only.
namespace whipple::bench {

struct MachineRates {
  double bandwidth = 0.0;         ///< bytes/s, triad a = b + s c over arrays far larger than the caches
  double arithmetic = 0.0;        ///< flop/s, fused multiply-adds of four doubles in registers
  double reference_kernel = 0.0;  ///< s per particle and step of a ReferenceKernel on every thread at a time
};

/// The rates of `threads` threads of this process together, best of several repetitions (about two seconds).
MachineRates measure_machine(int threads);

}  // namespace whipple::bench
