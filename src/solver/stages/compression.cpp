// SPDX-License-Identifier: BSD-3-Clause
// Compression rate of the material, which bounds the time step (docs/theory/mpm.md, section 6).
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/device/rates.hpp"
#include "src/solver/carriers/explosives.hpp"
#include "src/solver/device/device_stage.hpp"
#include "src/solver/stages/time_step.hpp"

namespace whipple::solver {
namespace {

/// Fraction of the mass that may be compressed faster than the time step resolves: a few particles trapped between
/// debris and a wall must not delay the entire run.
constexpr double free_share = 1e-3;

using Bins = device::RateBins;
using device::parts_of_mass;

}  // namespace

/// Returns a rate that at most the fraction `free_share` of the total mass exceeds, or one that does not bound the
/// next step.
/// @param largest  maximum over the particles of all ranks, 1/s
double TimeStep::compression_rate_of_most(double largest) const {
  if (!state_.keeps_losses()) return largest;
  const cases::TimeControl& control = state_.setup.time;
  const double harmless = control.compression_limit / (control.maximum_growth * state_.run.unclipped_step);
  if (largest <= harmless) return largest;
  if (state_.device != nullptr) return state_.device->rate_of_most(free_share, harmless, largest);
  const auto mass = std::make_unique<std::array<std::atomic<std::int64_t>, Bins::count>>();
  for (auto& bin : *mass) bin.store(0, std::memory_order_relaxed);
  const double per_mass = parts_of_mass / state_.totals.mass;
  const Explosives explosives(state_);
  parallel::for_each_chunk(state_.particles.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      if (explosives.is_at_front(p)) continue;  // as in find_compression_rate
      if (state_.particles.closing_rate[p] <= harmless || state_.particles.pressure[p] <= 0.0) continue;
      (*mass)[Bins::of(state_.particles.closing_rate[p])].fetch_add(
          std::llround(per_mass * state_.particles.mass[p]), std::memory_order_relaxed);
    }
  });
  std::array<double, Bins::count> of_all_ranks;
  for (std::size_t bin = 0; bin < Bins::count; ++bin) {
    of_all_ranks[bin] = static_cast<double>((*mass)[bin].load(std::memory_order_relaxed));
  }
  parallel::sum(state_.communicator, of_all_ranks);
  double faster = 0.0;
  for (std::size_t bin = Bins::count; bin-- > 0;) {
    faster += of_all_ranks[bin];
    if (faster > free_share * parts_of_mass) return std::min(largest, Bins::end(bin));
  }
  return harmless;
}

}  // namespace whipple::solver
