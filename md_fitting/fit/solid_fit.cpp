// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/solid_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "md_fitting/fit/laws.hpp"
#include "md_fitting/fit/scaled_fit.hpp"
#include "md_fitting/fit/solid_problem.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using eos::GrayConstants;

/// Estimates C and S by a straight line through the Hugoniot states of the window.
void guess_hugoniot(const Observations& data, const FitSettings& settings, GrayConstants& constants) {
  std::vector<double> x;
  std::vector<double> y;
  for (const HugoniotState& state : data.hugoniot) {
    if (state.particle_velocity < settings.least_particle_velocity ||
        state.particle_velocity > settings.most_particle_velocity) {
      continue;
    }
    const auto [us, up] = SolidProblem::velocities(state, constants.reference_specific_volume);
    x.push_back(up);
    y.push_back(us);
  }
  const Line line = fit_line(x, y);
  constants.hugoniot_intercept = line.intercept;
  constants.hugoniot_slope = line.slope;
  if (!(line.intercept > 0.0 && line.slope > 0.0)) {
    throw StateError(
        fmt::format("the data are not those of a compressed solid: the straight line gives C = {:.4g} m/s "
                    "and S = {:.4g}; both "
                    "must be positive",
                    line.intercept, line.slope));
  }
}

/// Estimates gamma0 and a from the slope of P against E of each isochore, and a straight line through these slopes.
void guess_gruneisen(const Observations& data, GrayConstants& constants) {
  std::vector<double> x;
  std::vector<double> y;
  for (const Isochore& isochore : data.isochores) {
    std::vector<double> energy;
    std::vector<double> pressure;
    for (const ThermalState& state : isochore.states) {
      energy.push_back(state.energy.value - isochore.states.front().energy.value);
      pressure.push_back(state.pressure.value - isochore.states.front().pressure.value);
    }
    x.push_back(isochore.volume / constants.reference_specific_volume - 1.0);
    y.push_back(fit_line(energy, pressure).slope * isochore.volume);
  }
  const Line line = fit_line(x, y);
  constants.gruneisen = line.intercept;
  constants.gruneisen_slope = line.slope;
  if (!(line.intercept > 0.0)) {
    throw StateError(
        fmt::format("the data are not those of a compressed solid: the isochores give gamma0 = {:.4g}; it "
                    "must be positive",
                    line.intercept));
  }
}

/// Estimates K0 and K0': for each K0' in a list, K0 by linear least squares.
void guess_isotherm(const Observations& data, SolidConstants& constants) {
  double least = std::numeric_limits<double>::infinity();
  SolidConstants trial = constants;
  trial.bulk_modulus = 1.0;
  for (double slope = 2.0; slope <= 9.0; slope += 0.5) {
    trial.bulk_modulus_slope = slope;
    double shape_data = 0.0, shape_shape = 0.0, data_data = 0.0;
    for (const IsothermState& state : data.isotherm) {
      const double shape = isotherm_pressure(trial, state.volume);
      shape_data += shape * state.pressure.value;
      shape_shape += shape * shape;
      data_data += state.pressure.value * state.pressure.value;
    }
    const double misfit = data_data - shape_data * shape_data / shape_shape;
    if (misfit < least) {
      least = misfit;
      constants.bulk_modulus = shape_data / shape_shape;
      constants.bulk_modulus_slope = slope;
    }
  }
  if (!(constants.bulk_modulus > 0.0)) {
    throw StateError(
        "the data are not those of a compressed solid: the isotherm gives no positive bulk modulus");
  }
}

IsochoreGruneisen isochore_gruneisen(const Isochore& isochore) {
  double slope = 0.0;
  double error = 0.0;
  for (int pass = 0; pass < 3; ++pass) {  // the weights depend on the slope
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

std::vector<Residual> residual_rows(const SolidProblem& problem, const SolidModel& model,
                                    const Observations& data, const LeastSquaresProblem& weights,
                                    const LeastSquaresSolution& solution, double v0) {
  std::vector<Residual> rows;
  const VectorXd& r = solution.residuals;
  Index row = 0;
  const auto add = [&](const char* quantity, double volume, double temperature, double abscissa,
                       double datum) {
    rows.push_back({quantity, volume, temperature, abscissa, datum, datum - r[row],
                    std::sqrt(weights.statistical(row, row) + weights.model(row, row))});
    ++row;
  };
  add("volume", data.reference_volume.value, data.reference_temperature, data.reference_temperature,
      data.reference_volume.value);
  for (const HugoniotState& state : problem.window()) {
    const auto [us, up] = SolidProblem::velocities(state, v0);
    add("shock_velocity", state.volume, 0.0, up, us);
  }
  if (model.isotherm) {
    for (const IsothermState& state : data.isotherm) {
      add("isotherm_pressure", state.volume, data.reference_temperature, state.volume, state.pressure.value);
    }
  }
  for (const Isochore& isochore : data.isochores) {
    const ThermalState& cold = isochore.states.front();
    for (const ThermalState& state : isochore.states) {
      const double energy = state.energy.value - cold.energy.value;
      add("thermal_pressure", isochore.volume, state.temperature, energy,
          state.pressure.value - cold.pressure.value);
      add("thermal_energy", isochore.volume, state.temperature, state.temperature, energy);
    }
  }
  const auto add_melting = [&](const char* quantity, const MeltingPoint& point, double datum) {
    add(quantity, point.solid_volume.value, point.temperature.value, point.pressure, datum);
  };
  if (model.fits(Place::melting)) {
    for (const MeltingPoint& point : data.melting) add_melting("melting", point, point.temperature.value);
  }
  if (model.fits(Place::entropy)) {
    for (const MeltingPoint& point : data.melting) {
      if (point.latent_heat) add_melting("latent_heat", point, point.latent_heat->value);
    }
  }
  return rows;
}

std::vector<ChiSquaredPart> chi_squared_parts(const SolidProblem& problem,
                                              const LeastSquaresSolution& solution, const ModelScale& scale) {
  std::vector<ChiSquaredPart> parts;
  for (const Datum& datum : problem.data()) {
    if (parts.empty() || parts.back().quantity != datum.quantity) {
      parts.push_back({.quantity = datum.quantity, .inflation = scale.of(datum.kind)});
    }
    parts.back().chi_squared += solution.whitened.segment(datum.begin, datum.rows).squaredNorm();
    parts.back().data += static_cast<int>(datum.rows);
  }
  return parts;
}

/// Returns T_m0 such that T_m(V) passes through the coexistence points: geometric mean of T/(T_m(V)/T_m0).
std::optional<double> isochoric_melting_temperature(const Observations& data, GrayConstants constants) {
  if (data.melting.empty()) return std::nullopt;
  constants.melting_temperature = 1.0;
  double sum = 0.0;
  for (const MeltingPoint& point : data.melting) {
    sum += std::log(point.temperature.value / melting_temperature(constants, point.solid_volume.value));
  }
  return std::exp(sum / static_cast<double>(data.melting.size()));
}

}  // namespace

SolidConstants fixed_solid(const Observations& data) {
  SolidConstants constants;
  constants.gray.molar_mass = data.molar_mass;
  constants.gray.reference_temperature = data.reference_temperature;
  constants.gray.reference_energy = 0.0;
  constants.heat_capacity = 3.0 * GrayConstants::gas_constant / data.molar_mass;
  return constants;
}

int remove_superheated(Observations& data, GrayConstants constants, std::optional<double> melting,
                       const std::string& store_name) {
  int removed = 0;
  for (Isochore& isochore : data.isochores) {
    if (!melting) break;
    constants.melting_temperature = *melting;
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

SolidFit fit_solid(Observations data, const SolidModel& model, const SolidStart& known,
                   const FitSettings& settings, const std::string& store_name) {
  SolidFit fit;
  fit.model = model;
  SolidConstants start = known.constants;
  start.gray.reference_specific_volume = data.reference_volume.value;
  if (model.hugoniot) guess_hugoniot(data, settings, start.gray);
  if (model.isotherm) guess_isotherm(data, start);
  guess_gruneisen(data, start.gray);
  const std::optional<double> melting =
      known.melting_temperature ? known.melting_temperature : isochoric_melting_temperature(data, start.gray);
  if (melting) start.gray.melting_temperature = *melting;

  start = converged(data, model, independent_errors(settings), start);
  const bool melts = model.fits(Place::melting);
  if (melts) {
    fit.superheating = start.gray.melting_temperature;
  } else {  // superheated states are also excluded for a model without melting
    fit.superheating = isochoric_melting_temperature(data, start.gray);
    if (!fit.superheating) fit.superheating = known.melting_temperature;
  }
  fit.report.superheated_states = remove_superheated(data, start.gray, fit.superheating, store_name);
  Fit& report = fit.report;
  report.settings = settings;
  ScaledFit own, result;
  if (model.hugoniot) {
    const WindowFits windows = fit_windows(data, model, settings, start);
    const WindowFit& first = windows.settled.front();
    report.settings.least_particle_velocity = first.least;
    report.settings.most_particle_velocity = first.most;
    own = first.fit;
    result = mean_of(windows.settled, model);
    for (const WindowFit& window : windows.settled) {
      const GrayConstants& gray = window.fit.constants.gray;
      report.windows.push_back({window.least, window.most, window.states, window.weight,
                                gray.hugoniot_intercept, gray.hugoniot_slope});
    }
    for (const UnsettledWindow& window : windows.left_out) {
      report.remarks.push_back(
          fmt::format("particle velocities of {:.2f} ... {:.2f} km/s ({} states) left out: {}",
                      1e-3 * window.least, 1e-3 * window.most, window.states, window.reason));
    }
  } else {
    result = own = fit_scaled(data, model, settings, start);
  }
  const SolidProblem problem(data, report.settings, model, own.constants, own.scale);
  const LeastSquaresProblem weights = problem.least_squares();
  const LeastSquaresSolution solution = solve(weights);
  const Index count = problem.constants();
  fit.constants = result.constants;
  if (melts) fit.superheating = fit.constants.gray.melting_temperature;
  fit.scale = own.scale;
  fit.covariance = result.covariance;
  fit.statistical_covariance = result.statistical_covariance;

  report.element = data.element;
  report.potential = data.potential;
  report.molar_mass = data.molar_mass;
  report.nuclei = data.nuclei;
  report.chi_squared = solution.chi_squared;
  report.degrees_of_freedom = solution.degrees_of_freedom;
  report.chi_squared_parts = chi_squared_parts(problem, solution, own.scale);
  report.left_out = leave_one_out(problem.data(), solution, count);
  for (const Place place : model.free) report.left_out_names.emplace_back(name_of(place));
  const GrayConstants& gray = fit.constants.gray;
  report.fitted_reference_volume = gray.reference_specific_volume;
  report.gruneisen = gray.gruneisen;
  report.gruneisen_slope = gray.gruneisen_slope;
  report.residuals = residual_rows(problem, model, data, weights, solution, report.fitted_reference_volume);
  for (const Isochore& isochore : data.isochores) report.isochores.push_back(isochore_gruneisen(isochore));
  report.isochoric_melting_temperature = isochoric_melting_temperature(data, gray);
  fit.data = std::move(data);
  return fit;
}

SolidConstants refit_solid(const Observations& data, const SolidFit& fit) {
  const SolidProblem problem(data, fit.report.settings, fit.model, fit.constants, fit.scale);
  return problem.constants_at(solve(problem.least_squares()).parameters);
}

}  // namespace whipple::fit
