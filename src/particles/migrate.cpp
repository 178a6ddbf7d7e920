// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/migrate.hpp"

#include <algorithm>
#include <cstdint>

#include "src/parallel/mpi.hpp"

namespace whipple {

bool migrate(Particles& particles, std::span<const int> destination, MPI_Comm communicator) {
  const int own = parallel::rank(communicator);
  std::vector<std::uint32_t> staying;
  std::vector<std::vector<std::uint32_t>> leaving(static_cast<std::size_t>(parallel::size(communicator)));
  for (std::uint32_t p = 0; p < particles.size(); ++p) {
    (destination[p] == own ? staying : leaving[static_cast<std::size_t>(destination[p])]).push_back(p);
  }
  if (!parallel::any(communicator, staying.size() != particles.size())) return false;

  const std::size_t before = particles.size();
  for_each_field<Particles>([&](const auto& field) {
    auto& values = particles.*(field.values);
    using Value = typename std::decay_t<decltype(values)>::value_type;
    const bool in_use = values.size() == before;  // else an optional field that is empty on all ranks
    std::vector<std::vector<std::byte>> outgoing(leaving.size());
    for (std::size_t r = 0; in_use && r < leaving.size(); ++r) {
      outgoing[r].resize(leaving[r].size() * sizeof(Value));
      std::byte* to = outgoing[r].data();
      for (const std::uint32_t p : leaving[r]) {
        const auto* from = reinterpret_cast<const std::byte*>(&values[p]);
        to = std::copy(from, from + sizeof(Value), to);
      }
    }
    const auto incoming = parallel::exchange_bytes(communicator, outgoing);
    std::remove_reference_t<decltype(values)> now;
    now.reserve(staying.size());
    if (in_use) {
      for (const std::uint32_t p : staying) now.push_back(values[p]);
    }
    for (const std::vector<std::byte>& bytes : incoming) {
      const std::size_t first = now.size();
      now.resize(first + bytes.size() / sizeof(Value));
      std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::byte*>(now.data() + first));
    }
    values.swap(now);
  });

  sort_by_body(particles);
  return true;
}

}  // namespace whipple
