// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple::parallel {

/// Checks that MPI and threads can start: without enough memory they terminate the process uncontrollably, for example
/// by segmentation faults.
/// @throws ResourceError if the limit of the address space of a process (ulimit -v) is too small
void require_address_space(int threads);

}  // namespace whipple::parallel
