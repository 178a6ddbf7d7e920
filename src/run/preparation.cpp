// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "src/case/build/placement.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/machine.hpp"
#include "src/core/base/text.hpp"
#include "src/core/parallel/address_space.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::run {
namespace {

/// Counts the ranks that share the processors of this rank. Collective.
int ranks_beside(MPI_Comm communicator) {
  const std::size_t own = std::hash<std::string>{}(processor_set());
  const std::vector<std::vector<std::size_t>> mine(static_cast<std::size_t>(parallel::size(communicator)),
                                                   {own});
  const std::vector<std::vector<std::size_t>> all = parallel::exchange(communicator, mine);
  return static_cast<int>(std::ranges::count(all, std::vector{own}));
}

}  // namespace

void set_threads(int threads, MPI_Comm communicator) {
  const int share = std::max(1, usable_processors() / ranks_beside(communicator));
  if (threads <= 0) {  // the first rank reads the environment, and warns, for all
    threads = static_cast<int>(
        parallel::maximum(communicator, parallel::rank(communicator) == 0 ? threads_of_environment() : 0));
  }
  const int wanted = threads > 0 ? threads : share;
  parallel::require_address_space(wanted);
  parallel::set_threads(wanted);
}

void require_memory(const cases::Case& setup, MPI_Comm communicator) {
  const double needed = cases::expected_memory(setup);
  const double available = physical_memory() * parallel::size(communicator) /
                           static_cast<double>(parallel::ranks_on_machine(communicator));
  if (needed <= available) return;
  throw InputError(fmt::format(
      "{}: the particles of all bodies take up to {}, and there are {}: enlarge 'domain.cell_size' or reduce "
      "'per_cell', or take more machines",
      setup.file.string(), format_bytes(needed), format_bytes(available)));
}

void require_disk(const solver::Simulation& simulation, const io::RunDirectory& directory, int count,
                  const io::Ranks& ranks) {
  std::array<double, 1> bytes = {0.0};  // of the points, which a checkpoint holds
  for (const solver::Carrier* carrier : simulation.carriers())
    bytes[0] += static_cast<double>(carrier->bytes());
  parallel::sum(simulation.communicator(), bytes);
  ranks.on_root([&] { directory.require_free_space(static_cast<std::uint64_t>(count * bytes[0])); });
}

}  // namespace whipple::run
