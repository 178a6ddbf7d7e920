// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/gray_problem.hpp"

#include <cmath>

#include "md_fitting/fit/laws.hpp"

namespace whipple::fit {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using eos::GrayConstants;

// Scales that make the parameters of order one.
constexpr double anharmonic_scale = 1e-4;  // J/(mol K^2)
constexpr double pressure_scale = 1e9;     // Pa
constexpr double energy_scale = 1e4;       // J/kg

double square(double value) { return value * value; }
}  // namespace

GrayProblem::GrayProblem(const Observations& data, const FitSettings& settings, const GrayConstants& start)
    : data_(data), settings_(settings), start_(start) {
  for (const HugoniotState& state : data.hugoniot) {
    if (state.particle_velocity >= settings.least_particle_velocity &&
        state.particle_velocity <= settings.most_particle_velocity) {
      window_.push_back(state);
    }
  }
  for (const Isochore& isochore : data.isochores) {
    thermal_states_ += static_cast<Index>(isochore.states.size());
    const ThermalState& cold = isochore.states.front();
    const double v = isochore.volume;
    cold_.push_back({cold.pressure.value - gamma(start, v) * cold.energy.value / v,
                     cold.energy.value - thermal_energy(start, v, cold.temperature)});
  }
  constants_ = fits_melting() ? Place::melting + 1 : Place::melting;
  linearise_solidus();
}

void GrayProblem::linearise_solidus() {
  const auto points = static_cast<Index>(data_.melting.size());
  if (points == 0) return;
  const auto temperatures = [&](const VectorXd& p) {
    const Solidus solidus(constants_at(p));
    VectorXd t(points);
    for (Index i = 0; i < points; ++i) {
      t[i] = solidus.temperature(data_.melting[static_cast<std::size_t>(i)].solid_volume.value);
    }
    return t;
  };
  VectorXd p = VectorXd::Zero(constants_);
  solidus_ = temperatures(p);
  solidus_slopes_.resize(points, constants_);
  constexpr double step = 1e-4;
  for (Index k = 0; k < constants_; ++k) {
    p[k] = step;
    const VectorXd above = temperatures(p);
    p[k] = -step;
    solidus_slopes_.col(k) = (above - temperatures(p)) / (2.0 * step);
    p[k] = 0.0;
  }
}

std::vector<std::string> GrayProblem::fitted_names() const {
  std::vector<std::string> names = {
      "reference_specific_volume", "hugoniot_intercept",         "hugoniot_slope", "gruneisen",
      "gruneisen_slope",           "anharmonic_heat_coefficient"};
  if (fits_melting()) names.emplace_back("melting_temperature");
  return names;
}

// Logarithms of what must stay positive; gamma's slope and the anharmonic coefficient may have any sign.
GrayConstants GrayProblem::constants_at(const VectorXd& p) const {
  GrayConstants trial = start_;
  trial.reference_specific_volume *= std::exp(p[Place::volume]);
  trial.hugoniot_intercept *= std::exp(p[Place::intercept]);
  trial.hugoniot_slope *= std::exp(p[Place::slope]);
  trial.gruneisen *= std::exp(p[Place::gruneisen]);
  trial.gruneisen_slope += p[Place::gruneisen_slope];
  trial.anharmonic_heat_coefficient += anharmonic_scale * p[Place::anharmonic];
  if (fits_melting()) trial.melting_temperature *= std::exp(p[Place::melting]);
  return trial;
}

VectorXd GrayProblem::scale(const GrayConstants& constants) const {
  VectorXd scale(constants_);
  scale[Place::volume] = constants.reference_specific_volume;
  scale[Place::intercept] = constants.hugoniot_intercept;
  scale[Place::slope] = constants.hugoniot_slope;
  scale[Place::gruneisen] = constants.gruneisen;
  scale[Place::gruneisen_slope] = 1.0;
  scale[Place::anharmonic] = anharmonic_scale;
  if (fits_melting()) scale[Place::melting] = constants.melting_temperature;
  return scale;
}

std::pair<double, double> GrayProblem::velocities(const HugoniotState& state, double v0) {
  return {v0 * std::sqrt(state.pressure.value / (v0 - state.volume)),
          std::sqrt(state.pressure.value * (v0 - state.volume))};
}

GrayProblem::Intercepts GrayProblem::intercepts(const VectorXd& p, std::size_t isochore) const {
  const Index place = constants_ + 2 * static_cast<Index>(isochore);
  return {cold_[isochore].pressure + pressure_scale * p[place],
          cold_[isochore].energy + energy_scale * p[place + 1]};
}

VectorXd GrayProblem::residuals(const VectorXd& p) const {
  const GrayConstants constants = constants_at(p);
  VectorXd r(size());
  r[0] = data_.reference_volume.value - constants.reference_specific_volume;
  Index row = hugoniot_begin();
  for (const HugoniotState& state : window_) {
    const auto [us, up] = velocities(state, constants.reference_specific_volume);
    r[row++] = us - constants.hugoniot_intercept - constants.hugoniot_slope * up;
  }
  for (std::size_t j = 0; j < data_.isochores.size(); ++j) {
    const double v = data_.isochores[j].volume;
    const Intercepts at_zero = intercepts(p, j);
    for (const ThermalState& state : data_.isochores[j].states) {
      r[row++] = state.pressure.value - at_zero.pressure - gamma(constants, v) * state.energy.value / v -
                 anharmonic_pressure(constants, v, state.temperature);
      r[row++] = state.energy.value - at_zero.energy - thermal_energy(constants, v, state.temperature);
    }
  }
  for (std::size_t i = 0; i < data_.melting.size(); ++i) {
    r[row++] = data_.melting[i].temperature.value - solidus_[i] -
               solidus_slopes_.row(static_cast<Index>(i)).dot(p.head(constants_));
  }
  return r;
}

LeastSquaresProblem GrayProblem::least_squares() const {
  LeastSquaresProblem problem;
  problem.residuals = [this](const VectorXd& p) { return residuals(p); };
  problem.start = VectorXd::Zero(constants_ + 2 * static_cast<Index>(data_.isochores.size()));
  problem.statistical = MatrixXd::Zero(size(), size());
  problem.model = MatrixXd::Zero(size(), size());
  weigh(problem.statistical, problem.model);
  return problem;
}

void GrayProblem::weigh(MatrixXd& statistical, MatrixXd& model) const {
  const ModelErrors& errors = settings_.model_errors;
  statistical(0, 0) = square(data_.reference_volume.error);
  model(0, 0) = square(errors.zero_pressure_volume * data_.reference_volume.value);
  Index row = hugoniot_begin();
  for (const HugoniotState& state : window_) {
    // V is exact; Us and up both go as P^(1/2): d(Us - S up) = (Us - S up) dP/(2P).
    const auto [us, up] = velocities(state, start_.reference_specific_volume);
    statistical(row, row) =
        square((us - start_.hugoniot_slope * up) * state.pressure.error / (2.0 * state.pressure.value));
    model(row, row) = square(errors.shock_velocity * us);
    ++row;
  }
  for (const Isochore& isochore : data_.isochores) {
    weigh_isochore(isochore, row, statistical, model);
    row += 2 * static_cast<Index>(isochore.states.size());
  }
  for (const MeltingPoint& point : data_.melting) {
    const double v = point.solid_volume.value;
    const double step = 1e-4 * v;
    const double melting_slope =
        (melting_temperature(start_, v + step) - melting_temperature(start_, v - step)) / (2.0 * step);
    statistical(row, row) =
        square(point.temperature.error) + square(melting_slope * point.solid_volume.error);
    model(row, row) = square(errors.melting_temperature * point.temperature.value);
    ++row;
  }
}

void GrayProblem::weigh_isochore(const Isochore& isochore, Index begin, MatrixXd& statistical,
                                 MatrixXd& model) const {
  const ModelErrors& errors = settings_.model_errors;
  const double k = gamma(start_, isochore.volume) / isochore.volume;
  const ThermalState& cold = isochore.states.front();
  const auto rows = static_cast<Index>(2 * isochore.states.size());
  // Deviations common to the isochore: gamma by a fixed share, the anharmonic coefficient by a fixed amount.
  VectorXd pressure = VectorXd::Zero(rows);
  VectorXd energy = VectorXd::Zero(rows);
  for (Index i = 0; i < rows; i += 2) {
    const ThermalState& state = isochore.states[static_cast<std::size_t>(i / 2)];
    const Index row = begin + i;
    const double noise = square(state.energy.error);
    const double common = state.correlation * state.pressure.error * state.energy.error;
    // The residual of P contains -gamma E/V: the noise of E is common to both rows.
    statistical(row, row) = square(state.pressure.error) + k * k * noise - 2.0 * k * common;
    statistical(row + 1, row + 1) = noise;
    statistical(row, row + 1) = statistical(row + 1, row) = common - k * noise;
    const double heat = state.energy.value - cold.energy.value;
    model(row, row) = square(errors.thermal_pressure * k * heat);
    model(row + 1, row + 1) = square(errors.energy * heat);
    pressure[i] = errors.gruneisen * k * heat;
    energy[i + 1] =
        errors.anharmonic * (square(state.temperature) - square(cold.temperature)) / (2.0 * data_.molar_mass);
  }
  model.block(begin, begin, rows, rows) += pressure * pressure.transpose() + energy * energy.transpose();
}

}  // namespace whipple::fit
