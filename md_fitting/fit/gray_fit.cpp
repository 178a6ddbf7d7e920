// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/gray_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "md_fitting/fit/element_defaults.hpp"
#include "md_fitting/fit/gray_problem.hpp"
#include "md_fitting/fit/laws.hpp"
#include "md_fitting/fit/model_check.hpp"
#include "src/base/error.hpp"
#include "src/base/units.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using eos::GrayConstants;

/// Where the constants that are not fitted come from, by name.
struct Sources {
  struct Entry {
    Origin origin;
    std::string text;
  };
  std::map<std::string, Entry, std::less<>> entries;
};

double* number(const BoundParameter& parameter) {
  double* const* target = std::get_if<double*>(&parameter.target);
  return target == nullptr ? nullptr : *target;
}

void set(GrayConstants& constants, std::string_view name, double value) {
  for (const BoundParameter& parameter : whipple::bind(eos::gray_parameters(), constants)) {
    if (parameter.info.name == name) {
      *number(parameter) = value;
      return;
    }
  }
  throw InternalError(fmt::format("GRAY has no constant '{}'", name));
}

/// The electronic heat coefficient by the name of a choice, or as a quantity.
double electronic_coefficient(const ElementDefaults& table, const std::string& choice, Sources& sources) {
  std::vector<std::string> names;
  for (const NamedDefault& entry : table.electronic) {
    if (entry.name == choice) {
      sources.entries["electronic_heat_coefficient"] = {Origin::by_default,
                                                        fmt::format("\"{}\": {}", entry.name, entry.source)};
      return entry.value;
    }
    names.emplace_back(entry.name);
  }
  try {
    const double value = units::parse_quantity(choice, "J/(mol K^2)");
    sources.entries["electronic_heat_coefficient"] = {Origin::given, "command line"};
    if (value >= 0.0) return value;
  } catch (const InputError&) {
    // Reported below, with the names.
  }
  throw InputError(
      fmt::format("electronic heat coefficient '{}': expected {} or a quantity >= 0 such as "
                  "\"0.69 mJ/(mol K^2)\"",
                  choice, fmt::join(names, ", ")));
}

/// Everything that is not fitted.
GrayConstants fixed_constants(const Observations& data, const FitSettings& settings, Sources& sources) {
  const ElementDefaults& table = element_defaults(data.element);
  GrayConstants constants;
  constants.molar_mass = data.molar_mass;
  sources.entries["molar_mass"] = {Origin::given, "the store"};
  constants.reference_temperature = data.reference_temperature;
  sources.entries["reference_temperature"] = {
      Origin::given, "temperature of the fitted volume and ahead of the simulated shocks"};
  constants.reference_energy = 0.0;
  sources.entries["reference_energy"] = {Origin::by_default,
                                         "\"zero\": energies count from the reference state"};
  constants.melting = settings.melting;
  for (const NamedDefault& entry : table.constants) {
    set(constants, entry.parameter, entry.value);
    sources.entries[std::string(entry.parameter)] = {Origin::by_default,
                                                     fmt::format("\"{}\": {}", entry.name, entry.source)};
  }
  constants.electronic_heat_coefficient = electronic_coefficient(table, settings.electronic, sources);
  const NamedDefault& melting = table.melting_temperature;
  constants.melting_temperature = melting.value;
  sources.entries["melting_temperature"] = {Origin::by_default,
                                            fmt::format("\"{}\": {}", melting.name, melting.source)};
  return constants;
}

/// Start values of the fitted constants: straight lines through the data.
void add_start_values(const Observations& data, const FitSettings& settings, GrayConstants& constants) {
  const double v0 = data.reference_volume.value;
  constants.reference_specific_volume = v0;
  std::vector<double> x;
  std::vector<double> y;
  for (const HugoniotState& state : data.hugoniot) {
    if (state.particle_velocity < settings.least_particle_velocity ||
        state.particle_velocity > settings.most_particle_velocity) {
      continue;
    }
    const auto [us, up] = GrayProblem::velocities(state, v0);
    x.push_back(up);
    y.push_back(us);
  }
  const Line hugoniot = fit_line(x, y);
  constants.hugoniot_intercept = hugoniot.intercept;
  constants.hugoniot_slope = hugoniot.slope;
  x.clear();
  y.clear();
  for (const Isochore& isochore : data.isochores) {
    std::vector<double> energy;
    std::vector<double> pressure;
    for (const ThermalState& state : isochore.states) {
      energy.push_back(state.energy.value - isochore.states.front().energy.value);
      pressure.push_back(state.pressure.value - isochore.states.front().pressure.value);
    }
    x.push_back(isochore.volume / v0 - 1.0);
    y.push_back(fit_line(energy, pressure).slope * isochore.volume);
  }
  const Line gruneisen = fit_line(x, y);
  constants.gruneisen = gruneisen.intercept;
  constants.gruneisen_slope = gruneisen.slope;
  if (!(constants.hugoniot_intercept > 0.0 && constants.hugoniot_slope > 0.0 && constants.gruneisen > 0.0)) {
    throw StateError(fmt::format(
        "the data are not those of a compressed solid: straight lines give C = {:.4g} m/s, S = {:.4g} and "
        "gamma0 = {:.4g}; all must be positive",
        constants.hugoniot_intercept, constants.hugoniot_slope, constants.gruneisen));
  }
}

IsochoreGruneisen isochore_gruneisen(const Isochore& isochore) {
  double slope = 0.0;
  double error = 0.0;
  for (int pass = 0; pass < 3; ++pass) {  // the weights hold the slope
    double w = 0, we = 0, wp = 0, wee = 0, wep = 0;
    for (const ThermalState& state : isochore.states) {
      const double variance = std::pow(state.pressure.error, 2) + std::pow(slope * state.energy.error, 2) -
                              2.0 * slope * state.correlation * state.pressure.error * state.energy.error;
      const double weight = variance > 0.0 ? 1.0 / variance : 1.0;
      const double e = state.energy.value - isochore.states.front().energy.value;
      const double p = state.pressure.value - isochore.states.front().pressure.value;
      w += weight;
      we += weight * e;
      wp += weight * p;
      wee += weight * e * e;
      wep += weight * e * p;
    }
    const double determinant = w * wee - we * we;
    slope = (w * wep - we * wp) / determinant;
    error = std::sqrt(w / determinant);
  }
  return {isochore.volume, slope * isochore.volume, error * isochore.volume,
          static_cast<int>(isochore.states.size())};
}

/// Leaves out superheated solid: above T_m(V) the crystal is metastable, and its energy does not follow the
/// law.
int remove_superheated(Observations& data, const GrayConstants& constants, const std::string& store_name) {
  int removed = 0;
  for (Isochore& isochore : data.isochores) {
    const double limit = melting_temperature(constants, isochore.volume);
    removed += static_cast<int>(
        std::erase_if(isochore.states, [&](const ThermalState& state) { return state.temperature > limit; }));
  }
  std::erase_if(data.isochores, [](const Isochore& isochore) { return isochore.states.size() < 3; });
  if (data.isochores.size() < 2) {
    throw InputError(
        fmt::format("{}: points are missing:\n  protocol \"isochore\": fewer than 2 volumes keep 3 "
                    "temperatures below the melting curve",
                    store_name));
  }
  return removed;
}

/// Solves until the point about which the solidus is linear is the solution.
GrayConstants converged(const Observations& data, const FitSettings& settings, GrayConstants constants) {
  constexpr int most_passes = 30;
  for (int pass = 0; pass < most_passes; ++pass) {
    const GrayProblem problem(data, settings, constants);
    const VectorXd step = solve(problem.least_squares()).parameters;
    constants = problem.constants_at(step);
    const double change = step.head(problem.constants()).lpNorm<Eigen::Infinity>();
    if (change < 1e-7 || data.melting.empty()) return constants;
  }
  throw StateError("the fit of the melting temperature does not settle");
}

std::vector<Residual> residual_rows(const GrayProblem& problem, const Observations& data,
                                    const LeastSquaresProblem& weights, const LeastSquaresSolution& solution,
                                    double v0) {
  std::vector<Residual> rows;
  const VectorXd& r = solution.residuals;
  const auto add = [&](const char* quantity, double volume, double temperature, double abscissa, double datum,
                       Index row) {
    rows.push_back({quantity, volume, temperature, abscissa, datum, datum - r[row],
                    std::sqrt(weights.statistical(row, row) + weights.model(row, row))});
  };
  add("volume", data.reference_volume.value, data.reference_temperature, data.reference_temperature,
      data.reference_volume.value, 0);
  Index row = problem.hugoniot_begin();
  for (const HugoniotState& state : problem.window()) {
    const auto [us, up] = GrayProblem::velocities(state, v0);
    add("shock_velocity", state.volume, 0.0, up, us, row++);
  }
  for (const Isochore& isochore : data.isochores) {
    const ThermalState& cold = isochore.states.front();
    for (const ThermalState& state : isochore.states) {
      const double energy = state.energy.value - cold.energy.value;
      add("thermal_pressure", isochore.volume, state.temperature, energy,
          state.pressure.value - cold.pressure.value, row++);
      add("thermal_energy", isochore.volume, state.temperature, state.temperature, energy, row++);
    }
  }
  for (const MeltingPoint& point : data.melting) {
    add("melting", point.solid_volume.value, point.temperature.value, point.pressure, point.temperature.value,
        row++);
  }
  return rows;
}

std::vector<ChiSquaredPart> chi_squared_parts(const GrayProblem& problem, const VectorXd& whitened) {
  const auto part = [&](const char* quantity, Index begin, Index end) {
    return ChiSquaredPart{quantity, whitened.segment(begin, end - begin).squaredNorm(),
                          static_cast<int>(end - begin)};
  };
  std::vector<ChiSquaredPart> parts = {
      part("volume at zero pressure", 0, problem.hugoniot_begin()),
      part("shock velocity", problem.hugoniot_begin(), problem.isochores_begin()),
      part("pressure and energy of the isochores", problem.isochores_begin(), problem.melting_begin())};
  if (problem.melting_begin() < problem.size()) {
    parts.push_back(part("melting temperature", problem.melting_begin(), problem.size()));
  }
  return parts;
}

/// C and S of other windows: what the choice of the window does to them.
std::vector<WindowResult> other_windows(const Observations& data, const FitSettings& settings,
                                        const GrayConstants& start, const WindowResult& own) {
  constexpr std::array<std::pair<double, double>, 6> windows = {
      {{0.0, 1000.0}, {0.0, 1500.0}, {0.0, 2000.0}, {0.0, 3000.0}, {300.0, 1500.0}, {1000.0, 3000.0}}};
  std::vector<WindowResult> results = {own};
  for (const auto& [least, most] : windows) {
    FitSettings other = settings;
    other.least_particle_velocity = least;
    other.most_particle_velocity = most;
    const GrayProblem problem(data, other, start);
    if (problem.window().size() < 3) continue;
    const GrayConstants fitted = problem.constants_at(solve(problem.least_squares()).parameters);
    results.push_back({least, most, static_cast<int>(problem.window().size()), fitted.hugoniot_intercept,
                       fitted.hugoniot_slope});
  }
  return results;
}

/// T_m0 such that T_m(V) itself runs through the coexistence points: geometric mean of T/(T_m(V)/T_m0).
std::optional<double> isochoric_melting_temperature(const Observations& data, GrayConstants constants) {
  if (data.melting.empty()) return std::nullopt;
  constants.melting_temperature = 1.0;
  double sum = 0.0;
  for (const MeltingPoint& point : data.melting) {
    sum += std::log(point.temperature.value / melting_temperature(constants, point.solid_volume.value));
  }
  return std::exp(sum / static_cast<double>(data.melting.size()));
}

std::string practical_unit(const std::string& si_unit) {
  static const std::map<std::string, std::string, std::less<>> units = {
      {"kg/mol", "g/mol"},       {"m^3/kg", "cm^3/g"},          {"m/s", "km/s"},
      {"J/kg", "kJ/g"},          {"J m^3/kg^2", "kJ cm^3/g^2"}, {"J/(mol K^2)", "mJ/(mol K^2)"},
      {"J/(mol K)", "J/(mol K)"}};
  const auto found = units.find(si_unit);
  return found == units.end() ? si_unit : found->second;
}

}  // namespace

std::string practical_quantity(double value, const std::string& si_unit) {
  const std::string unit = practical_unit(si_unit);
  const std::string digits = fmt::format("{:.8g}", units::convert(value, si_unit, unit));
  return unit.empty() || unit == "1" ? digits : fmt::format("{} {}", digits, unit);
}

double as_written(double value, const std::string& si_unit) {
  return units::parse_quantity(practical_quantity(value, si_unit), si_unit);
}

const Constant& GrayFit::constant(std::string_view name) const {
  const auto found = std::find_if(constants.begin(), constants.end(),
                                  [&](const Constant& entry) { return entry.name == name; });
  if (found == constants.end()) throw InternalError(fmt::format("the fit has no constant '{}'", name));
  return *found;
}

Eigen::MatrixXd GrayFit::correlation() const {
  const VectorXd inverse = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return inverse.asDiagonal() * covariance * inverse.asDiagonal();
}

GrayFit fit_gray(std::span<const md::PointRecord> points, const FitSettings& settings,
                 const std::string& store_name) {
  Observations data = observe(points, settings.reference_temperature, settings.least_particle_velocity,
                              settings.most_particle_velocity, store_name);
  Sources sources;
  GrayConstants start = fixed_constants(data, settings, sources);
  add_start_values(data, settings, start);

  GrayFit fit;
  fit.settings = settings;
  fit.element = data.element;
  fit.potential = data.potential;
  start = converged(data, settings, start);
  fit.superheated_states = remove_superheated(data, start, store_name);
  start = converged(data, settings, start);
  const GrayProblem problem(data, settings, start);
  const LeastSquaresProblem weights = problem.least_squares();
  const LeastSquaresSolution solution = solve(weights);
  fit.gray = problem.constants_at(solution.parameters);
  fit.fitted_names = problem.fitted_names();
  const auto count = static_cast<Index>(fit.fitted_names.size());
  const VectorXd scale = problem.scale(fit.gray);
  fit.covariance = scale.asDiagonal() * solution.covariance.topLeftCorner(count, count) * scale.asDiagonal();
  fit.statistical_covariance =
      scale.asDiagonal() * solution.statistical_covariance.topLeftCorner(count, count) * scale.asDiagonal();
  fit.chi_squared = solution.chi_squared;
  fit.degrees_of_freedom = solution.degrees_of_freedom;
  fit.chi_squared_parts = chi_squared_parts(problem, solution.whitened);
  fit.fitted_reference_volume = fit.gray.reference_specific_volume;
  fit.residuals = residual_rows(problem, data, weights, solution, fit.fitted_reference_volume);
  for (const Isochore& isochore : data.isochores) fit.isochores.push_back(isochore_gruneisen(isochore));
  fit.isochoric_melting_temperature = isochoric_melting_temperature(data, fit.gray);
  fit.windows = other_windows(
      data, settings, fit.gray,
      {settings.least_particle_velocity, settings.most_particle_velocity,
       static_cast<int>(problem.window().size()), fit.gray.hugoniot_intercept, fit.gray.hugoniot_slope});
  try {
    fit.checks = check_model(fit.gray, data, points);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: the fitted constants make no complete material with the electronic heat "
                    "coefficient '{}': {}",
                    store_name, settings.electronic, error.what()));
  }

  if (settings.density) {
    fit.gray.reference_specific_volume = 1.0 / *settings.density;
    sources.entries["reference_specific_volume"] = {
        Origin::given, fmt::format("measured density {}; the simulations give {}",
                                   units::format_quantity(*settings.density, "kg/m^3"),
                                   practical_quantity(fit.fitted_reference_volume, "m^3/kg"))};
    // Every other fitted constant is a function of V/V0: only the row of V0 leaves the covariance.
    fit.fitted_names.erase(fit.fitted_names.begin());
    fit.covariance = Eigen::MatrixXd(fit.covariance.bottomRightCorner(count - 1, count - 1));
    fit.statistical_covariance =
        Eigen::MatrixXd(fit.statistical_covariance.bottomRightCorner(count - 1, count - 1));
  }
  for (const BoundParameter& parameter : whipple::bind(eos::gray_parameters(), fit.gray)) {
    double* value = number(parameter);
    if (value == nullptr || !std::isfinite(*value)) continue;  // words, "same as the solid", not given
    *value = as_written(*value, parameter.info.unit);
    Constant constant;
    constant.name = parameter.info.name;
    constant.unit = parameter.info.unit;
    constant.meaning = parameter.info.meaning;
    constant.value = *value;
    const auto place = std::find(fit.fitted_names.begin(), fit.fitted_names.end(), constant.name);
    if (place != fit.fitted_names.end()) {
      const Index row = place - fit.fitted_names.begin();
      constant.origin = Origin::fitted;
      constant.error = std::sqrt(fit.covariance(row, row));
      constant.statistical_error = std::sqrt(fit.statistical_covariance(row, row));
    } else {
      const auto source = sources.entries.find(constant.name);
      if (source == sources.entries.end()) {
        throw InternalError(fmt::format("the fit has no source for the constant '{}'", constant.name));
      }
      constant.origin = source->second.origin;
      constant.source = source->second.text;
    }
    fit.constants.push_back(constant);
  }
  return fit;
}

}  // namespace whipple::fit
