// SPDX-License-Identifier: BSD-3-Clause
// Programmed burn (docs/theory/burn.md).
#include <algorithm>

#include "src/core/base/vector_math.hpp"
#include "src/material/eos_strength/parts.hpp"

namespace whipple::material::parts {
namespace {

constexpr double burnt = 0.999;  ///< burn fraction from which on nothing is left

/// Returns the burn fraction by the time since the lighting of a point.
/// @param lighting  s; negative: never
/// @param rate      1/s
double burnt_since(double lighting, double time, double rate) {
  return lighting >= 0.0 ? std::clamp((time - lighting) * rate, 0.0, 1.0) : 0.0;
}

}  // namespace

WHIPPLE_KERNEL void burn(const EosStrength& model, const Step& in, Chunk& out) {
  const Explosive& explosive = model.burn->explosive();
  const BurnSettings& settings = in.settings.burn;
  const double rate = explosive.detonation_velocity / settings.width, time = in.settings.time;
  const double early = settings.early / explosive.detonation_velocity;
  const double per_compression = 1.0 / (1.0 - explosive.chapman_jouguet_volume);
  const bool by_volume = settings.mode != BurnMode::time, gated = settings.mode == BurnMode::both;
  const Lanes& lighting = out.history[model.lighting_time];
  Lanes& fraction = out.history[model.burn_fraction];
  double at_front = 0.0;
  for (std::size_t k = 0; k < out.size; ++k) {
    const bool lit = lighting[k] >= 0.0, near = lit && time > lighting[k] - early;
    const double of_time = burnt_since(lighting[k], time, rate);
    const double compression =
        std::clamp((1.0 - explosive.density / out.density[k]) * per_compression, 0.0, 1.0);
    const double of_volume = by_volume && (near || !gated) ? compression : 0.0;
    const double now = std::max({fraction[k], of_time, of_volume});
    fraction[k] = now > burnt ? 1.0 : now;
    out.burning[k] = now <= burnt && (now > 0.0 || near) ? 1.0 : 0.0;
    at_front += out.burning[k];
  }
  out.burns = at_front > 0.0;
}

void react(const EosStrength& model, const Step& in, Chunk& out) {
  const Explosive& explosive = model.burn->explosive();
  const double rate = explosive.detonation_velocity / in.settings.burn.width;
  const Lanes& lighting = out.history[model.lighting_time];
  Lanes& fraction = out.history[model.burn_fraction];
  Lanes compression;
  for (std::size_t k = 0; k < out.size; ++k) compression[k] = out.density[k] / explosive.density;
  explosive.reaction->advance({in.settings.time_step, out.view(compression), out.view(out.pressure)},
                              out.view(fraction));
  for (std::size_t k = 0; k < out.size; ++k) {
    const double now = std::max(fraction[k], burnt_since(lighting[k], in.settings.time, rate));
    fraction[k] = now > burnt ? 1.0 : now;
  }
}

void evaluate_burning(const EosStrength& model, const Step& in, Chunk& out) {
  const eos::Batch batch{out.view(out.density),     out.view(out.energy),           out.view(out.pressure),
                         out.view(out.temperature), out.view(out.bulk_sound_speed), out.view(out.melted),
                         out.view(out.vaporised)};
  const auto fraction = out.view(out.history[model.burn_fraction]);
  book(out, in.energy == Energy::from_grid
                ? model.burn->evaluate(batch, fraction)
                : model.burn->integrate(batch, out.view(out.energy), out.view(out.half_change), fraction));
  std::copy_n(out.pressure.data(), out.size, out.acting_pressure.data());
}

}  // namespace whipple::material::parts
