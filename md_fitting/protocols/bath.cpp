// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/bath.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "md_fitting/protocols/statistics.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

/// Damping time in time steps: one to two vibrations. With a longer one the energies of single vibrations fluctuate
/// too slowly for a short run to estimate its error; a shorter one only adds noise.
constexpr double damping_steps = 200.0;
/// Length of a window in time steps: one to two vibrations; at most a quarter of a short run.
constexpr std::int64_t window_steps = 160;

}  // namespace

void couple_to_bath(Lammps& lammps, double temperature, double time_step, std::int64_t seed) {
  lammps.command("fix bath all langevin {0:.17g} {0:.17g} {1:.17g} {2} zero yes", temperature,
                 damping_steps * time_step, seed);
}

std::vector<double> in_bath(std::span<const double> samples, double cold,
                            std::span<const double> temperatures, double temperature, std::int64_t interval) {
  if (samples.size() != temperatures.size()) throw InternalError("each sample needs its temperature");
  const double mean =
      std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
  const double slope = (mean - cold) / temperature;
  std::vector<double> result(samples.begin(), samples.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] -= slope * (temperatures[i] - temperature);
  return window_averages(result,
                         std::min(static_cast<std::size_t>(window_steps / interval), result.size() / 4));
}

}  // namespace whipple::md
