// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace whipple {

/// Processors that this process may use: its affinity (taskset, Slurm, mpirun) and the quota of its
/// container.
int usable_processors();

/// Returns the number of threads that the environment asks for: OMP_NUM_THREADS, else SLURM_CPUS_PER_TASK; 0 if
/// neither is set. Ignores what is no number from 1 to 4096, with a warning.
int threads_of_environment();

/// Tells this machine and the processors that this process may use from others.
std::string processor_set();

/// Memory of this machine, bytes.
double physical_memory();

}  // namespace whipple
