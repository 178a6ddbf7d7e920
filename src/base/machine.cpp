// SPDX-License-Identifier: BSD-3-Clause
#include "src/base/machine.hpp"

#include <unistd.h>

namespace whipple {

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace whipple
