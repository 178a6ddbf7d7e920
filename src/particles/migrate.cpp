// SPDX-License-Identifier: BSD-3-Clause
#include "src/particles/migrate.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "src/core/parallel/mpi.hpp"
#include "src/particles/rows.hpp"

namespace whipple {
namespace {

/// Describes how the arrays close gaps of departing particles and open for arriving ones: remaining particles within
/// the new range of their body keep their position, so that the cost is proportional to the number of moves.
struct Rearrangement {
  std::vector<std::uint32_t> from, to;  // of remaining particles that change position
  std::vector<std::uint32_t> places;    // of the arriving particles
  std::size_t size = 0;
};

/// Plans the rearrangement.
/// @param body       of the particles, ascending
/// @param newcomers  bodies of the arriving particles
template <class Leaves>
Rearrangement rearrange(std::span<const std::uint32_t> body, Leaves&& leaves,
                        std::span<const std::uint32_t> newcomers) {
  std::uint32_t bodies = body.empty() ? 0 : body.back() + 1;
  for (const std::uint32_t b : newcomers) bodies = std::max(bodies, b + 1);
  std::vector<std::uint32_t> begin(bodies + 1, 0);
  for (std::uint32_t p = 0; p < body.size(); ++p) {
    if (!leaves(p)) ++begin[body[p] + 1];
  }
  for (const std::uint32_t b : newcomers) ++begin[b + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());

  Rearrangement result;
  result.size = begin.back();
  std::vector<bool> taken(result.size, false);
  for (std::uint32_t p = 0; p < body.size(); ++p) {
    if (leaves(p)) continue;
    if (begin[body[p]] <= p && p < begin[body[p] + 1]) {
      taken[p] = true;
    } else {
      result.from.push_back(p);
    }
  }
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  const auto free_place = [&](std::uint32_t b) {
    while (taken[next[b]]) ++next[b];
    return next[b]++;
  };
  for (const std::uint32_t p : result.from) result.to.push_back(free_place(body[p]));
  for (const std::uint32_t b : newcomers) result.places.push_back(free_place(b));
  return result;
}

/// Resizes with spare capacity: counts fluctuate, and reallocating everything costs more than the move.
template <class Value>
void resize_with_room(std::vector<Value>& values, std::size_t size) {
  if (size > values.capacity()) values.reserve(size + size / 16);
  values.resize(size);
}

}  // namespace

bool migrate(Particles& particles, std::span<const int> destination, MPI_Comm communicator) {
  const int own = parallel::rank(communicator);
  const std::size_t before = particles.size();
  std::vector<std::vector<std::uint32_t>> leaving(static_cast<std::size_t>(parallel::size(communicator)));
  bool any_leave = false;
  for (std::uint32_t p = 0; p < before; ++p) {
    if (destination[p] == own) continue;
    leaving[static_cast<std::size_t>(destination[p])].push_back(p);
    any_leave = true;
  }
  if (!parallel::any(communicator, any_leave)) return false;

  std::vector<std::uint32_t> newcomers;
  append_rows(newcomers, send_rows(particles.body, leaving, communicator));
  const Rearrangement change =
      rearrange(particles.body, [&](std::uint32_t p) { return destination[p] != own; }, newcomers);
  for_each_field(particles, [&](const auto& field) {
    auto& values = field.of(particles);
    std::decay_t<decltype(values)> moved, arrived;
    append_rows(arrived, send_rows(values, leaving, communicator));
    // Optional fields are empty on all ranks; a rank without particles infers the fields in use from arriving ones.
    if (values.size() < before || (before == 0 && arrived.empty())) return;
    for (const std::uint32_t p : change.from) moved.push_back(values[p]);
    resize_with_room(values, change.size);
    for (std::size_t i = 0; i < moved.size(); ++i) values[change.to[i]] = moved[i];
    for (std::size_t i = 0; i < arrived.size(); ++i) values[change.places[i]] = arrived[i];
  });
  return true;
}

}  // namespace whipple
