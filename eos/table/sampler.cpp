// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/sampler.hpp"

#include <algorithm>
#include <cmath>

namespace whipple::eos::table {
namespace {

constexpr double edge_tolerance = 4e-13;  ///< of z
/// Relative jump of the heat capacity within one phase above which it is treated as an edge.
constexpr double least_jump = 2e-3;

}  // namespace

Sampler::Sampler(const EquationOfState& eos, double thermal_energy, const TableRequest& request, int scan)
    : eos_(eos),
      reference_sound_speed_(eos.state(eos.reference_density(), eos.reference_energy()).sound_speed),
      thermal_energy_(thermal_energy),
      least_temperature_(request.least_temperature),
      greatest_temperature_(request.greatest_temperature),
      scan_(scan) {}

double Sampler::base_energy(double x) const {
  return eos_.state_at_temperature(std::exp(x), least_temperature_).specific_internal_energy -
         thermal_energy_;
}

State Sampler::state(double x, double e) const { return eos_.state(std::exp(x), e); }

Sampler::Probe Sampler::probe(double x, double base, double z) const {
  const State s = state(x, base + std::exp(z));
  return {z, s.phase, s.heat_capacity, s.sound_speed};
}

void Sampler::find_edges(double x, double base, const Probe& low, const Probe& high, Isochore& result) const {
  if (low.phase == high.phase) return;
  const double z = 0.5 * (low.z + high.z);
  if (high.z - low.z < edge_tolerance) {
    result.edges.push_back(z);
    result.phases.push_back(high.phase);
    return;
  }
  const Probe middle = probe(x, base, z);
  find_edges(x, base, low, middle, result);
  find_edges(x, base, middle, high, result);
}

void Sampler::find_jump(double x, double base, Probe low, Probe high, Isochore& result) const {
  while (high.z - low.z >= edge_tolerance) {
    const Probe middle = probe(x, base, 0.5 * (low.z + high.z));
    const bool lower = std::abs(middle.heat_capacity - low.heat_capacity) >
                       std::abs(high.heat_capacity - middle.heat_capacity);
    (lower ? high : low) = middle;
  }
  if (std::abs(high.heat_capacity - low.heat_capacity) < least_jump * low.heat_capacity) return;
  result.edges.push_back(0.5 * (low.z + high.z));
  result.phases.push_back(high.phase);
}

Isochore Sampler::isochore(double x) const {
  Isochore result;
  result.base_energy = base_energy(x);
  const double bottom = std::log(thermal_energy_);
  result.top =
      std::log(eos_.state_at_temperature(std::exp(x), greatest_temperature_).specific_internal_energy -
               result.base_energy);
  std::vector<Probe> probes;
  for (int i = 0; i <= scan_; ++i)
    probes.push_back(probe(x, result.base_energy, bottom + (result.top - bottom) * i / scan_));
  result.phases.push_back(probes[0].phase);
  result.least_sound_speed = std::ranges::min(probes, {}, &Probe::sound_speed).sound_speed;
  for (std::size_t i = 1; i < probes.size(); ++i) {
    const Probe &low = probes[i - 1], &high = probes[i];
    find_edges(x, result.base_energy, low, high, result);
    const bool alone = i < 2 || i + 1 >= probes.size() || probes[i - 2].phase != probes[i + 1].phase;
    if (alone || low.phase != high.phase) continue;
    // Where the heat capacity is smooth, its differences are close to the adjacent ones.
    const double before = low.heat_capacity - probes[i - 2].heat_capacity,
                 after = probes[i + 1].heat_capacity - high.heat_capacity;
    const double excess = high.heat_capacity - low.heat_capacity - 0.5 * (before + after);
    if (std::abs(excess) > 0.25 * least_jump * low.heat_capacity)
      find_jump(x, result.base_energy, low, high, result);
  }
  return result;
}

}  // namespace whipple::eos::table
