// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "eos/inversions.hpp"
#include "eos/modifiers/distended.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/text.hpp"
#include "src/material/burn_model.hpp"
#include "src/material/eos_strength/eos_strength.hpp"
#include "src/material/failure/fragment_size.hpp"
#include "src/material/strength/brittle.hpp"
#include "src/material/strength/elastic.hpp"
#include "src/material/strength/foam.hpp"
#include "src/material/strength/granular_flow.hpp"
#include "src/material/strength/none.hpp"

namespace whipple {
namespace {

/// Finds the state of zero pressure at a temperature by Newton iteration in the density, rho <- rho (1 - p / K_T).
eos::State state_of_zero_pressure(const eos::EquationOfState& model, double temperature) {
  double density = model.reference_density();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const eos::State state = model.state_at_temperature(density, temperature);
    const double isentropic = density * state.sound_speed * state.sound_speed;
    const double modulus = state.isothermal_bulk_modulus > 0.0 ? state.isothermal_bulk_modulus : isentropic;
    if (!(modulus > 0.0)) break;
    if (std::abs(state.pressure) <= 1e-11 * modulus) return state;
    density *= 1.0 - std::clamp(state.pressure / modulus, -0.1, 0.1);
    if (density < 0.3 * model.reference_density() || density > 1.5 * model.reference_density()) break;
  }
  throw InputError(
      fmt::format("no condensed state of zero pressure at {} K: give a density as well", temperature));
}

/// Finds the state at a pressure and a density or temperature.
/// @throws InputError, StateError if there is none
eos::State state_at_pressure(const eos::EquationOfState& model, double pressure,
                             std::optional<double> density, std::optional<double> temperature) {
  if (density && temperature) {
    throw InputError("pressure, temperature and density are given: two of them fix the state");
  }
  if (density) return eos::state_at_pressure(model, *density, pressure);
  const double at = temperature.value_or(model.reference_temperature());
  if (std::isnan(at)) throw InputError("the equation of state has no temperature: give pressure and density");
  try {
    return eos::state_at_pressure_and_temperature(model, pressure, at);
  } catch (const StateError&) {
    constexpr double thin = 1e-6;  // of the reference density: start on the vapour branch
    if (!(pressure > 0.0)) throw;
    return eos::state_at_pressure_and_temperature(model, pressure, at, thin * model.reference_density());
  }
}

bool is_foam(const Material& material) {
  return dynamic_cast<const strength::Foam*>(material.strength.get()) != nullptr;
}

/// Requires that soil is less dense than its grains, between which there are pores.
/// @throws InputError if it is not
void require_pores_between_grains(const Material& material) {
  const auto* flow = dynamic_cast<const strength::GranularFlowModel*>(material.strength.get());
  if (flow == nullptr) return;
  const double soil = material.eos->reference_density() / material.eos->initial_distension();
  if (soil < flow->law().grain_density) return;
  throw InputError(fmt::format(
      "strength model \"{}\": 'grain_density' {} kg/m^3 must be above the density of the soil, {} kg/m^3",
      flow->model(), flow->law().grain_density, soil));
}

/// Requires that the parts of a material are compatible.
/// @throws InputError if they are not
void require_parts_agree(const Material& material) {
  require_pores_between_grains(material);
  std::string with_past, grows_voids;
  if (const strength::Brittle* brittle = material.strength->brittle()) {
    with_past = material.strength->model();
    if (brittle->bulks() && material.eos->initial_distension() > 1.0) {
      throw InputError(fmt::format(
          "strength model \"{}\" with 'bulking' takes an equation of state without pores", with_past));
    }
    if (brittle->dilates() && (material.eos->has_phases() || material.eos->initial_distension() > 1.0)) {
      throw InputError(
          fmt::format("strength model \"{}\" changes the volume: it takes an equation of state without "
                      "phases and pores",
                      with_past));
    }
  }
  if (is_foam(material) && (material.eos->has_phases() || material.eos->initial_distension() > 1.0)) {
    throw InputError(fmt::format(
        "strength model \"{}\" takes the equation of state of the solid, without phases and pores",
        material.strength->model()));
  }
  for (const auto& criterion : material.failure) {
    if (criterion->accumulates()) {
      if (!with_past.empty()) {
        throw InputError(
            fmt::format("models \"{}\" and \"{}\" both keep the damage of a point: one of them may",
                        with_past, criterion->model()));
      }
      with_past = criterion->model();
    }
    if (!criterion->grows_voids()) continue;
    if (!grows_voids.empty() || material.strength->brittle() != nullptr || is_foam(material)) {
      throw InputError(fmt::format("models \"{}\" and \"{}\" both open voids: one of them may",
                                   grows_voids.empty() ? material.strength->model() : grows_voids,
                                   criterion->model()));
    }
    grows_voids = criterion->model();
    if (!criterion->returns_deviator()) continue;
    if (!material.strength->carries_deviator()) {
      throw InputError(
          fmt::format("failure model \"{}\" needs a strength model with a flow stress, not \"{}\"",
                      criterion->model(), material.strength->model()));
    }
    if (material.strength->kinematic_modulus() > 0.0) {
      throw InputError(
          fmt::format("failure model \"{}\" goes with isotropic hardening only: 'kinematic_modulus' "
                      "must be 0",
                      criterion->model()));
    }
    if (material.eos->initial_distension() > 1.0 && criterion->initial_porosity() > 0.0) {
      throw InputError(
          fmt::format("failure model \"{}\": the equation of state has pores already; "
                      "'initial_porosity' must be 0",
                      criterion->model()));
    }
  }
}

/// @throws InputError if sizes of fragments are asked for twice, or of material that does not fail
void require_one_fragment_size(const Material& material) {
  const auto asked = std::ranges::count_if(
      material.failure, [](const auto& c) { return c->model() == failure::FragmentSize::name; });
  if (asked > 1) throw InputError("failure model \"fragment_size\" is given twice");
  if (asked == 1 && material.failure.size() == 1)
    throw InputError("failure model \"fragment_size\" makes nothing fail: it goes with another one");
}

double initial_porosity(const Material& material) {
  return material.void_growth == nullptr ? 0.0 : material.void_growth->initial_porosity();
}

}  // namespace

namespace {

/// Computes the quantities that follow from the parts.
Material completed(Material material) {
  require_parts_agree(material);
  require_one_fragment_size(material);
  for (const auto& criterion : material.failure) {
    if (criterion->grows_voids()) material.void_growth = criterion.get();
  }
  if (const strength::Brittle* brittle = material.strength->brittle()) {
    if (brittle->bulks() || brittle->dilates())
      material.eos = std::make_shared<const eos::Distended>(material.eos);
  }
  if (const auto* foam = dynamic_cast<const strength::Foam*>(material.strength.get())) {
    material.eos = std::make_shared<const eos::Distended>(material.eos, foam->initial_distension());
  }
  material.reference = initial_state(material);
  const double sound_speed = material.reference.sound_speed;
  material.reference_bulk_modulus = material.reference.density * sound_speed * sound_speed;
  material.constitutive = material.constitutive->adapted(material);
  return material;
}

}  // namespace

Material make_material(std::string name, std::shared_ptr<const eos::EquationOfState> eos,
                       std::shared_ptr<const strength::Strength> strength,
                       std::vector<std::shared_ptr<const failure::Criterion>> failure) {
  Material material;
  material.name = std::move(name);
  material.eos = std::move(eos);
  material.strength = strength ? std::move(strength) : std::make_shared<const strength::NoneModel>();
  material.failure = std::move(failure);
  material.constitutive = std::make_shared<const material::EosStrength>();
  return completed(std::move(material));
}

Material make_material(std::string name, std::shared_ptr<const eos::EquationOfState> eos,
                       std::shared_ptr<const material::Constitutive> constitutive) {
  Material material;
  material.name = std::move(name);
  material.eos = std::move(eos);
  material.strength = std::make_shared<const strength::NoneModel>();
  material.constitutive = std::move(constitutive);
  return completed(std::move(material));
}

Material with_eos(const Material& material, std::shared_ptr<const eos::EquationOfState> eos) {
  Material result = material;
  result.eos = std::move(eos);
  return completed(std::move(result));
}

namespace {

const Explosive& explosive_of(const Material& material) {
  if (material.explosive != nullptr) return *material.explosive;
  throw InputError(
      fmt::format("material '{}' is no explosive: its equation of state is that of no detonation products",
                  material.name));
}

}  // namespace

Material burning(const Material& material, double detonation_velocity) {
  Explosive explosive = explosive_of(material);
  if (!material.failure.empty()) {
    throw InputError(fmt::format(
        "material '{}': an explosive that burns takes no [[failure]]: products do not fail", material.name));
  }
  if (detonation_velocity > 0.0) explosive.detonation_velocity = detonation_velocity;
  const auto eos =
      std::make_shared<const BurningExplosive>(std::make_shared<const Explosive>(std::move(explosive)));
  Material result = material;
  // Of another [constitutive] model nothing burns.
  if (material.burns() || dynamic_cast<const material::EosStrength*>(material.constitutive.get()) != nullptr)
    result.constitutive = std::make_shared<const material::BurnModel>(eos);
  result = with_eos(result, eos);
  if (result.burns()) return result;
  throw InputError(
      fmt::format("material '{}': an explosive that burns takes another [strength] or none", material.name));
}

Material unreacted(const Material& material) {
  Material result = with_eos(material, explosive_of(material).unreacted);
  result.explosive = nullptr;
  return result;
}

void set_taylor_quinney(Material& material, double share) {
  const bool returns_deviator = material.void_growth != nullptr && material.void_growth->returns_deviator();
  const bool brittle = material.strength->brittle() != nullptr || is_foam(material);
  if (share < 1.0 && (brittle || returns_deviator || !material.strength->carries_deviator())) {
    const std::string_view model =
        returns_deviator ? material.void_growth->model() : material.strength->model();
    throw InputError(fmt::format(
        "'taylor_quinney' below 1 needs the plastic work of a metal, not that of model \"{}\"", model));
  }
  material.taylor_quinney = share;
  material.constitutive = material.constitutive->adapted(material);
}

eos::State initial_state(const Material& material, std::optional<double> density,
                         std::optional<double> temperature, std::optional<double> pressure) {
  const eos::EquationOfState& model = *material.eos;
  try {
    if (pressure) return state_at_pressure(model, *pressure, density, temperature);
    // A gas, which has no state of zero pressure, or a model without temperature
    if (!temperature && (std::isnan(model.reference_temperature()) || (!model.condensed() && !density))) {
      return model.state(density.value_or(model.reference_density()), model.reference_energy());
    }
    const double at = temperature.value_or(model.reference_temperature());
    return density ? model.state_at_temperature(*density, at) : state_of_zero_pressure(model, at);
  } catch (const StateError& fault) {
    throw InputError(fmt::format("initial state of material '{}': {}", material.name, fault.what()));
  } catch (const InputError& fault) {
    throw InputError(fmt::format("initial state of material '{}': {}", material.name, fault.what()));
  }
}

double body_density(const Material& material, const eos::State& state) {
  return state.density * (1.0 - initial_porosity(material));
}

void use_fields(const Material& material, MaterialPoints& points) {
  for (const auto& [field, lane] : material.constitutive->history()) {
    points.history.declare(field, points.mass.size());
  }
}

void initialise(const Material& material, MaterialPoints& points, std::size_t begin, std::size_t end) {
  initialise(material, points, begin, end, material.reference);
}

void initialise(const Material& material, MaterialPoints& points, std::size_t begin, std::size_t end,
                const eos::State& state) {
  const auto carried = [](double value) { return std::isnan(value) ? 0.0 : value; };
  const double sound = material.constitutive->sound_speed(material, state);
  const double porosity = initial_porosity(material);
  use_fields(material, points);
  for (std::size_t i = begin; i < end; ++i) {
    points.volume[i] = points.mass[i] / state.density;
    points.void_volume[i] = points.volume[i] * porosity / (1.0 - porosity);
    points.specific_internal_energy[i] = state.specific_internal_energy;
    points.pressure[i] = state.pressure;
    points.artificial_viscosity[i] = 0.0;
    points.deviatoric_stress[i] = {};
    points.temperature[i] = carried(state.temperature);
    points.sound_speed[i] = sound;
    points.plastic_strain[i] = 0.0;
    points.melted_fraction[i] = state.melted_fraction;
    points.vaporised_fraction[i] = state.vaporised_fraction;
    points.failed[i] = failure::intact;
    points.maximum_pressure[i] = state.pressure;
    points.maximum_temperature[i] = points.temperature[i];
    points.melting_time[i] = state.melted_fraction >= melted_share ? 0.0 : never;
    if (!points.failure_threshold_factor.empty()) points.failure_threshold_factor[i] = 1.0;
    if (!points.strength_factor.empty()) points.strength_factor[i] = 1.0;
  }
  for (History& history : points.history) {
    std::visit(
        [&]<class Value>(std::vector<Value>& values) {
          if (!values.empty()) {
            std::fill(values.begin() + static_cast<std::ptrdiff_t>(begin),
                      values.begin() + static_cast<std::ptrdiff_t>(end),
                      neutral_value<Value>(history.field.neutral));
          }
        },
        history.values);
  }
  material.constitutive->start(state, points, begin, end);
}

std::string Material::constants() const {
  std::string text = file.empty() ? "" : fmt::format("# read from {}\n", file.string());
  text += fmt::format("name = {}\nsource = {}\n", toml_string(name), toml_string(source));
  if (!note.empty()) text += fmt::format("note = {}\n", toml_string(note));
  text += fmt::format("[eos]\nmodel = {}\n{}",
                      toml_string(burns() ? explosive->products->model() : eos->model()), eos->constants());
  if (burns()) {
    const eos::EquationOfState& unreacted = *explosive->unreacted;
    text += fmt::format("\n[eos.unreacted]\nmodel = {}\n{}", toml_string(unreacted.model()),
                        unreacted.constants());
    if (explosive->reaction != nullptr)
      text += fmt::format("\n[reaction]\n{}", explosive->reaction->constants());
  }
  text += constitutive->constants(*this);
  if (conductivity > 0.0 || stores_cold_work()) {
    text += fmt::format("\n[thermal]\nsource = {}\nconductivity = \"{} W/(m K)\"\ntaylor_quinney = {}\n",
                        toml_string(source), conductivity, taylor_quinney);
  }
  for (const auto& criterion : failure) text += fmt::format("\n[[failure]]\n{}", criterion->constants());
  return text;
}

bool Material::returns_radially() const {
  const bool yields =
      strength->carries_deviator() && dynamic_cast<const strength::ElasticModel*>(strength.get()) == nullptr;
  return yields && strength->brittle() == nullptr && !is_foam(*this) &&
         (void_growth == nullptr || !void_growth->returns_deviator());
}

}  // namespace whipple
