// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/burn_model.hpp"

#include <algorithm>

#include "src/core/base/vector_math.hpp"

namespace whipple::material {
namespace {

constexpr double burnt = 0.999;  ///< burn fraction from which on nothing is left

const HistoryField burn_fraction_field = {"burn_fraction",
                                          "1",
                                          "of an explosive: 0 unreacted, 1 burnt to products",
                                          Rank::scalar,
                                          Convection::kept,
                                          0.0,
                                          {.lower = 0.0, .upper = 1.0}};
const HistoryField lighting_time_field = {"lighting_time",
                                          "s",
                                          "when the detonation arrives at an explosive; -1: never",
                                          Rank::scalar,
                                          Convection::kept,
                                          never,
                                          {.lower = never}};

/// Returns the burn fraction by the time since the lighting of a point.
/// @param lighting  s; negative: never
/// @param rate      1/s
double burnt_since(double lighting, double time, double rate) {
  return lighting >= 0.0 ? std::clamp((time - lighting) * rate, 0.0, 1.0) : 0.0;
}

/// Advances the burn fraction by lighting times and compression, and marks the points at the front.
WHIPPLE_KERNEL void detonate(const Explosive& explosive, const Step& in, Chunk& out, const Lanes& lighting,
                             Lanes& fraction) {
  const BurnSettings& settings = in.settings.burn;
  const double rate = explosive.detonation_velocity / settings.width, time = in.settings.time;
  const double early = settings.early / explosive.detonation_velocity;
  const double per_compression = 1.0 / (1.0 - explosive.chapman_jouguet_volume);
  const bool by_volume = settings.mode != BurnMode::time, gated = settings.mode == BurnMode::both;
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

/// Advances the burn fraction by the rate law; by lighting times near the detonators.
void react(const Explosive& explosive, const Step& in, Chunk& out, const Lanes& lighting, Lanes& fraction) {
  const double rate = explosive.detonation_velocity / in.settings.burn.width;
  Lanes compression;
  for (std::size_t k = 0; k < out.size; ++k) compression[k] = out.density[k] / explosive.density;
  explosive.reaction->advance({in.settings.time_step, out.view(compression), out.view(out.pressure)},
                              out.view(fraction));
  for (std::size_t k = 0; k < out.size; ++k) {
    const double now = std::max(fraction[k], burnt_since(lighting[k], in.settings.time, rate));
    fraction[k] = now > burnt ? 1.0 : now;
  }
}

void evaluate(const BurningExplosive& eos, const Step& in, Chunk& out, Lanes& fraction) {
  const eos::Batch batch{out.view(out.density),     out.view(out.energy),           out.view(out.pressure),
                         out.view(out.temperature), out.view(out.bulk_sound_speed), out.view(out.melted),
                         out.view(out.vaporised)};
  book(out, in.energy == Energy::from_grid
                ? eos.evaluate(batch, out.view(fraction))
                : eos.integrate(batch, out.view(out.energy), out.view(out.half_change), out.view(fraction)));
  std::copy_n(out.pressure.data(), out.size, out.acting_pressure.data());
}

}  // namespace

std::vector<HistoryField> BurnModel::fields() { return {burn_fraction_field, lighting_time_field}; }

BurnModel::BurnModel(const Material& material, std::shared_ptr<const BurningExplosive> eos)
    : eos_(std::move(eos)), solid_(material) {
  for (const Slot& slot : solid_.history())
    declare(slot.field);  // first, so that its lanes are where it finds them
  burn_fraction_ = declare(burn_fraction_field);
  lighting_time_ = declare(lighting_time_field);
}

std::shared_ptr<const Constitutive> BurnModel::adapted(const Material& material) const {
  if (material.eos == eos_) return std::make_shared<const BurnModel>(material, eos_);
  return std::make_shared<const EosStrength>(material);
}

double BurnModel::least_maximum_density(const Material& material) const {
  return std::min(material.eos->maximum_density(), eos_->explosive().products->maximum_density());
}

double BurnModel::maximum_density(const Material& material, const Chunk& chunk, std::size_t k) const {
  const double of_reactant = material.eos->maximum_density();
  const double of_products = eos_->explosive().products->maximum_density();
  const double fraction = chunk.history[burn_fraction_][k];
  // Products that a wall or another detonation stops are denser than the unreacted explosive ever is.
  return fraction >= 1.0 ? of_products : fraction > 0.0 ? std::min(of_reactant, of_products) : of_reactant;
}

void BurnModel::update(const Step& in, Chunk& out) const {
  const Explosive& explosive = eos_->explosive();
  const Lanes& lighting = out.history[lighting_time_];
  Lanes& fraction = out.history[burn_fraction_];
  solid_.advance_deviator(in, out);
  explosive.reaction == nullptr ? detonate(explosive, in, out, lighting, fraction)
                                : react(explosive, in, out, lighting, fraction);
  evaluate(*eos_, in, out, fraction);
  solid_.finish(in, out);
}

}  // namespace whipple::material
