// SPDX-License-Identifier: BSD-3-Clause
#include "src/device/material/describe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/ideal_gas.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "eos/models/polynomial.hpp"
#include "eos/table/builder.hpp"
#include "eos/table/table_of_model.hpp"
#include "src/core/base/error.hpp"
#include "src/material/eos_strength/eos_strength.hpp"
#include "src/material/failure/fragment_size.hpp"
#include "src/material/failure/johnson_cook_damage.hpp"
#include "src/material/failure/plastic_strain.hpp"
#include "src/material/failure/tensile_pressure.hpp"
#include "src/material/failure/viscous_void_growth.hpp"
#include "src/material/strength/elastic.hpp"
#include "src/material/strength/johnson_cook.hpp"
#include "src/material/strength/none.hpp"
#include "src/material/strength/steinberg_guinan.hpp"
#include "src/material/strength/von_mises.hpp"

namespace whipple::device {

static_assert(std::is_trivially_copyable_v<MaterialConstants>);

namespace {

template <class Wanted, class Base>
const Wanted* as(const std::shared_ptr<const Base>& part) {
  return dynamic_cast<const Wanted*>(part.get());
}

template <class Law>
using CriterionOf = failure::CriterionModel<Law>;

/// Describes a model on a shock curve or a polynomial.
template <class Model>
bool describe_gruneisen(const Material& material, MaterialConstants& result, std::vector<double>& tables) {
  const auto* model = as<eos::ModelEquationOfState<Model>>(material.eos);
  if (model == nullptr) return false;
  const auto& curve = model->underlying().curve();
  const double least_sound_speed = Model::least_sound_speed_ratio * curve.reference_sound_speed();
  result.eos = EosKind::gruneisen;
  result.gruneisen =
      curve.solid().point(Model::least_temperature, least_sound_speed * least_sound_speed, tables);
  return true;
}

/// Describes an ideal gas: a solid without cold pressure that is always expanded, Gamma = gamma - 1.
bool describe_gas(const Material& material, MaterialConstants& result) {
  const auto* model = as<eos::ModelEquationOfState<eos::IdealGas>>(material.eos);
  if (model == nullptr) return false;
  const eos::IdealGasCurve& gas = model->underlying().curve();
  const double least = eos::IdealGas::least_sound_speed_ratio * gas.reference_sound_speed();
  result.eos = EosKind::gruneisen;
  result.gruneisen = {.least_density = std::numeric_limits<double>::infinity(),
                      .maximum_density = gas.maximum_density(),
                      .density = gas.reference_density(),
                      .gruneisen = gas.constants().heat_capacity_ratio - 1.0,
                      .heat_capacity = gas.heat_capacity(),
                      .least_temperature = eos::IdealGas::least_temperature,
                      .least_squared = least * least};
  return true;
}

/// Describes a model that a kernel has in closed form.
bool describe_closed_form(const Material& material, MaterialConstants& result, std::vector<double>& tables) {
  return describe_gruneisen<eos::MieGruneisen>(material, result, tables) ||
         describe_gruneisen<eos::Polynomial>(material, result, tables) || describe_gas(material, result);
}

bool describe_eos(const Material& material, MaterialConstants& result, std::vector<double>& tables) {
  if (describe_closed_form(material, result, tables)) return true;
  const auto* backed = as<eos::TableOfModel>(material.eos);
  const auto* table = backed != nullptr ? &backed->table() : as<eos::Table>(material.eos);
  if (table == nullptr) return false;
  result.eos = EosKind::table;
  result.has_phases = material.eos->has_phases();
  result.table = table->point(tables);
  return true;
}

void describe(const strength::JohnsonCook& law, JohnsonCookConstants& result) {
  result = {.yield_stress = law.yield_stress,
            .hardening_coefficient = law.hardening_coefficient,
            .hardening_exponent = law.hardening_exponent,
            .rate_coefficient = law.rate_coefficient,
            .reference_rate = law.reference_rate,
            .thermal_exponent = law.thermal_exponent,
            .reference_temperature = law.reference_temperature,
            .melting_temperature = law.melting_temperature};
}

void describe(const strength::SteinbergGuinan& law, SteinbergGuinanConstants& result) {
  result = {.reference_density = law.reference_density,
            .shear_modulus = law.shear_modulus,
            .pressure_coefficient = law.pressure_coefficient,
            .temperature_coefficient = law.temperature_coefficient,
            .yield_stress = law.yield_stress,
            .maximum_flow_stress = law.maximum_flow_stress,
            .hardening_coefficient = law.hardening_coefficient,
            .hardening_exponent = law.hardening_exponent,
            .initial_plastic_strain = law.initial_plastic_strain};
}

void describe(const failure::JohnsonCookDamage& law, JohnsonCookDamageConstants& result) {
  result = {.d1 = law.d1,
            .d2 = law.d2,
            .d3 = law.d3,
            .d4 = law.d4,
            .d5 = law.d5,
            .reference_rate = law.reference_rate,
            .reference_temperature = law.reference_temperature,
            .melting_temperature = law.melting_temperature,
            .least_failure_strain = law.least_failure_strain,
            .least_triaxiality = law.least_triaxiality,
            .greatest_triaxiality = law.greatest_triaxiality};
}

bool describe_strength(const Material& material, MaterialConstants& result) {
  const auto& part = material.strength;
  if (as<strength::NoneModel>(part) != nullptr) {
    result.strength = StrengthKind::none;
  } else if (const auto* von_mises = as<strength::VonMisesModel>(part)) {
    const strength::VonMises& law = von_mises->law();
    result.strength = StrengthKind::von_mises;
    result.shear_modulus = law.stiffness();
    // A bound that no stress reaches is finite: the fraction of a failed point times it is 0.
    const double greatest = std::min(law.maximum_flow_stress, std::numeric_limits<double>::max());
    result.von_mises = {law.yield_stress, law.hardening_modulus, greatest};
  } else if (const auto* elastic = as<strength::ElasticModel>(part)) {
    constexpr double unreached = std::numeric_limits<double>::max();
    result.strength = StrengthKind::von_mises;
    result.shear_modulus = elastic->law().stiffness();
    result.von_mises = {unreached, 0.0, unreached};
  } else if (const auto* johnson_cook = as<strength::JohnsonCookModel>(part)) {
    result.strength = StrengthKind::johnson_cook;
    result.shear_modulus = johnson_cook->law().stiffness();
    describe(johnson_cook->law(), result.johnson_cook);
  } else if (const auto* steinberg = as<strength::SteinbergGuinanModel>(part)) {
    result.strength = StrengthKind::steinberg_guinan;
    describe(steinberg->law(), result.steinberg_guinan);
  } else {
    return false;
  }
  return true;
}

/// Describes one criterion. A criterion of a kind that the material has already is refused.
bool describe_criterion(const std::shared_ptr<const failure::Criterion>& criterion,
                        MaterialConstants& result) {
  const auto add = [&](CriterionKind kind) {
    const auto end = result.order.begin() + result.criteria;
    if (std::find(result.order.begin(), end, kind) != end) return false;
    result.order[result.criteria++] = kind;
    return true;
  };
  const auto grow = [&](VoidKind kind) {  // a material has one such criterion at most
    result.voids = kind;
    return true;
  };
  if (const auto* spall = as<CriterionOf<failure::TensilePressure>>(criterion)) {
    result.spall_strength = spall->law().spall_strength;
    if (spall->law().cuts_off()) return grow(VoidKind::cut_off);
    result.heals_tension = spall->law().healing_code() != failure::intact;
    return add(CriterionKind::tensile_pressure);
  }
  if (const auto* growth = as<CriterionOf<failure::ViscousVoidGrowth>>(criterion)) {
    const failure::ViscousVoidGrowth& law = growth->law();
    result.void_growth = {law.resistance, law.viscosity, law.nuclei, law.failure_porosity,
                          failure::formulas::tension_at_nuclei(law.nuclei)};
    result.heals_growth = law.healing;
    return grow(VoidKind::viscous_growth);
  }
  if (const auto* ductile = as<CriterionOf<failure::PlasticStrain>>(criterion)) {
    result.failure_strain = ductile->law().failure_strain;
    return add(CriterionKind::plastic_strain);
  }
  if (const auto* fracture = as<CriterionOf<failure::JohnsonCookDamage>>(criterion)) {
    describe(fracture->law(), result.damage);
    return add(CriterionKind::johnson_cook_damage);
  }
  if (const auto* fragments = as<failure::FragmentSize>(criterion)) {
    result.keeps_fragment_size = true;
    result.energy_per_area = fragments->law().energy_per_area;
    return true;
  }
  return false;
}

/// Describes the parts of a material.
/// @returns refusals
std::vector<std::string> describe_parts(const Material& material, MaterialConstants& result,
                                        std::vector<double>& tables) {
  std::vector<std::string> refused;
  const auto refuse = [&](const std::string& what, std::string_view accepted) {
    refused.push_back(fmt::format("material '{}': {}; a device takes {}", material.name, what, accepted));
  };
  if (as<material::EosStrength>(material.constitutive) == nullptr) {
    refuse(fmt::format("[constitutive] model = \"{}\"", material.constitutive->model()),
           "equation of state, strength and failure, nothing that burns or reacts");
    return refused;
  }
  if (!describe_eos(material, result, tables)) {
    const bool modified = material.eos->model() == eos::MieGruneisen::name ||
                          material.eos->model() == eos::Polynomial::name ||
                          material.eos->model() == eos::Table::name;
    const bool porous = material.eos->initial_distension() > 1.0;
    refuse(fmt::format("[eos] model = \"{}\"{}", material.eos->model(),
                       porous     ? " with pores"
                       : modified ? " with a modifier"
                                  : ""),
           porous ? "material without pores"
                  : "\"mie_gruneisen\", \"polynomial\" and \"ideal_gas\" without modifiers, and tables of "
                    "other models: "
                    "equation_of_state = \"table\" of the body");
  }
  if (!describe_strength(material, result)) {
    refuse(fmt::format("[strength] model = \"{}\"", material.strength->model()),
           "\"none\", \"elastic\", \"von_mises\", \"johnson_cook\" and \"steinberg_guinan\"");
  }
  if (material.strength->kinematic_modulus() > 0.0) {
    refuse(fmt::format("[strength] kinematic_modulus = {} Pa", material.strength->kinematic_modulus()),
           "isotropic hardening");
  }
  for (const auto& criterion : material.failure) {
    const std::string what = fmt::format("[[failure]] model = \"{}\"", criterion->model());
    if (describe_criterion(criterion, result)) continue;
    refuse(what,
           "one each of \"tensile_pressure\", \"viscous_void_growth\", \"plastic_strain\", "
           "\"johnson_cook_damage\" and "
           "\"fragment_size\"");
  }
  return refused;
}

}  // namespace

bool needs_table(const Material& material) {
  MaterialConstants unused;
  std::vector<double> tables;
  return !describe_eos(material, unused, tables);
}

std::vector<std::string> refusals(const Material& material) {
  MaterialConstants constants;
  std::vector<double> tables;
  return describe_parts(material, constants, tables);
}

MaterialConstants describe(const Material& material, const UpdateSettings& settings,
                           std::vector<double>& tables) {
  MaterialConstants result;
  const std::vector<std::string> refused = describe_parts(material, result, tables);
  if (!refused.empty()) throw InputError(fmt::format("{}", fmt::join(refused, "\n")));
  result.stores_cold_work = material.stores_cold_work();
  result.taylor_quinney = material.taylor_quinney;
  result.reference_density = material.reference.density;
  result.reference_sound_speed = material.reference.sound_speed;
  result.maximum_density = material.eos->maximum_density();
  result.cell_size = settings.cell_size;
  result.linear_viscosity = settings.linear_viscosity;
  result.quadratic_viscosity = settings.quadratic_viscosity;
  result.expansion_viscosity = settings.expansion_viscosity;
  result.heating = settings.heating;
  result.affine_gain = settings.affine_gain;
  result.affine_compression = settings.affine_compression;
  result.initial_density = settings.initial_density;
  result.rotation = settings.rotation;
  return result;
}

Material tabulated(const Material& material, double error) {
  eos::Table table(eos::tabulate(*material.eos, {.error = error}));
  return with_eos(material, std::make_shared<const eos::TableOfModel>(std::move(table), material.eos));
}

}  // namespace whipple::device
