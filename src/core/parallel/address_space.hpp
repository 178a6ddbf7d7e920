// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple::parallel {

/// Checks that MPI and threads can start: they end a process in ways of their own, segmentation faults among them,
/// when they find no room.
/// @throws ResourceError if the limit of the address space of a process (ulimit -v) leaves none
void require_address_space(int threads);

}  // namespace whipple::parallel
