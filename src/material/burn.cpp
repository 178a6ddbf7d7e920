// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/burn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "eos/detonation.hpp"
#include "eos/mixture_of_two.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "eos/modifiers/modified.hpp"
#include "src/core/base/error.hpp"

namespace whipple {
namespace {

constexpr double density_tolerance = 1e-3;

/// What is known of every solid or liquid explosive; replacing the constants of TNT by it moves a detonation
/// front by less than a hundredth of a cell.
std::shared_ptr<const eos::EquationOfState> estimated_unreacted(const eos::EquationOfState& products,
                                                                double velocity) {
  return std::make_shared<const eos::ModelEquationOfState<eos::MieGruneisen>>(
      eos::MieGruneisenConstants{.reference_density = products.reference_density(),
                                 .hugoniot_intercept = 0.35 * velocity,
                                 .hugoniot_slope = 1.8,
                                 .gruneisen = 0.7,
                                 .heat_capacity = 1100.0,
                                 .reference_temperature = 298.15});
}

void require_simple(const eos::EquationOfState& eos, const char* what) {
  if (!eos.has_phases() && eos.initial_distension() == 1.0) return;
  throw InputError(fmt::format(
      "{}: model \"{}\" has phases or pores, which an explosive that burns cannot have", what, eos.model()));
}

}  // namespace

std::shared_ptr<const Explosive> make_explosive(std::shared_ptr<const eos::EquationOfState> products,
                                                std::shared_ptr<const eos::EquationOfState> unreacted,
                                                std::shared_ptr<const reaction::Reaction> reaction) {
  if (reaction != nullptr && unreacted == nullptr) {
    throw InputError(
        fmt::format("rate law \"{}\" takes the equation of state of the unreacted explosive, [eos.unreacted]",
                    reaction->model()));
  }
  Explosive made;
  made.reaction = std::move(reaction);
  require_simple(*products, "the products of an explosive");
  try {
    const eos::ChapmanJouguet wave = eos::chapman_jouguet(*products);
    made.detonation_velocity = wave.detonation_velocity;
    made.chapman_jouguet_volume = products->reference_density() / wave.state.density;
    made.chapman_jouguet_pressure = wave.state.pressure;
  } catch (const StateError& fault) {
    throw InputError(fmt::format("the products of an explosive: {}", fault.what()));
  }
  made.estimated = unreacted == nullptr;
  made.density = products->reference_density();
  made.unreacted =
      made.estimated ? estimated_unreacted(*products, made.detonation_velocity) : std::move(unreacted);
  require_simple(*made.unreacted, "the unreacted explosive");
  if (!made.unreacted->condensed()) {
    throw InputError(fmt::format("the unreacted explosive: model \"{}\" has no state of zero pressure",
                                 made.unreacted->model()));
  }
  if (std::abs(made.unreacted->reference_density() / made.density - 1.0) > density_tolerance) {
    throw InputError(fmt::format(
        "the unreacted explosive has {:.6g} kg/m^3 at rest, its products start from {:.6g} kg/m^3",
        made.unreacted->reference_density(), made.density));
  }
  made.stored_energy = products->reference_energy() - made.unreacted->reference_energy();
  made.products = std::move(products);
  return std::make_shared<const Explosive>(std::move(made));
}

BurningExplosive::BurningExplosive(std::shared_ptr<const Explosive> explosive)
    : explosive_(std::move(explosive)),
      in_equilibrium_(explosive_->reaction != nullptr &&
                      explosive_->reaction->closure() == reaction::Closure::equilibrium) {}

eos::RangeReport BurningExplosive::evaluate(const eos::Batch& batch) const {
  return eos::in_chunks(batch, [&](const eos::Batch& part) {
    const eos::ModifierScratch none{};
    return evaluate(part, std::span(none).first(part.density.size()));
  });
}

eos::RangeReport BurningExplosive::evaluate(const eos::Batch& batch, std::span<const double> burnt) const {
  const std::size_t all = batch.density.size();
  if (all > eos::modifier_chunk) {
    eos::RangeReport report;
    for (std::size_t first = 0; first < all; first += eos::modifier_chunk) {
      const std::size_t count = std::min(eos::modifier_chunk, all - first);
      eos::RangeReport of_part = evaluate(eos::part_of(batch, first, count), burnt.subspan(first, count));
      if (of_part.first != eos::RangeReport::none) of_part.first += first;
      report.merge(of_part);
    }
    return report;
  }
  std::copy_n(burnt.begin(), batch.melted_fraction.empty() ? 0 : all, batch.melted_fraction.begin());
  std::copy_n(burnt.begin(), batch.vaporised_fraction.empty() ? 0 : all, batch.vaporised_fraction.begin());
  return in_equilibrium_ ? evaluate_in_equilibrium(batch, burnt) : evaluate_at_one_volume(batch, burnt);
}

eos::RangeReport BurningExplosive::evaluate_in_equilibrium(const eos::Batch& batch,
                                                           std::span<const double> burnt) const {
  const Explosive& of = *explosive_;
  const auto whole = [](double f) { return f < eos::MixtureOfTwo::least_fraction; };
  const auto products = [](double f) { return f >= 1.0; };
  const auto mixed = [&](double f) { return !whole(f) && !products(f); };
  eos::RangeReport report;
  // The points of one kind, one after the other.
  const auto evaluate_those = [&](const auto& belongs, double store, const auto& evaluate_part) {
    std::array<std::size_t, eos::modifier_chunk> point;
    eos::ModifierScratch density, energy, fraction, pressure, temperature, sound_speed;
    std::size_t count = 0;
    for (std::size_t i = 0; i < burnt.size(); ++i) {
      if (!belongs(burnt[i])) continue;
      point[count] = i;
      density[count] = batch.density[i];
      energy[count] = batch.specific_internal_energy[i] - store;
      fraction[count++] = burnt[i];
    }
    if (count == 0) return;
    const auto part = [count](auto& values) { return std::span(values).first(count); };
    eos::RangeReport of_part = evaluate_part(
        eos::Batch{part(density), part(energy), part(pressure), part(temperature), part(sound_speed), {}, {}},
        part(fraction));
    for (std::size_t k = 0; k < count; ++k) {
      batch.pressure[point[k]] = pressure[k];
      batch.temperature[point[k]] = temperature[k];
      batch.sound_speed[point[k]] = sound_speed[k];
    }
    if (of_part.first != eos::RangeReport::none) of_part.first = point[of_part.first];
    report.merge(of_part);
  };
  evaluate_those(whole, of.stored_energy,
                 [&](const eos::Batch& part, auto) { return of.unreacted->evaluate(part); });
  evaluate_those(products, 0.0, [&](const eos::Batch& part, auto) { return of.products->evaluate(part); });
  evaluate_those(mixed, 0.0, [&](const eos::Batch& part, std::span<const double> fraction) {
    return eos::MixtureOfTwo{*of.unreacted, *of.products, of.stored_energy}.evaluate(part, fraction);
  });
  return report;
}

eos::RangeReport BurningExplosive::evaluate_at_one_volume(const eos::Batch& batch,
                                                          std::span<const double> burnt) const {
  const std::size_t all = batch.density.size();
  const Explosive& of = *explosive_;
  const auto simple = [&](std::span<const double> density, std::span<const double> energy,
                          std::span<double> pressure, std::span<double> temperature,
                          std::span<double> sound_speed) {
    return eos::Batch{density, energy, pressure, temperature, sound_speed, {}, {}};
  };
  if (std::ranges::all_of(burnt, [](double f) { return f >= 1.0; })) {
    return of.products->evaluate(simple(batch.density, batch.specific_internal_energy, batch.pressure,
                                        batch.temperature, batch.sound_speed));
  }
  // Each model sees those points only that it counts for: of the others, what it knows well.
  eos::ModifierScratch density, energy, pressure, temperature, sound_speed;
  const auto first = [all](auto& values) { return std::span(values).first(all); };
  for (std::size_t i = 0; i < all; ++i) {
    density[i] = burnt[i] < 1.0 ? batch.density[i] : of.density;
    energy[i] = burnt[i] < 1.0 ? batch.specific_internal_energy[i] - of.stored_energy
                               : of.unreacted->reference_energy();
  }
  eos::RangeReport report = of.unreacted->evaluate(
      simple(first(density), first(energy), batch.pressure, batch.temperature, batch.sound_speed));
  if (std::ranges::none_of(burnt, [](double f) { return f > 0.0; })) return report;
  for (std::size_t i = 0; i < all; ++i) {
    density[i] = burnt[i] > 0.0 ? batch.density[i] : of.density;
    energy[i] = burnt[i] > 0.0 ? batch.specific_internal_energy[i] : of.products->reference_energy();
  }
  report.merge(of.products->evaluate(
      simple(first(density), first(energy), first(pressure), first(temperature), first(sound_speed))));
  for (std::size_t i = 0; i < all; ++i) {
    const double f = burnt[i];
    const auto mixed = [f](double of_unreacted, double of_products) {
      return f >= 1.0 ? of_products : f > 0.0 ? (1.0 - f) * of_unreacted + f * of_products : of_unreacted;
    };
    // What burns by a rate law for long has parted by then: its reactant bears no tension between the
    // products.
    const double of_reactant = of.reaction != nullptr ? std::max(batch.pressure[i], 0.0) : batch.pressure[i];
    batch.pressure[i] = mixed(f > 0.0 ? of_reactant : batch.pressure[i], pressure[i]);
    batch.temperature[i] = mixed(batch.temperature[i], temperature[i]);
    const double c = batch.sound_speed[i];
    batch.sound_speed[i] = std::sqrt(mixed(c * c, sound_speed[i] * sound_speed[i]));
  }
  return report;
}

eos::RangeReport BurningExplosive::integrate(const eos::Batch& batch, std::span<double> energy,
                                             std::span<const double> half_change,
                                             std::span<const double> burnt) const {
  const std::size_t n = energy.size();
  eos::ModifierScratch before, first_energy, first_pressure;
  std::copy_n(energy.begin(), n, before.begin());
  for (std::size_t i = 0; i < n; ++i) {
    energy[i] = first_energy[i] = before[i] - half_change[i] * batch.pressure[i];
  }
  eos::RangeReport report = evaluate(batch, burnt);
  for (std::size_t i = 0; i < n; ++i) {
    first_pressure[i] = batch.pressure[i];
    energy[i] = before[i] - half_change[i] * first_pressure[i];
  }
  report.merge(evaluate(batch, burnt));
  // The secant through both, exact where the pressures are linear in the energy.
  for (std::size_t i = 0; i < n; ++i) {
    const double h = half_change[i], span = energy[i] - first_energy[i];
    const double slope = (batch.pressure[i] - first_pressure[i]) / (span != 0.0 ? span : 1.0);
    const bool resolved = std::abs(span) > 1e-9 * std::abs(energy[i]) && h * slope > eos::least_work_slope;
    const double gain = h * (first_pressure[i] - batch.pressure[i]) / (resolved ? 1.0 + h * slope : 1.0);
    energy[i] += gain;
    batch.pressure[i] += resolved ? slope * gain : 0.0;
  }
  return report;
}

eos::State BurningExplosive::with_store(eos::State state) const {
  state.specific_internal_energy += explosive_->stored_energy;
  state.phase = "explosive";
  eos::derive(state);
  return state;
}

eos::State BurningExplosive::state(double density, double specific_internal_energy) const {
  return with_store(
      explosive_->unreacted->state(density, specific_internal_energy - explosive_->stored_energy));
}

eos::State BurningExplosive::state_at_temperature(double density, double temperature) const {
  return with_store(explosive_->unreacted->state_at_temperature(density, temperature));
}

}  // namespace whipple
