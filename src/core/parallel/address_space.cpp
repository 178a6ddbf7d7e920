// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/parallel/address_space.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include "src/core/base/resource_error.hpp"

namespace whipple::parallel {

void require_address_space(int threads) {
  // Open MPI 4.1 starts with 260 MB; each additional thread has a stack and a heap (8 and 64 MB).
  constexpr rlim_t megabyte = 1 << 20, of_mpi = 300, of_a_thread = 72;
  const rlim_t needed = of_mpi + of_a_thread * static_cast<rlim_t>(threads - 1);
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur >= needed * megabyte) return;
  throw ResourceError(fmt::format(
      "the address space of a process is limited to {} MB (ulimit -v); MPI and {} thread{} need {} MB",
      limit.rlim_cur / megabyte, threads, threads == 1 ? "" : "s", needed));
}

}  // namespace whipple::parallel
