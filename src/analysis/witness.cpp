// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/witness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "src/analysis/cloud.hpp"
#include "src/analysis/measures.hpp"

namespace whipple::analysis {
namespace {

/// Mass, axial momentum, kinetic energy.
using Load = std::array<double, 3>;

struct Hit {
  double radius, time;
  Load load;
};

}  // namespace

Witness witness_plate(const Snapshot& snapshot, const Frame& frame, const WitnessOptions& options) {
  std::vector<Hit> hits;
  double widest = 0.0, first = 0.0, last = 0.0;
  Load total{};
  for (const std::uint32_t i : debris(snapshot, frame)) {
    const double v = frame.axial(snapshot.velocity[i]);
    const double flight = (options.position - frame.axial(snapshot.position[i])) / v;
    const double m = frame.copies() * snapshot.mass[i];
    const Hit hit{frame.radius(snapshot.position[i] + flight * snapshot.velocity[i]),
                  snapshot.time + flight,
                  {m, m * v, 0.5 * m * snapshot.velocity[i].squaredNorm()}};
    first = hits.empty() ? hit.time : std::min(first, hit.time);
    last = hits.empty() ? hit.time : std::max(last, hit.time);
    widest = std::max(widest, hit.radius);
    for (std::size_t k = 0; k < 3; ++k) total[k] += hit.load[k];
    hits.push_back(hit);
  }
  Witness witness;
  witness.rings = {.name = "witness_rings",
                   .meaning = "loads on the witness plate by distance from the axis",
                   .label = {},
                   .labels = {},
                   .columns = {}};
  witness.flux = {.name = "witness_flux",
                  .meaning = "loads on the witness plate over time",
                  .label = {},
                  .labels = {},
                  .columns = {}};
  witness.totals = {measured("witness_mass", total[0]), measured("witness_momentum", total[1]),
                    measured("witness_energy", total[2]), measured("witness_first", hits.empty() ? nan : first),
                    measured("witness_last", hits.empty() ? nan : last)};
  if (hits.empty()) return witness;

  std::vector<Load> by_ring(static_cast<std::size_t>(widest / options.ring) + 1);
  const double interval = std::max((last - first) / options.times, 1e-12);
  std::vector<Load> by_time(static_cast<std::size_t>(options.times));
  for (const Hit& hit : hits) {
    Load& ring = by_ring[static_cast<std::size_t>(hit.radius / options.ring)];
    Load& time =
        by_time[std::min(static_cast<std::size_t>((hit.time - first) / interval), by_time.size() - 1)];
    for (std::size_t k = 0; k < 3; ++k) {
      ring[k] += hit.load[k];
      time[k] += hit.load[k];
    }
  }
  double inside = 0.0;
  for (std::size_t r = 0; r < by_ring.size(); ++r) {
    const double inner = static_cast<double>(r) * options.ring, outer = inner + options.ring;
    const double area = std::numbers::pi * (outer * outer - inner * inner);
    inside += by_ring[r][0];
    witness.rings.append({{"radius", "m", "middle of the ring", 0.5 * (inner + outer)},
                          {"mass_per_area", "kg/m^2", "mass per area", by_ring[r][0] / area},
                          {"momentum_per_area", "Pa s", "axial momentum per area", by_ring[r][1] / area},
                          {"energy_per_area", "J/m^2", "kinetic energy per area", by_ring[r][2] / area},
                          {"cumulative_mass", "kg", "mass within the outer radius", inside}});
  }
  for (std::size_t k = 0; k < by_time.size(); ++k) {
    witness.flux.append(
        {{"time", "s", "middle of the interval", first + (static_cast<double>(k) + 0.5) * interval},
         {"mass_flux", "kg/s", "mass per time", by_time[k][0] / interval},
         {"momentum_flux", "N", "axial momentum per time", by_time[k][1] / interval},
         {"energy_flux", "W", "kinetic energy per time", by_time[k][2] / interval}});
  }
  return witness;
}

}  // namespace whipple::analysis
