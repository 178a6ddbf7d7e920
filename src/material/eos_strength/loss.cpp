// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>

#include "src/core/base/simd.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/material/eos_strength/parts.hpp"
#include "src/material/loss_formulas.hpp"

namespace whipple::material::parts {
namespace {

using formulas::least_sound_speed_ratio;
using formulas::Opening;
using Four = whipple::Lanes;  // points at a time

/// Reduces stress and energy of points that have failed, melt, or contain opening cracks or voids; sets `kept` to the
/// fraction of the deviator that they retain.
/// @param squared  squares of the sound speed
template <Opening kind, bool viscous>
inline void lose_strength(const EosStrength& model, Chunk& chunk, const Lanes& bulk, double least_sound_speed,
                          Lanes& squared) {
  const double least_squared = least_sound_speed * least_sound_speed;
  const Lanes& damages = chunk.history[model.damage];
  for (std::size_t k = 0; k < chunk.size; k += 4) {
    const auto of = [k](const Lanes& lanes) { return load(&lanes[k]); };
    const formulas::SolidPoint<Four> before = {
        .porous = {of(chunk.acting_pressure), of(chunk.volume), of(chunk.void_volume)},
        .density = of(chunk.density),
        .melted = of(chunk.melted),
        .vaporised = of(chunk.vaporised),
        .damage = kind == Opening::damage ? of(damages) : Four{},
        .least_pressure = kind == Opening::tension ? of(chunk.least_pressure) : Four{},
        .solid_before = of(chunk.solid_fraction),
        .solid_modulus = of(chunk.solid_modulus),
        .bulk = of(bulk),
        .viscosity = of(chunk.artificial_viscosity),
        .failed = of(chunk.intact) == 0.0};
    const formulas::LoosePoint<Four> after = formulas::lose_strength<kind, viscous>(before, least_squared);
    const unsigned valid = (1U << std::min<std::size_t>(chunk.size - k, 4)) - 1U;
    chunk.report.limited_void_steps += static_cast<std::size_t>(std::popcount(bits(after.limited) & valid));
    store(&chunk.acting_pressure[k], after.porous.pressure);
    store(&chunk.volume[k], after.porous.volume);
    store(&chunk.void_volume[k], after.porous.void_volume);
    store(&chunk.artificial_viscosity[k], after.viscosity);
    store(&squared[k], after.squared_sound_speed);
    store(&chunk.kept[k], after.kept);
  }
}

void scale(std::span<Lanes, 6> tensors, const Chunk& chunk) {
  for (Lanes& lane : tensors) {
    for (std::size_t k = 0; k < chunk.size; ++k) lane[k] *= chunk.kept[k];
  }
}

/// Returns the elastic energy of the deviator (J) that points lose with their strength.
double lost_energy(const Chunk& chunk) {
  double sum = 0.0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double lost = 1.0 - chunk.kept[k] * chunk.kept[k], modulus = chunk.motion.modulus[k];
    const double energy =
        tensor(chunk.motion.deviator, k).squared_norm() / (4.0 * (modulus > 0.0 ? modulus : 1.0));
    sum += modulus > 0.0 ? lost * energy * chunk.volume[k] : 0.0;
  }
  return sum;
}

/// Returns what of it is heat (J): a part w of the modulus that is left keeps the part w of the energy, as the stress is
/// that of its part of the material. Not inlined, so that the kernels around it keep their last digits.
[[gnu::noinline]] double lost_heat(const Chunk& chunk) {
  double sum = 0.0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double modulus = chunk.motion.modulus[k];
    if (!(chunk.kept[k] < 1.0 && modulus > 0.0)) continue;
    const double energy = tensor(chunk.motion.deviator, k).squared_norm() / (4.0 * modulus);
    sum += (1.0 - chunk.kept[k]) * energy * chunk.volume[k];
  }
  return sum;
}

/// Computes the sound speed, and the loss of strength where points may lose it.
template <Opening kind, bool viscous>
inline void lose(const EosStrength& model, const Step& step, Chunk& chunk) {
  const double least_sound_speed = least_sound_speed_ratio * step.material.reference.sound_speed;
  Lanes bulk, squared;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    bulk[k] = std::max(chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k],
                       least_sound_speed * least_sound_speed);
    squared[k] = bulk[k] + 4.0 / 3.0 * chunk.solid_modulus[k] / chunk.density[k];
  }
  // On melting or cracking the stress is scaled with the remaining fraction; freezing material has no stress.
  chunk.loses = kind != Opening::none || chunk.any_failed || any_positive(chunk.melted, chunk.size);
  if (chunk.loses) {
    lose_strength<kind, viscous>(model, chunk, bulk, least_sound_speed, squared);
    chunk.report.dissipation += lost_energy(chunk);
    chunk.report.plastic_heat += lost_heat(chunk);
    scale(chunk.motion.deviator, chunk);
    chunk.any_void = true;
  }
  for (std::size_t k = 0; k < chunk.size; ++k) chunk.sound_speed[k] = std::sqrt(squared[k]);
}

}  // namespace

WHIPPLE_KERNEL void lose_in_failed(const EosStrength& model, const Step& in, Chunk& out) {
  lose<Opening::none, false>(model, in, out);
}

WHIPPLE_KERNEL void lose_in_damaged(const EosStrength& model, const Step& in, Chunk& out) {
  lose<Opening::damage, false>(model, in, out);
}

WHIPPLE_KERNEL void lose_in_brittle(const EosStrength& model, const Step& in, Chunk& out) {
  lose<Opening::tension, false>(model, in, out);
}

WHIPPLE_KERNEL void lose_in_viscous(const EosStrength& model, const Step& in, Chunk& out) {
  lose<Opening::none, true>(model, in, out);
}

WHIPPLE_KERNEL void lose_in_damaged_viscous(const EosStrength& model, const Step& in, Chunk& out) {
  lose<Opening::damage, true>(model, in, out);
}

void lose_back_stress(const EosStrength& model, const Step&, Chunk& out) {
  if (out.loses) scale(out.field<6>(model.back_stress), out);
}

void release_cold_work(const EosStrength& model, const Step& in, Chunk& out) {
  Lanes& stored = out.history[model.stored_cold_work];
  for (std::size_t k = 0; k < out.size; ++k) {
    const std::size_t p = out.index[k];
    const double solid_before =
        shear_bearing_fraction(in.points.melted_fraction[p], in.points.vaporised_fraction[p]);
    const double solid = shear_bearing_fraction(out.melted[k], out.vaporised[k]);
    if (!(solid < solid_before)) continue;
    const double left = stored[k] * (solid / solid_before);
    out.report.plastic_heat += (stored[k] - left) * out.mass[k];
    stored[k] = left;
  }
}

}  // namespace whipple::material::parts
