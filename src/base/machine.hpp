// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace whipple {

/// Memory of this machine, bytes.
double physical_memory();

}  // namespace whipple
