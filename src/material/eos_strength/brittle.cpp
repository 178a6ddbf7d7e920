// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/brittle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "src/material/eos_strength/parts.hpp"
#include "src/material/principal.hpp"

namespace whipple::material::parts {
namespace {

constexpr double greatest_bulking = 2.0;  ///< maximum distension of bulked material

/// Computes the pressure that the material would have if it filled its voids as well.
void fill_gaps(const Chunk& chunk, Lanes& pressure) {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double modulus = chunk.density[k] * chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k];
    pressure[k] = chunk.pressure[k] - modulus * chunk.void_volume[k] / chunk.volume[k];
  }
}

/// Computes the equivalent strain rate sqrt(2/3 e:e), e the deviator of the strain rate.
void equivalent_rate(const Step& step, const Chunk& chunk, Lanes& rate) {
  const SymmetricLanes& e = chunk.motion.strain;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double mean = (e[0][k] + e[1][k] + e[2][k]) / 3.0;
    const double x = e[0][k] - mean, y = e[1][k] - mean, z = e[2][k] - mean;
    const double shear = e[3][k] * e[3][k] + e[4][k] * e[4][k] + e[5][k] * e[5][k];
    rate[k] = std::sqrt(2.0 / 3.0 * (x * x + y * y + z * z + 2.0 * shear)) / step.settings.time_step;
  }
}

/// Holds the deviators of a law that returns them in another direction than to zero.
struct Turned {
  std::array<SymmetricTensor, chunk_size> deviator;  // Pa
  Lanes work;                                        // plastic, J/m^3

  explicit Turned(const Chunk& chunk) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      deviator[k] = tensor(chunk.motion.deviator, k);
      work[k] = 0.0;
    }
  }
  /// Writes them back, books their work, and marks their equivalent stress as that of the trial: nothing is left to
  /// return along the deviator.
  void store(Chunk& chunk, Lanes& equivalent) const {
    SymmetricLanes& to = chunk.motion.deviator;
    for (std::size_t k = 0; k < chunk.size; ++k) {
      if (chunk.failed[k] != failure::intact) continue;
      const SymmetricTensor& s = deviator[k];
      to[0][k] = s.xx, to[1][k] = s.yy, to[2][k] = s.zz, to[3][k] = s.xy, to[4][k] = s.yz, to[5][k] = s.zx;
      chunk.report.plastic_work += work[k] * chunk.volume[k];
      equivalent[k] = chunk.motion.trial[k];
    }
  }
};

}  // namespace

void relax_brittle(const EosStrength& model, const Step& step, Chunk& chunk) {
  const strength::Brittle& law = *step.material.strength->brittle();
  const double grains = step.material.eos->initial_distension();
  Lanes& damage = chunk.history[model.damage];
  Lanes& distension = chunk.history[model.distension];
  Lanes pressure, rate, lode, compaction, crush, factor, equivalent, gained;
  fill_gaps(chunk, pressure);
  equivalent_rate(step, chunk, rate);
  chunk.fetch_threshold_factor(step.points, factor);
  std::fill_n(compaction.data(), chunk.size, 0.0);
  std::fill_n(crush.data(), chunk.size, std::numeric_limits<double>::infinity());
  if (grains > 1.0) {
    for (std::size_t k = 0; k < chunk.size; ++k) {
      compaction[k] = grains / distension[k] - grains / chunk.old_distension[k];
    }
    step.material.eos->crush_pressure(chunk.view(distension), chunk.view(crush));
  }
  if (law.needs_lode_angle()) {
    for (std::size_t k = 0; k < chunk.size; ++k) lode[k] = lode_cosine(tensor(chunk.motion.deviator, k));
  }
  for (std::size_t k = 0; k < chunk.size; ++k) {
    equivalent[k] = chunk.motion.trial[k];
    gained[k] = 0.0;
  }
  const double work_before = chunk.report.plastic_work;
  double recovered = 0.0;  // of the plastic work, as pressure, J
  std::optional<Turned> turned;
  if (law.turns_deviator()) turned.emplace(chunk);
  law.relax(
      {.bulk_modulus = step.material.reference_bulk_modulus,
       .pressure = chunk.view(pressure),
       .modulus = chunk.view(chunk.motion.modulus),
       .solid_fraction = chunk.view(chunk.solid_fraction),
       .trial = chunk.view(chunk.motion.trial),
       .rate = chunk.view(rate),
       .lode_cosine = std::span<const double>(lode.data(), law.needs_lode_angle() ? chunk.size : 0),
       .compaction = chunk.view(compaction),
       .crush_pressure = chunk.view(crush),
       .threshold_factor = chunk.view(factor),
       .equivalent = chunk.view(equivalent),
       .plastic_increment = chunk.view(chunk.increment),
       .plastic_strain = chunk.view(chunk.plastic_strain),
       .damage = chunk.view(damage),
       .least_pressure = chunk.view(chunk.least_pressure),
       .bulking_pressure = chunk.view(gained),
       .deviator = turned ? std::span(turned->deviator.data(), chunk.size) : std::span<SymmetricTensor>(),
       .work = turned ? chunk.view(turned->work) : std::span<double>(),
       .dilation = std::span<const double>(chunk.dilation.data(), turned && law.dilates() ? chunk.size : 0),
       .distension = std::span<const double>(distension.data(), law.dilates() ? chunk.size : 0)});
  if (turned) turned->store(chunk, equivalent);
  for (std::size_t k = 0; k < chunk.size; ++k) {
    if (chunk.failed[k] != failure::intact) continue;
    if (equivalent[k] < chunk.motion.trial[k]) {
      chunk.report.plastic_work += equivalent[k] * chunk.increment[k] * chunk.volume[k];
      for (Lanes& lane : chunk.motion.deviator) lane[k] *= equivalent[k] / chunk.motion.trial[k];
    }
    if (gained[k] > 0.0) {  // (13): 1/alpha decreases by the gain over K1
      const double closeness = 1.0 / distension[k] - gained[k] / step.material.reference_bulk_modulus;
      const double before = distension[k];
      chunk.report.limited_bulking += closeness <= 1.0 / greatest_bulking ? 1 : 0;
      distension[k] = std::min(greatest_bulking, 1.0 / std::max(closeness, 1.0 / greatest_bulking));
      const double mean = chunk.acting_pressure[k] + 0.5 * gained[k];
      recovered += mean * std::log(distension[k] / before) * chunk.volume[k];
      chunk.acting_pressure[k] += gained[k];
    }
  }
  chunk.dissipate(chunk.report.plastic_work - work_before);
  chunk.report.plastic_heat -= recovered;
}

}  // namespace whipple::material::parts
