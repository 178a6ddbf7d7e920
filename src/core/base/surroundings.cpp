// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/base/surroundings.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "src/core/base/resource_error.hpp"

namespace whipple {

void repair_surroundings() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0)
      static_cast<void>(::open("/dev/null", O_RDWR));  // uses the lowest free number
  }
  ::setenv("PATH", "/usr/local/bin:/usr/bin:/bin", 0);
}

void require_room_for_mpi() {
  constexpr rlim_t enough_files = 1024, least_files = 64, least_stack = 256 << 10;  // bytes
  rlimit files = {};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur < enough_files) {
    files.rlim_cur = std::min(files.rlim_max, enough_files);
    ::setrlimit(RLIMIT_NOFILE, &files);
    if (files.rlim_cur < least_files) {
      throw ResourceError(fmt::format("a process may open {} files only (ulimit -n): MPI and a run need {}",
                                      files.rlim_cur, least_files));
    }
  }
  rlimit stack = {};
  if (::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < least_stack) {
    throw ResourceError(
        fmt::format("the stack of a process is limited to {} kB (ulimit -s): {} kB are needed",
                    stack.rlim_cur >> 10U, least_stack >> 10U));
  }
}

void require_room_for_mpirun() {
  constexpr rlim_t least_file = 64 << 20;  // bytes: the shared memory of ranks is a file
  rlimit size = {};
  if (::getrlimit(RLIMIT_FSIZE, &size) == 0 && size.rlim_cur < least_file) {
    throw ResourceError(fmt::format("files are limited to {} kB (ulimit -f): ranks need {} kB",
                                    size.rlim_cur >> 10U, least_file >> 10U));
  }
}

void let_mpi_start_alone() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr) return;
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  // Isolated processes share one session directory: one that ends removes it while another begins, which aborts. A
  // process without peers needs none.
  ::setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
}

}  // namespace whipple
