// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/gray_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <iterator>
#include <stdexcept>

#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/fit/constant_list.hpp"
#include "md_fitting/fit/joint/joint_fit.hpp"
#include "md_fitting/fit/model_check.hpp"
#include "md_fitting/fit/solid_fit.hpp"
#include "md_fitting/fit/structure_limit.hpp"
#include "md_fitting/fit/table_access.hpp"
#include "md_fitting/fit/vapour_fit.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using eos::GrayConstants;

/// Steps from the element's choice of V_J/V0 to alternative values, in the order in which they are tried if the
/// fitted constants do not form a complete material or have no melt at the simulated melting point.
constexpr std::array join_steps = {0.0, -0.05, 0.05, -0.1, 0.1};

bool has_vapour(const Observations& data) { return data.saturation.size() >= elements::least_saturations; }

/// Takes the unfitted vapour constant from the table: boiling temperature, attraction, or none with saturated
/// densities.
void fix_vapour(GrayConstants& constants, const ElementDefaults& table, Sources& sources) {
  const bool boils = table.find("vapour_attraction") == nullptr;
  const char* const parameter = boils ? "boiling_temperature" : "vapour_attraction";
  const NamedDefault* entry = table.find(parameter);
  if (entry == nullptr) return;
  constants.vapour = boils ? eos::VapourCondition::boiling : eos::VapourCondition::attraction;
  number_of(constants, parameter) = entry->value;
  sources.by_default(*entry);
}

/// Collects all constants that are not fitted.
/// @param join_step  relative to V_J/V0 of the table
SolidStart fixed_constants(const Observations& data, const ElementDefaults& table,
                           const FitSettings& settings, double join_step, Sources& sources) {
  const auto missing = elements::missing_constants(FitModel::gray, table,
                                                   {.melting = !data.melting.empty(),
                                                    .vapour = has_vapour(data),
                                                    .electrons = settings.electrons.has_value()});
  if (!missing.empty()) throw InputError(elements::missing_text(table.element, missing));
  SolidStart start{fixed_solid(data), {}};
  GrayConstants& constants = start.constants.gray;
  sources.given("molar_mass", "the store");
  sources.given("reference_temperature",
                "temperature of the fitted volume and ahead of the simulated shocks");
  sources.entries["reference_energy"] = {Origin::by_default,
                                         "\"zero\": energies count from the reference state"};
  constants.melting = settings.melting;
  for (const char* parameter :
       {"hugoniot_quadratic", "hugoniot_cubic", "electronic_gruneisen", "melting_entropy",
        "liquid_heat_coefficient", "hot_liquid_ratio", "covolume_ratio", "join_shape", "join_volume_ratio"}) {
    const NamedDefault& entry = table.at(parameter);
    number_of(constants, parameter) = entry.value;
    sources.by_default(entry);
  }
  fix_vapour(constants, table, sources);
  constants.join_volume_ratio += join_step;
  constants.electronic_heat_coefficient = electronic_coefficient(table, settings.electrons, sources);
  const NamedDefault* melting = table.find("melting_temperature");
  if (melting == nullptr && !data.melting.empty()) melting = table.find("melting_point");
  if (melting != nullptr) {
    start.melting_temperature = melting->value;
    sources.by_default(*melting);
  }
  return start;
}

SolidModel gray_model(const Observations& data) {
  SolidModel model;
  model.free = {Place::volume,    Place::intercept,       Place::slope,
                Place::gruneisen, Place::gruneisen_slope, Place::anharmonic};
  model.hugoniot = model.surface = true;
  if (!data.melting.empty()) model.free.push_back(Place::melting);
  if (std::any_of(data.melting.begin(), data.melting.end(),
                  [](const auto& p) { return p.latent_heat.has_value(); })) {
    model.free.push_back(Place::entropy);
  }
  return model;
}

/// Appends the constants of the vapour to the covariance of the others.
void append(GrayFit& fit, const VapourFit& vapour) {
  const auto joined = [&](const MatrixXd& solid, const MatrixXd& own) {
    const Index n = solid.rows();
    const Index m = own.rows();
    MatrixXd all(n + m, n + m);
    all.topLeftCorner(n, n) = solid;
    all.bottomLeftCorner(m, n) = vapour.sensitivity * solid;
    all.topRightCorner(n, m) = all.bottomLeftCorner(m, n).transpose();
    all.bottomRightCorner(m, m) = own;
    return all;
  };
  fit.covariance = joined(fit.covariance, vapour.covariance);
  fit.statistical_covariance = joined(fit.statistical_covariance, vapour.statistical_covariance);
  fit.gray.vapour = eos::VapourCondition::attraction;
  fit.gray.boiling_temperature = GrayConstants::not_given;
  for (std::size_t k = 0; k < vapour.names.size(); ++k) {
    number_of(fit.gray, vapour.names[k]) = vapour.values[static_cast<Index>(k)];
    fit.fitted_names.push_back(vapour.names[k]);
  }
  fit.chi_squared_parts.push_back({.quantity = "saturated densities",
                                   .chi_squared = vapour.chi_squared / (vapour.inflation * vapour.inflation),
                                   .data = vapour.degrees_of_freedom + static_cast<int>(vapour.names.size()),
                                   .inflation = vapour.inflation});
  if (!vapour.remark.empty()) fit.remarks.push_back(vapour.remark);
}

void add_vapour(GrayFit& fit, const Observations& data) {
  if (data.saturation.empty()) return;
  if (!has_vapour(data)) {
    fit.remarks.emplace_back(
        "saturated densities at one temperature only: a_y and V_J stay at their defaults");
    return;
  }
  try {
    append(fit, fit_vapour(fit.gray, data.saturation, fit.settings.model_errors, fit.settings.inflation,
                           {fit.fitted_names, fit.covariance, fit.statistical_covariance}));
  } catch (const StateError& error) {
    fit.remarks.push_back(
        fmt::format("saturated densities not used, a_y and V_J stay at their defaults: {}", error.what()));
    return;
  }
  for (const SaturationState& state : data.saturation) {
    const auto [liquid, vapour] = saturated_densities(fit.gray, state.temperature);
    const auto add = [&](const char* quantity, const md::Estimate& datum, double fitted, double misfit) {
      fit.residuals.push_back({quantity, 1.0 / datum.value, state.temperature, state.temperature, datum.value,
                               fitted, std::hypot(datum.error, misfit * datum.value)});
    };
    add("liquid_density", state.liquid_density, liquid, fit.settings.model_errors.liquid_density);
    add("vapour_density", state.vapour_density, vapour, fit.settings.model_errors.vapour_density);
  }
}

/// Bootstraps the fitted solid constants, under GRAY's names, over replicates of the database.
BootstrapResult bootstrap_gray(std::span<const md::PointRecord> points, const SolidFit& fit,
                               const FitSettings& settings, const std::string& store_name) {
  const auto constants = [&](std::span<const md::PointRecord> drawn) {
    Observations data = observe(drawn, settings, {}, store_name);
    remove_superheated(data, fit.constants.gray, fit.superheating, store_name);
    const SolidConstants found = refit_solid(data, fit);
    Eigen::VectorXd values(static_cast<Index>(fit.model.free.size()));
    for (std::size_t k = 0; k < fit.model.free.size(); ++k)
      values[static_cast<Index>(k)] = at(found, fit.model.free[k]);
    return values;
  };
  constexpr std::uint64_t seed = 1;
  return bootstrap(points, settings.bootstrap, seed, constants);
}

/// Reads the measured curves of a fit, and takes the density of the metal from them if the settings give none.
std::vector<MeasuredCurve> measured_curves(std::span<const md::PointRecord> points, FitSettings& settings,
                                           const std::string& store_name) {
  if (settings.measured.empty()) return {};
  const ElementDefaults table =
      elements::element_defaults(observe(points, settings, {}, store_name).element, settings.defaults);
  const NamedDefault* debye = table.find("debye_temperature");
  const auto read = [&](const std::vector<std::filesystem::path>& files) {
    return read_curves(files, table.metal, debye ? std::optional(debye->value) : std::nullopt);
  };
  std::vector<MeasuredCurve> curves = read(settings.measured);
  if (!settings.density) settings.density = initial_density(curves);
  if (!settings.density) {
    throw InputError(
        "--with: none of the tables states the initial density (rho0_g_cm3); give the measured one with "
        "--density");
  }
  for (MeasuredCurve& curve : read(settings.checked)) {
    curve.fitted = false;
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// Replaces the fitted volume by a measured density.
void replace_volume(GrayFit& fit, double density, Sources& sources) {
  const double ratio = 1.0 / (density * fit.fitted_reference_volume);
  fit.gray.reference_specific_volume = 1.0 / density;
  sources.measured(
      "reference_specific_volume",
      fmt::format("measured density {}; the simulations give {}", units::format_quantity(density, "kg/m^3"),
                  practical_quantity(fit.fitted_reference_volume, "m^3/kg")));
  // Every other fitted constant is a function of V/V0, except a_y, which is scaled to keep a_y/V0 and hence the
  // critical temperature: only the row of V0 is removed from the covariance.
  const Index count = fit.covariance.rows();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(count);
  for (std::size_t k = 0; k < fit.fitted_names.size(); ++k) {
    if (fit.fitted_names[k] != "vapour_attraction") continue;
    scale[static_cast<Index>(k)] = ratio;
    fit.gray.vapour_attraction *= ratio;
  }
  for (MatrixXd* matrix : {&fit.covariance, &fit.statistical_covariance}) {
    const MatrixXd scaled = scale.asDiagonal() * *matrix * scale.asDiagonal();
    *matrix = scaled.bottomRightCorner(count - 1, count - 1);
  }
  fit.fitted_names.erase(fit.fitted_names.begin());
}

GrayFit fit_with_join(std::span<const md::PointRecord> points, const FitSettings& settings,
                      const std::vector<MeasuredCurve>& curves, const std::string& store_name,
                      double join_step) {
  Observations data = observe(points, settings, {}, store_name);
  Sources sources;
  const ElementDefaults table = elements::element_defaults(data.element, settings.defaults);
  const SolidStart fixed = fixed_constants(data, table, settings, join_step, sources);
  const SolidModel model = gray_model(data);
  GrayFit fit;
  fit.solid = fit_solid(std::move(data), model, fixed, settings, store_name);
  SolidFit& solid = fit.solid;
  std::optional<JointResult> joint;
  if (!curves.empty()) joint = fit_jointly(solid, curves, settings.density.value());
  static_cast<Fit&>(fit) = solid.report;
  fit.joint = std::move(joint);
  fit.model = FitModel::gray;
  fit.gray = solid.constants.gray;
  for (const Place place : solid.model.free) fit.fitted_names.emplace_back(name_of(place));
  fit.covariance = solid.covariance;
  fit.statistical_covariance = solid.statistical_covariance;
  add_structure_remark(fit, points, solid.data);
  add_vapour(fit, solid.data);
  if (fit.gray.vapour == eos::VapourCondition::attraction && !std::isfinite(fit.gray.vapour_attraction)) {
    throw InputError(fmt::format("{}: {}; {}", store_name, fit.remarks.back(),
                                 elements::missing_text(table.element, {"boiling_temperature"})));
  }
  try {
    fit.checks = check_gray(fit.gray, solid.data, points);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: the fitted constants make no complete material with the electronic heat "
                    "coefficient {:.3g} mJ/(mol K^2): {}",
                    store_name, 1e3 * fit.gray.electronic_heat_coefficient, error.what()));
  }
  if (settings.bootstrap > 0) fit.bootstrap = bootstrap_gray(points, solid, settings, store_name);
  const GrayConstants simulated = fit.gray;
  if (settings.density) replace_volume(fit, *settings.density, sources);
  if (settings.correction) {
    std::vector<MeasuredCurve> measured;
    std::ranges::copy_if(curves, std::back_inserter(measured), &MeasuredCurve::fitted);
    fit.correction =
        fit_correction({points, simulated, fit.gray, measured}, settings.correction_samples, settings.seed);
  }
  list_constants(fit, whipple::bind(eos::gray_parameters(), fit.gray), sources);
  return fit;
}

}  // namespace

GrayFit fit_gray(std::span<const md::PointRecord> points, const FitSettings& settings,
                 const std::string& store_name) {
  FitSettings complete = settings;
  const std::vector<MeasuredCurve> curves = measured_curves(points, complete, store_name);
  std::exception_ptr first;
  std::string reason;
  for (const double step : join_steps) {
    try {
      GrayFit fit = fit_with_join(points, complete, curves, store_name, step);
      if (step != 0.0) {
        fit.remarks.push_back(fmt::format("V_J/V0 {} by {:.2f} from the element's default, with which: {}",
                                          step > 0.0 ? "raised" : "lowered", std::abs(step), reason));
      }
      return fit;
    } catch (const DrawsRefused&) {  // the most probable one is a material: another V_J is no remedy
      throw;
    } catch (const std::runtime_error& error) {  // InputError or StateError
      if (first) continue;
      first = std::current_exception();
      reason = error.what();
    }
  }
  std::rethrow_exception(first);
}

}  // namespace whipple::fit
