// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/migrate.hpp"

#include <cstdint>
#include <vector>

#include "src/parallel/mpi.hpp"
#include "src/particles/rows.hpp"

namespace whipple {

bool migrate(Particles& particles, std::span<const int> destination, MPI_Comm communicator) {
  const int own = parallel::rank(communicator);
  std::vector<std::uint32_t> staying;
  std::vector<std::vector<std::uint32_t>> leaving(static_cast<std::size_t>(parallel::size(communicator)));
  for (std::uint32_t p = 0; p < particles.size(); ++p) {
    (destination[p] == own ? staying : leaving[static_cast<std::size_t>(destination[p])]).push_back(p);
  }
  if (!parallel::any(communicator, staying.size() != particles.size())) return false;
  exchange_rows(particles, staying, leaving, communicator);
  sort_by_body(particles);
  return true;
}

}  // namespace whipple
