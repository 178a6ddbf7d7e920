// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/hits.hpp"

#include <algorithm>
#include <limits>

#include "src/analysis/measures.hpp"

namespace whipple::analysis {
namespace {

struct Sum {
  double mass = 0.0, momentum = 0.0, energy = 0.0;
  void add(const Hit& hit) {
    mass += hit.mass;
    momentum += hit.momentum;
    energy += hit.energy;
  }
};

}  // namespace

Hit hit_of(const Frame& frame, const Vector3& place, double time, double mass, const Vector3& velocity) {
  const double m = frame.copies() * mass;
  return {frame.radius(place), time, m, m * frame.axial(velocity), 0.5 * m * velocity.squaredNorm()};
}

Loads tabulate(const std::vector<Hit>& hits, const Frame& frame, const std::string& name,
               const std::string& plane, double ring, int times) {
  Sum total;
  double widest = 0.0, first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Hit& hit : hits) {
    total.add(hit);
    widest = std::max(widest, hit.radius);
    first = std::min(first, hit.time);
    last = std::max(last, hit.time);
  }
  Loads loads;
  loads.rings = {.name = name + "_rings",
                 .meaning = "loads on " + plane + " by distance from the axis",
                 .label = {},
                 .labels = {},
                 .columns = {}};
  loads.flux = {.name = name + "_flux",
                .meaning = "loads on " + plane + " over time",
                .label = {},
                .labels = {},
                .columns = {}};
  loads.totals = {measured(name + "_mass", total.mass), measured(name + "_momentum", total.momentum),
                  measured(name + "_energy", total.energy),
                  measured(name + "_first", hits.empty() ? nan : first),
                  measured(name + "_last", hits.empty() ? nan : last)};
  if (hits.empty()) return loads;

  std::vector<Sum> by_ring(static_cast<std::size_t>(widest / ring) + 1);
  std::vector<Sum> by_time(static_cast<std::size_t>(times));
  const double interval = std::max((last - first) / times, 1e-12);
  for (const Hit& hit : hits) {
    by_ring[static_cast<std::size_t>(hit.radius / ring)].add(hit);
    by_time[std::min(static_cast<std::size_t>((hit.time - first) / interval), by_time.size() - 1)].add(hit);
  }
  double inside = 0.0;
  for (std::size_t r = 0; r < by_ring.size(); ++r) {
    const double inner = static_cast<double>(r) * ring, outer = inner + ring;
    const double area = frame.ring_area(inner, outer);
    const Sum& sum = by_ring[r];
    inside += sum.mass;
    loads.rings.append({{"radius", "m", "middle of the ring", 0.5 * (inner + outer)},
                        {"mass", "kg", "mass in the ring", sum.mass},
                        {"momentum", "kg m/s", "axial momentum in the ring", sum.momentum},
                        {"energy", "J", "kinetic energy in the ring", sum.energy},
                        {"mass_per_area", "kg/m^2", "mass per area", sum.mass / area},
                        {"momentum_per_area", "Pa s", "axial momentum per area", sum.momentum / area},
                        {"energy_per_area", "J/m^2", "kinetic energy per area", sum.energy / area},
                        {"cumulative_mass", "kg", "mass within the outer radius", inside}});
  }
  for (std::size_t k = 0; k < by_time.size(); ++k) {
    loads.flux.append(
        {{"time", "s", "middle of the interval", first + (static_cast<double>(k) + 0.5) * interval},
         {"mass_flux", "kg/s", "mass per time", by_time[k].mass / interval},
         {"momentum_flux", "N", "axial momentum per time", by_time[k].momentum / interval},
         {"energy_flux", "W", "kinetic energy per time", by_time[k].energy / interval}});
  }
  return loads;
}

}  // namespace whipple::analysis
