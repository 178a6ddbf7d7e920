// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/material/eos_strength/parts.hpp"

namespace whipple::material::parts {
namespace {

/// Returns the components of the deviator or the strain of the points of a chunk.
failure::Components<const double> view(const Chunk& chunk, const Lanes* lanes) {
  failure::Components<const double> components;
  for (std::size_t j = 0; j < 6; ++j) components.lane[j] = std::span(lanes[j].data(), chunk.size);
  return components;
}

/// Evaluates the criteria.
/// @param strain  its components, or none
void mark(const EosStrength& model, const Step& step, Chunk& chunk,
          const failure::Components<const double>& strain) {
  // Brittle material bears no more tension than that at which its gaps open, which they do after this.
  Lanes bounded;
  const bool brittle = step.material.strength->brittle() != nullptr;
  for (std::size_t k = 0; brittle && k < chunk.size; ++k)
    bounded[k] = std::max(chunk.acting_pressure[k], chunk.least_pressure[k]);
  const failure::State state = {.time_step = step.settings.time_step,
                                .pressure = chunk.view(brittle ? bounded : chunk.acting_pressure),
                                .temperature = chunk.view(chunk.temperature),
                                .density = chunk.view(chunk.density),
                                .bulk_modulus = chunk.view(chunk.bulk_modulus),
                                .shear_modulus = chunk.view(chunk.solid_modulus),
                                .volume = chunk.view(chunk.whole_volume),
                                .band = chunk.view(chunk.band),
                                .plastic_strain = chunk.view(chunk.plastic_strain),
                                .plastic_increment = chunk.view(chunk.increment),
                                .melted_fraction = chunk.view(chunk.melted),
                                .threshold_factor = chunk.view(chunk.threshold_factor),
                                .deviator = view(chunk, chunk.motion.deviator.data()),
                                .strain = strain};
  for (const auto& criterion : step.material.failure) {
    criterion->mark(state, chunk.view(chunk.history[model.damage]), chunk.view(chunk.failed));
  }
  const std::array<std::uint8_t, chunk_size>& before = chunk.old_failed;
  if (std::equal(chunk.failed.begin(), chunk.failed.begin() + chunk.size, before.begin())) return;
  chunk.find_failed();
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const bool fails = chunk.failed[k] != before[k] && chunk.failed[k] != failure::intact;
    chunk.report.failed[chunk.failed[k]] += fails ? 1 : 0;
  }
  chunk.codes_changed = true;
}

}  // namespace

void prepare_failure(const EosStrength&, const Step& in, Chunk& out) {
  out.fetch_threshold_factor(in.points, out.threshold_factor);
  out.old_failed = out.failed;
  for (std::size_t k = 0; k < out.size; ++k) {
    out.whole_volume[k] = out.volume[k] + out.void_volume[k];
    out.band[k] = in.settings.lengths.empty() ? in.settings.cell_size : in.settings.lengths[out.index[k]];
    out.bulk_modulus[k] = out.density[k] * out.bulk_sound_speed[k] * out.bulk_sound_speed[k];
  }
}

void heal(const EosStrength& model, const Step& in, Chunk& out) {
  if (!out.any_failed) return;
  Lanes& damage = out.history[model.damage];
  for (const auto& criterion : in.material.failure) {
    const failure::Code code = criterion->healing_code();
    if (code == failure::intact) continue;
    for (std::size_t k = 0; k < out.size; ++k) {
      if (out.failed[k] != code || out.void_volume[k] > 0.0 || !(out.pressure[k] > 0.0)) continue;
      out.failed[k] = failure::intact;  // the deviator starts from zero
      if (criterion->accumulates()) damage[k] = 0.0;
    }
  }
}

void grow_voids(const EosStrength& model, const Step& in, Chunk& out) {
  // Flow stress at the end of the step, without voids
  const failure::Criterion& criterion = *in.material.void_growth;
  const double dt = in.settings.time_step;
  Lanes rate, flow, equivalent, before;
  if (criterion.returns_deviator()) {
    for (std::size_t k = 0; k < out.size; ++k) rate[k] = out.increment[k] / dt;
    in.material.strength->flow_stress(out.strength_state(out.density, model.threshold_stress), out.view(rate),
                                      out.view(flow));
    for (std::size_t k = 0; k < out.size; ++k) {
      flow[k] *= shear_bearing_fraction(out.melted[k], out.vaporised[k]);
      before[k] = equivalent[k] = std::sqrt(1.5 * tensor(out.motion.deviator, k).squared_norm());
    }
  }
  criterion.grow_voids({dt, out.view(out.bulk_modulus), out.view(out.motion.modulus), out.view(out.melted),
                        out.view(flow), out.view(out.motion.trial), out.view(out.threshold_factor),
                        out.view(equivalent), out.view(out.acting_pressure), out.view(out.increment),
                        out.view(out.plastic_strain), out.view(out.volume), out.view(out.void_volume)},
                       out.view(out.history[model.damage]), out.view(out.failed));
  if (criterion.returns_deviator()) {
    for (std::size_t k = 0; k < out.size; ++k) {
      if (equivalent[k] == before[k] || !(before[k] > 0.0)) continue;
      const double lost = before[k] * before[k] - equivalent[k] * equivalent[k];  // of q^2
      if (out.motion.modulus[k] > 0.0) out.dissipate(lost / (6.0 * out.motion.modulus[k]) * out.volume[k]);
      for (Lanes& lane : out.motion.deviator) lane[k] *= equivalent[k] / before[k];
    }
  }
  out.any_void |= any_positive(out.void_volume, out.size);
}

void mark_failed(const EosStrength& model, const Step& in, Chunk& out) { mark(model, in, out, {}); }

void mark_failed_by_strain(const EosStrength& model, const Step& in, Chunk& out) {
  mark(model, in, out, view(out, &out.history[model.strain]));
}

void keep_fragment_size(const EosStrength& model, const Step&, Chunk& out) {
  if (!out.codes_changed) return;
  Lanes& size = out.history[model.fragment_size];
  for (std::size_t k = 0; k < out.size; ++k) {
    if (out.failed[k] == out.old_failed[k]) continue;
    const bool fails = out.failed[k] != failure::intact;
    size[k] = fails ? model.fragments->size_of(out.density[k], out.melted[k], out.motion.divergence[k]) : 0.0;
  }
}

}  // namespace whipple::material::parts
