// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace whipple {

/// Returns the number of processors that this process may use, according to its affinity (taskset, Slurm, mpirun) and
/// the quota of its container.
int usable_processors();

/// Returns the number of threads set in the environment: OMP_NUM_THREADS, else SLURM_CPUS_PER_TASK; 0 if neither is
/// set. Values that are not numbers from 1 to 4096 are ignored with a warning.
int threads_of_environment();

/// Returns a text that identifies this machine and the processors that this process may use.
std::string processor_set();

/// Returns the memory of this machine, bytes.
double physical_memory();

}  // namespace whipple
