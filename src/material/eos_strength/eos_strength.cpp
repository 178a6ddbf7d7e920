// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/eos_strength/eos_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/text.hpp"
#include "src/material/eos_strength/parts.hpp"
#include "src/material/strength/brittle.hpp"

namespace whipple::material {
namespace {

const HistoryField damage_field = {"damage",
                                   "1",
                                   "of failure criteria with a past: 0 none, 1 failed",
                                   Rank::scalar,
                                   Convection::kept,
                                   0.0,
                                   {.lower = 0.0, .upper = 1.0 + 1e-9}};
const HistoryField distension_field = {"distension",
                                       "1",
                                       "volume over that of the material without its pores",
                                       Rank::scalar,
                                       Convection::kept,
                                       1.0,
                                       {.lower = 0.0, .lower_open = true}};
const HistoryField back_stress_field = {"back_stress", "Pa", "centre of the yield surface, xx yy zz xy yz zx",
                                        Rank::symmetric_tensor, Convection::corotated};
const HistoryField strain_field = {"strain", "1",
                                   "logarithmic strain, rotated with the material, xx yy zz xy yz zx",
                                   Rank::symmetric_tensor, Convection::corotated};
const HistoryField cold_work_field = {"stored_cold_work", "J/kg", "plastic work that did not become heat"};

const HistoryField threshold_stress_field = {"threshold_stress",
                                             "Pa",
                                             "flow stress at 0 K by dislocations, of mechanical_threshold",
                                             Rank::scalar,
                                             Convection::kept,
                                             0.0,
                                             {.lower = 0.0}};
const HistoryField fragment_size_field = {"fragment_size",
                                          "m",
                                          "of the fragments that a failed point is part of; 0: none",
                                          Rank::scalar,
                                          Convection::kept,
                                          0.0,
                                          {.lower = 0.0}};

void share_of_damage(const EosStrength& model, const Chunk& chunk, Lanes& share) {
  const Lanes& damage = chunk.history[model.damage];
  for (std::size_t k = 0; k < chunk.size; ++k) share[k] = chunk.intact[k] == 0.0 ? 1.0 : damage[k];
}

void whole_share(const EosStrength&, const Chunk& chunk, Lanes& share) {
  std::fill_n(share.data(), chunk.size, 1.0);
}

template <class Property>
bool any_criterion(const Material& material, Property property) {
  return std::ranges::any_of(material.failure, [&](const auto& criterion) { return property(*criterion); });
}
bool softens(const Material& material) {
  return any_criterion(material, [](const failure::Criterion& c) { return c.softens(); });
}
bool is_brittle(const Material& material) { return material.strength->brittle() != nullptr; }
bool dilates(const Material& material) {
  return is_brittle(material) && material.strength->brittle()->dilates();
}

}  // namespace

std::vector<HistoryField> EosStrength::fields() {
  return {damage_field,    distension_field,       back_stress_field,  strain_field,
          cold_work_field, threshold_stress_field, fragment_size_field};
}

EosStrength::EosStrength(const Material& material)
    : foam(dynamic_cast<const strength::Foam*>(material.strength.get())) {
  if (is_brittle(material) || any_criterion(material, [](const auto& c) { return c.accumulates(); })) {
    damage = declare(damage_field);
  }
  if (material.eos->initial_distension() > 1.0 ||
      (is_brittle(material) && material.strength->brittle()->bulks()) || dilates(material)) {
    distension = declare(distension_field);
  }
  if (material.strength->kinematic_modulus() > 0.0) back_stress = declare(back_stress_field);
  if (any_criterion(material, [](const auto& c) { return c.needs_strain(); })) strain = declare(strain_field);
  if (material.stores_cold_work()) stored_cold_work = declare(cold_work_field);
  if (const std::optional<double> initial = material.strength->initial_threshold()) {
    threshold_stress = declare(threshold_stress_field);
    initial_threshold_ = *initial;
  }
  for (const auto& criterion : material.failure) {
    fragments = dynamic_cast<const failure::FragmentSize*>(criterion.get());
    if (fragments == nullptr) continue;
    fragment_size = declare(fragment_size_field);
    break;
  }
  if (is_brittle(material)) {
    share_ = whole_share;
  } else if (softens(material)) {
    share_ = share_of_damage;
    softens_ = true;
  }
  from_grid_ = parts_of(material, Energy::from_grid);
  integrated_ = parts_of(material, Energy::integrated);
}

EosStrength::Parts EosStrength::parts_of(const Material& material, Energy energy) const {
  using namespace parts;
  const bool integrates = energy == Energy::integrated, has_phases = material.eos->has_phases();
  const bool stores = stored_cold_work != undeclared, kinematic = back_stress != undeclared;
  const bool threshold = threshold_stress != undeclared;
  const bool brittle = is_brittle(material), damages = softens(material), strained = strain != undeclared;
  const bool viscous = material.strength->viscosity() > 0.0;
  Parts all;
  std::vector<Part>* section = &all.deviator;
  const auto take = [&](Part part) { section->push_back(part); };
  const auto take_if = [&](bool condition, Part part) {
    if (condition) take(part);
  };
  take_if(has_phases, fetch_phases);
  take_if(integrates, fetch_old_deviator);
  take(damages ? find_damaged_solid_fraction : find_solid_fraction);
  if (material.strength->carries_deviator()) {
    take(strained ? elastic_trial_and_strain : parts::elastic_trial);
    if (kinematic) {
      take(stores ? return_kinematically_and_store : return_kinematically);
    } else {
      take(threshold ? return_radially_and_harden : return_radially);
      take_if(stores, store_cold_work);
    }
  } else {
    take(viscous ? viscous_deviator : strained ? strain_alone : no_deviator);
  }
  take_if(strained, advance_strain);
  take(brittle ? free_brittle : free_failed);
  take(integrates ? energy_by_work : energy_from_grid);
  take_if(stores, take_cold_work);
  section = &all.pressure;
  if (foam != nullptr) {
    take(evaluate_foam);
  } else if (dilates(material)) {
    take(evaluate_dilating);
  } else if (distension != undeclared) {
    take(has_phases ? evaluate_porous_phases : evaluate_porous);
  } else {
    take(has_phases ? evaluate_phases : evaluate_simple);
  }
  section = &all.rest;
  take_if(integrates, accept_energy);
  take_if(integrates && stores, return_cold_work);
  take_if(brittle, relax_brittle);
  if (!material.failure.empty()) {
    take(prepare_failure);
    take_if(any_criterion(material, [](const auto& c) { return c.healing_code() != failure::intact; }), heal);
    take_if(material.void_growth != nullptr, grow_voids);
    take(strained ? mark_failed_by_strain : mark_failed);
    take_if(fragments != nullptr, keep_fragment_size);
  }
  if (viscous) {
    take(damages ? lose_in_damaged_viscous : lose_in_viscous);
  } else {
    take(brittle ? lose_in_brittle : damages ? lose_in_damaged : lose_in_failed);
  }
  take_if(kinematic, lose_back_stress);
  take_if(stores, release_cold_work);
  take_if(integrates, correct_work_beside_voids);
  return all;
}

std::string EosStrength::constants(const Material& material) const {
  return fmt::format("\n[strength]\n{}", material.strength->constants());
}

std::shared_ptr<const Constitutive> EosStrength::adapted(const Material& material) const {
  return std::make_shared<const EosStrength>(material);
}

double EosStrength::sound_speed(const Material& material, const eos::State& state) const {
  const std::array rho = {state.density}, p = {state.pressure}, kelvin = {state.temperature},
                   strain_of = {0.0};
  std::array<double, 1> modulus = {};
  material.strength->shear_modulus({rho, p, kelvin, strain_of}, modulus);
  const double solid = shear_bearing_fraction(state.melted_fraction, state.vaporised_fraction);
  return std::sqrt(state.sound_speed * state.sound_speed + 4.0 / 3.0 * solid * modulus[0] / state.density);
}

void EosStrength::start(const eos::State& state, MaterialPoints& points, std::size_t begin,
                        std::size_t end) const {
  if (distension != undeclared) {
    std::vector<double>& values = points.history.scalar(distension_field.name);
    for (std::size_t i = begin; i < end; ++i) values[i] = state.distension;
  }
  if (threshold_stress != undeclared) {
    std::vector<double>& values = points.history.scalar(threshold_stress_field.name);
    for (std::size_t i = begin; i < end; ++i) values[i] = initial_threshold_;
  }
}

double EosStrength::maximum_density(const Material& material, const Chunk& chunk, std::size_t k) const {
  if (foam == nullptr && !dilates(material)) return Constitutive::maximum_density(material, chunk, k);
  return material.eos->maximum_density() * material.eos->initial_distension() / chunk.history[distension][k];
}

double EosStrength::least_maximum_density(const Material& material) const {
  const double greatest = dilates(material) ? material.strength->brittle()->greatest_distension() : 1.0;
  return Constitutive::least_maximum_density(material) / greatest;
}

void EosStrength::void_share(const Chunk& chunk, Lanes& share) const {
  share_ != nullptr ? share_(*this, chunk, share) : Constitutive::void_share(chunk, share);
}

void EosStrength::divide_energy(const Material& material, const MaterialPoints& points, std::size_t begin,
                                std::span<double> elastic, std::span<double> stored) const {
  const std::size_t n = elastic.size();
  std::ranges::fill(elastic, 0.0);
  if (stored_cold_work == undeclared) {
    std::ranges::fill(stored, 0.0);
  } else {
    std::copy_n(points.history.scalar(cold_work_field.name).begin() + static_cast<std::ptrdiff_t>(begin), n,
                stored.begin());
  }
  if (!material.strength->carries_deviator()) return;
  const auto part = [&](const std::vector<double>& values) { return std::span(values).subspan(begin, n); };
  Lanes density, modulus;
  for (std::size_t k = 0; k < n; ++k) density[k] = points.mass[begin + k] / points.volume[begin + k];
  strength::State state{std::span(density.data(), n), part(points.pressure), part(points.temperature),
                        part(points.plastic_strain)};
  if (threshold_stress != undeclared) {
    state.threshold = part(points.history.scalar(threshold_stress_field.name));
  }
  material.strength->shear_modulus(state, std::span(modulus.data(), n));
  const std::vector<double>* damages = softens_ ? &points.history.scalar(damage_field.name) : nullptr;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t p = begin + k;
    double solid = shear_bearing_fraction(points.melted_fraction[p], points.vaporised_fraction[p]);
    if (damages != nullptr) solid *= 1.0 - (*damages)[p];
    const double stiffness = points.failed[p] == failure::intact ? solid * modulus[k] : 0.0;
    if (stiffness > 0.0) {
      elastic[k] = points.deviatoric_stress[p].squared_norm() / (4.0 * stiffness * density[k]);
    }
  }
}

void EosStrength::advance_deviator(const Step& in, Chunk& out) const {
  for (const Part part : parts_for(in).deviator) part(*this, in, out);
}

void EosStrength::finish(const Step& in, Chunk& out) const {
  for (const Part part : parts_for(in).rest) part(*this, in, out);
}

void EosStrength::update(const Step& in, Chunk& out) const {
  advance_deviator(in, out);
  for (const Part part : parts_for(in).pressure) part(*this, in, out);
  finish(in, out);
}

}  // namespace whipple::material
