// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/solid_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/debye_gruneisen.hpp"
#include "eos/models/mie_gruneisen.hpp"
#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/fit/constant_list.hpp"
#include "md_fitting/fit/model_check.hpp"
#include "md_fitting/fit/solid_fit.hpp"
#include "md_fitting/fit/structure_limit.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd free_values(const SolidFit& fit) {
  VectorXd values(static_cast<Index>(fit.model.free.size()));
  for (std::size_t k = 0; k < fit.model.free.size(); ++k) {
    values[static_cast<Index>(k)] = at(fit.constants, fit.model.free[k]);
  }
  return values;
}

/// Maps the fit to a model whose constants are functions of those of the solid, with the covariance of that map.
struct Renamed {
  std::vector<std::string> names;
  MatrixXd jacobian;  ///< d(constant of the model)/d(constant of the solid)
};

Fit renamed(const SolidFit& solid, FitModel model, const Renamed& map,
            std::span<const md::PointRecord> points) {
  Fit fit = solid.report;
  add_structure_remark(fit, points, solid.data);
  fit.model = model;
  fit.fitted_names = map.names;
  fit.covariance = map.jacobian * solid.covariance * map.jacobian.transpose();
  fit.statistical_covariance = map.jacobian * solid.statistical_covariance * map.jacobian.transpose();
  return fit;
}

BootstrapResult replicates(std::span<const md::PointRecord> points, const SolidFit& solid, const Needs& needs,
                           const Renamed& map, const FitSettings& settings, const std::string& store_name) {
  const auto constants = [&](std::span<const md::PointRecord> drawn) {
    Observations data = observe(drawn, settings, needs, store_name);
    remove_superheated(data, solid.constants.gray, solid.superheating, store_name);
    SolidFit moved = solid;
    moved.constants = refit_solid(data, solid);
    return VectorXd(map.jacobian * (free_values(moved) - free_values(solid)));
  };
  constexpr std::uint64_t seed = 1;
  return bootstrap(points, settings.bootstrap, seed, constants);
}

/// Replaces the fitted density by a measured one and removes it from the covariance.
void replace_density(Fit& fit, double& density, Sources& sources) {
  const auto place = std::find(fit.fitted_names.begin(), fit.fitted_names.end(), "reference_density");
  const Index row = place - fit.fitted_names.begin();
  const Index count = fit.covariance.rows();
  sources.measured("reference_density", fmt::format("measured density; the simulations give {}",
                                                    practical_quantity(density, "kg/m^3")));
  density = *fit.settings.density;
  std::vector<Index> kept;
  for (Index k = 0; k < count; ++k) {
    if (k != row) kept.push_back(k);
  }
  fit.covariance = MatrixXd(fit.covariance(kept, kept));
  fit.statistical_covariance = MatrixXd(fit.statistical_covariance(kept, kept));
  fit.fitted_names.erase(place);
}

/// Returns the starting point for an element, with its melting temperature if the table has one.
SolidStart start_of(const Observations& data, const ElementDefaults& table) {
  SolidStart start{fixed_solid(data), {}};
  if (const NamedDefault* melting = table.find("melting_temperature"))
    start.melting_temperature = melting->value;
  return start;
}

}  // namespace

Fit fit_mie_gruneisen(std::span<const md::PointRecord> points, const FitSettings& settings,
                      const std::string& store_name) {
  Observations data = observe(points, settings, {}, store_name);
  const std::string element = data.element;
  const ElementDefaults table = elements::element_defaults(element, settings.defaults);
  const SolidStart start = start_of(data, table);
  SolidModel model;
  model.free = {Place::volume,    Place::intercept,       Place::slope,
                Place::gruneisen, Place::gruneisen_slope, Place::heat_capacity};
  model.hugoniot = true;
  const SolidFit solid = fit_solid(std::move(data), model, start, settings, store_name);

  // Gamma = Gamma0 - a (1 - V/V0) is rho Gamma = rho0 (Gamma0 + b mu) with b = Gamma0 - a.
  const double v0 = solid.constants.gray.reference_specific_volume;
  Renamed map{{"reference_density", "hugoniot_intercept", "hugoniot_slope", "gruneisen", "gruneisen_slope",
               "heat_capacity"},
              MatrixXd::Identity(6, 6)};
  map.jacobian(0, 0) = -1.0 / (v0 * v0);
  map.jacobian(4, 3) = 1.0;
  map.jacobian(4, 4) = -1.0;
  Fit fit = renamed(solid, FitModel::mie_gruneisen, map, points);

  eos::MieGruneisenConstants constants;
  constants.reference_density = 1.0 / v0;
  constants.hugoniot_intercept = solid.constants.gray.hugoniot_intercept;
  constants.hugoniot_slope = solid.constants.gray.hugoniot_slope;
  constants.gruneisen = fit.gruneisen;
  constants.gruneisen_law = eos::CompressedGruneisenLaw::linear;
  constants.gruneisen_slope = fit.gruneisen - fit.gruneisen_slope;
  constants.heat_capacity = solid.constants.heat_capacity;
  constants.reference_temperature = settings.reference_temperature;
  const eos::ModelEquationOfState<eos::MieGruneisen> eos(constants);
  fit.checks = check_solid(
      eos, [&](double V, double T) { return eos.state_at_temperature(1.0 / V, T).pressure; }, solid.data,
      points);
  if (settings.bootstrap > 0) fit.bootstrap = replicates(points, solid, {}, map, settings, store_name);

  Sources sources;
  sources.given("reference_temperature",
                "temperature of the fitted volume and ahead of the simulated shocks");
  for (const char* name : {"hugoniot_quadratic", "hugoniot_cubic"}) {
    sources.entries[name] = {Origin::by_default,
                             "\"linear\": the simulated shocks are fitted by Us = C + S up"};
  }
  if (settings.density) replace_density(fit, constants.reference_density, sources);
  list_constants(fit, whipple::bind(eos::MieGruneisenCurve::parameters(), constants), sources);
  fit.remarks.emplace_back(
      "the model has one heat capacity for nuclei and electrons: the fitted one is that of classical nuclei");
  if (!solid.superheating) {
    fit.remarks.push_back(
        fmt::format("no melting temperature of {} is known: superheated states count as solid (--defaults "
                    "FILE names one)",
                    element));
  }
  return fit;
}

double debye_temperature(double bulk_modulus, double shear_modulus, double volume, double molar_mass) {
  constexpr double hbar = 1.054571817e-34;    // J s
  constexpr double boltzmann = 1.380649e-23;  // J/K
  constexpr double avogadro = 6.02214076e23;  // 1/mol
  constexpr double pi = std::numbers::pi;
  const double transverse = std::sqrt(shear_modulus * volume);
  const double longitudinal = std::sqrt((bulk_modulus + 4.0 / 3.0 * shear_modulus) * volume);
  const double mean = std::cbrt(3.0 / (2.0 / std::pow(transverse, 3) + 1.0 / std::pow(longitudinal, 3)));
  return hbar / boltzmann * std::cbrt(6.0 * pi * pi * avogadro / (molar_mass * volume)) * mean;
}

Fit fit_debye_gruneisen(std::span<const md::PointRecord> points, const FitSettings& settings,
                        const std::string& store_name) {
  const Needs needs{.hugoniot = false, .isotherm = true};
  Observations data = observe(points, settings, needs, store_name);
  const ElementDefaults table = elements::element_defaults(data.element, settings.defaults);
  const bool melts = !data.melting.empty();
  const auto missing =
      elements::missing_constants(FitModel::debye_gruneisen, table,
                                  {.melting = melts,
                                   .vibrations = data.nuclei.contained || !data.elastic.empty(),
                                   .electrons = settings.electrons.has_value()});
  if (!missing.empty()) throw InputError(elements::missing_text(table.element, missing));
  const SolidStart start = start_of(data, table);
  SolidModel model;
  model.free = {Place::volume, Place::bulk_modulus, Place::bulk_modulus_slope, Place::gruneisen,
                Place::gruneisen_slope};
  model.isotherm = true;
  if (melts) model.free.push_back(Place::melting);  // Lindemann's law: the model has no liquid
  const SolidFit solid = fit_solid(std::move(data), model, start, settings, store_name);

  const double v0 = solid.constants.gray.reference_specific_volume;
  const auto count = static_cast<Index>(model.free.size());
  Renamed map{{"reference_density", "bulk_modulus", "bulk_modulus_slope", "gruneisen", "gruneisen_slope"},
              MatrixXd::Identity(count, count)};
  if (melts) map.names.emplace_back("melting_temperature");
  map.jacobian(0, 0) = -1.0 / (v0 * v0);
  Fit fit = renamed(solid, FitModel::debye_gruneisen, map, points);

  Sources sources;
  eos::DebyeGruneisenConstants constants;
  constants.molar_mass = solid.data.molar_mass;
  sources.given("molar_mass", "the store");
  constants.reference_density = 1.0 / v0;
  constants.bulk_modulus = solid.constants.bulk_modulus;
  constants.bulk_modulus_slope = solid.constants.bulk_modulus_slope;
  constants.gruneisen = fit.gruneisen;
  constants.gruneisen_law = eos::LatticeGruneisenLaw::linear;
  constants.gruneisen_slope = fit.gruneisen_slope;
  sources.entries["gruneisen_exponent"] = {Origin::by_default, "\"none\": of no effect with the linear law"};
  constants.electronic_heat_coefficient = electronic_coefficient(table, settings.electrons, sources);
  sources.entries["electronic_gruneisen"] = {Origin::by_default,
                                             "\"free electron gas\": P V = (2/3) E of a free electron gas"};
  constants.reference_temperature = settings.reference_temperature;
  sources.given("reference_temperature", "temperature of the fitted isotherm");
  constants.melting_temperature = solid.constants.gray.melting_temperature;
  if (!melts) sources.by_default(table.at("melting_temperature"));
  const std::vector<ElasticState>& elastic = solid.data.elastic;
  const std::vector<QuantumState>& quantum = solid.data.quantum;
  const bool quantum_nuclei = solid.data.nuclei.contained;
  if (quantum_nuclei) {
    const QuantumState& near = *std::ranges::min_element(
        quantum, {}, [&](const QuantumState& state) { return std::abs(state.volume - v0); });
    constants.debye_temperature = near.debye_temperature;
    sources.given(
        "debye_temperature",
        fmt::format("second moment of the vibrations of the crystal at V/V0 = {:.3f}", near.volume / v0));
  } else if (elastic.empty()) {
    constants.debye_temperature = table.at("debye_temperature").value;
    sources.by_default(table.at("debye_temperature"));
  } else {
    const ElasticState& near = *std::min_element(
        elastic.begin(), elastic.end(),
        [&](const auto& a, const auto& b) { return std::abs(a.volume - v0) < std::abs(b.volume - v0); });
    constants.debye_temperature =
        debye_temperature(near.bulk_modulus, near.shear_modulus, near.volume, solid.data.molar_mass);
    sources.given(
        "debye_temperature",
        fmt::format("speeds of sound of the static crystal at V/V0 = {:.3f} (Hill's moduli {:.4g} and "
                    "{:.4g} GPa)",
                    near.volume / v0, 1e-9 * near.bulk_modulus, 1e-9 * near.shear_modulus));
  }
  const eos::ModelEquationOfState<eos::DebyeGruneisen> eos(constants);
  fit.checks = check_solid(
      eos, [&](double V, double T) { return eos.state_at_temperature(1.0 / V, T).pressure; }, solid.data,
      points);
  if (settings.bootstrap > 0) fit.bootstrap = replicates(points, solid, needs, map, settings, store_name);
  if (settings.density) replace_density(fit, constants.reference_density, sources);
  list_constants(fit, whipple::bind(eos::DebyeGruneisen::parameters(), constants), sources);
  fit.remarks.emplace_back(
      quantum_nuclei
          ? fmt::format("the isotherm contains the pressure of quantum nuclei, by which the volume at zero "
                        "pressure grows by {:.3f} %",
                        100.0 * solid.data.nuclei.expansion)
          : "the isotherm is that of classical nuclei: zero-point motion and quantum heat capacity enter "
            "through the "
            "Debye temperature alone");
  return fit;
}

}  // namespace whipple::fit
