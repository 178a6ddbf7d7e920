// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/process/mpirun.hpp"

#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <string_view>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/machine.hpp"
#include "src/core/base/resource_error.hpp"
#include "src/core/base/surroundings.hpp"
#include "src/core/process/paths.hpp"

namespace whipple::process {

namespace {

/// Returns the command prefix that ends a program with its parent, even if that is killed: the kernel sends the signal.
std::vector<std::string> ends_with_its_parent(const char* signal) {
  return {"setpriv", "--pdeathsig", signal};
}

void append(std::vector<std::string>& list, const std::vector<std::string>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

}  // namespace

int mpirun(int ranks, const std::vector<std::string>& program, const Environment& environment,
           double patience_with_end) {
  // Thousands of processes would block a machine before any of them has started.
  constexpr int always_allowed = 16;
  const int processors = usable_processors(), most = std::max(always_allowed, 4 * processors);
  if (ranks > most) {
    throw InputError(
        fmt::format("{} ranks on a machine whose {} processors this process may use: at most {}; "
                    "on several machines start them by mpirun {} ...",
                    ranks, processors, most, program.front()));
  }
  require_room_for_mpi();
  require_room_for_mpirun();
  // mpirun passes SIGUSR2 on and waits, whereupon a run saves its state; after SIGTERM and SIGINT it kills its ranks
  // within a second. Ranks do not survive mpirun.
  std::vector<std::string> arguments = ends_with_its_parent("USR2");
  append(arguments, {"mpirun", "-np", std::to_string(ranks)});
  // The program reports its errors; mpirun would add a page about the exit code.
  if (log::level() != log::Level::verbose) arguments.emplace_back("--quiet");
  append(arguments, ends_with_its_parent("KILL"));
  arguments.push_back(find_executable(program.front()).string());
  arguments.insert(arguments.end(), program.begin() + 1, program.end());
  Environment all = environment;
  // A waiting rank yields its core.
  all.emplace_back("OMPI_MCA_rmaps_base_oversubscribe", "1");
  all.emplace_back("OMPI_MCA_mpi_yield_when_idle", "1");
  all.emplace_back("OMPI_MCA_hwloc_base_binding_policy", "none");
  if (geteuid() == 0) {  // Open MPI refuses to run as root, as in containers, unless both are set
    all.emplace_back("OMPI_ALLOW_RUN_AS_ROOT", "1");
    all.emplace_back("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  log::detail("{}", fmt::join(arguments, " "));
  const int code = run_process(arguments, all,
                               {.end_signal = SIGUSR2,
                                .may_be_killed = true,
                                .patience = 10.0,
                                .patience_with_end = patience_with_end});
  if (const int signal = last_signal(); code > 128 && (signal == SIGINT || signal == SIGTERM))
    return 128 + signal;
  // A killed rank cannot report it, and mpirun --quiet does not.
  if (const int signal = code - 128;
      std::ranges::count(std::array{SIGKILL, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}, signal) > 0) {
    fmt::print(stderr,
               "{}: error: a rank or mpirun was ended by signal {} ({}), and the others with it; a run goes "
               "on from its "
               "last checkpoint with --restart, a plan by the same call\n",
               program.front(), signal, strsignal(signal));
  }
  // Programs of the project use the codes up to 4, mpirun uses others if it cannot start them.
  constexpr int greatest_own = 4, out_of_time = 124, greatest_signal = 64;
  const bool known = code == 0 || (code >= 2 && code <= greatest_own) || code == out_of_time ||
                     (code > 128 && code <= 128 + greatest_signal);
  if (!known) {
    throw ResourceError(fmt::format("mpirun ended with code {}: it could not start or keep the ranks", code));
  }
  return code;
}

int run_alone(const std::vector<std::string>& program, const Environment& environment) {
  std::vector<std::string> arguments = {"env"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view entry(*variable);
    const std::string_view name = entry.substr(0, entry.find('='));
    // Set by Open MPI and its runtime for the ranks of a program.
    if (name.starts_with("OMPI_") || name.starts_with("PMIX_") || name.starts_with("ORTE_") ||
        name.starts_with("PRTE_")) {
      arguments.insert(arguments.end(), {"-u", std::string(name)});
    }
  }
  arguments.push_back(find_executable(program.front()).string());
  arguments.insert(arguments.end(), program.begin() + 1, program.end());
  log::detail("{}", fmt::join(arguments, " "));
  return run_process(arguments, environment);
}

}  // namespace whipple::process
