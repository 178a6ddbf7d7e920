// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/solid_problem.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "md_fitting/fit/laws.hpp"

namespace whipple::fit {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Scales that make the parameters of order one.
constexpr double pressure_scale = 1e9;  // Pa
constexpr double energy_scale = 1e4;    // J/kg
}  // namespace

SolidProblem::SolidProblem(const Observations& data, const FitSettings& settings, const SolidModel& model,
                           const SolidConstants& start, const ModelScale& scale)
    : observations_(data), settings_(settings), model_(model), start_(start), scale_(scale) {
  for (const Place place : model.free) {
    bounded_.emplace_back(at(start, place), bounds_of(place, start), scale_of(place));
  }
  for (const HugoniotState& state : data.hugoniot) {
    if (in_window(state)) window_.push_back(state);
  }
  for (const Isochore& isochore : data.isochores) {
    const ThermalState& cold = isochore.states.front();
    const double v = isochore.volume;
    cold_.push_back({cold.pressure.value - gamma(start.gray, v) * cold.energy.value / v,
                     cold.energy.value - thermal_energy(start, v, cold.temperature)});
  }
  for (const MeltingPoint& point : data.melting) {
    if (model.fits(Place::melting)) melting_.push_back(&point);
    if (model.fits(Place::entropy) && point.latent_heat) fusion_.push_back(&point);
  }
  list_data();
  linearise_melting();
}

bool SolidProblem::in_window(const HugoniotState& state) const {
  return model_.hugoniot && state.particle_velocity >= settings_.least_particle_velocity &&
         state.particle_velocity <= settings_.most_particle_velocity;
}

void SolidProblem::list_data() {
  const auto add = [&](DataKind kind, const char* quantity, const std::string& label, Index rows = 1) {
    rows_.push_back({quantity, label, size_, rows, kind});
    size_ += rows;
  };
  const double v0 = observations_.reference_volume.value;
  add(DataKind::volume, "volume at zero pressure",
      fmt::format("T = {:.0f} K", observations_.reference_temperature));
  for (const HugoniotState& state : window_) {
    add(DataKind::shock, "shock velocity", fmt::format("up = {:.3g} km/s", 1e-3 * state.particle_velocity));
  }
  if (model_.isotherm) {
    for (const IsothermState& state : observations_.isotherm) {
      add(DataKind::isotherm, "pressure of the isotherm", fmt::format("V/V0 = {:.3f}", state.volume / v0));
    }
  }
  for (const Isochore& isochore : observations_.isochores) {
    for (const ThermalState& state : isochore.states) {
      add(DataKind::isochore, "pressure and energy of the isochores",
          fmt::format("V/V0 = {:.3f}, T = {:.0f} K", isochore.volume / v0, state.temperature), 2);
    }
  }
  const auto pressure = [](const MeltingPoint* point) {
    return fmt::format("P = {:.3g} GPa", 1e-9 * point->pressure);
  };
  for (const MeltingPoint* point : melting_) add(DataKind::melting, "melting temperature", pressure(point));
  for (const MeltingPoint* point : fusion_) add(DataKind::fusion, "latent heat of fusion", pressure(point));
}

VectorXd SolidProblem::melting_values(const SolidConstants& constants) const {
  VectorXd values(static_cast<Index>(melting_.size() + fusion_.size()));
  const auto surface = model_.surface ? std::make_unique<Melting>(constants.gray) : nullptr;
  Index row = 0;
  for (const MeltingPoint* point : melting_) {
    const double v = point->solid_volume.value;
    values[row++] = surface ? surface->solidus(v) : melting_temperature(constants.gray, v);
  }
  for (const MeltingPoint* point : fusion_) {
    values[row++] = surface->latent_heat(point->pressure, point->temperature.value);
  }
  return values;
}

/// Linearises the melting rows about the start values, because an evaluation of GRAY's surface costs a fraction of
/// a millisecond; the fit is repeated from its result until these values converge.
void SolidProblem::linearise_melting() {
  if (melting_.empty() && fusion_.empty()) return;
  VectorXd p = VectorXd::Zero(constants());
  melting_start_ = melting_values(start_);
  melting_slopes_.resize(melting_start_.size(), constants());
  constexpr double step = 1e-4;
  for (Index k = 0; k < constants(); ++k) {
    p[k] = step;
    const VectorXd above = melting_values(constants_at(p));
    p[k] = -step;
    melting_slopes_.col(k) = (above - melting_values(constants_at(p))) / (2.0 * step);
    p[k] = 0.0;
  }
}

SolidConstants SolidProblem::constants_at(const VectorXd& p) const {
  SolidConstants trial = start_;
  for (std::size_t k = 0; k < bounded_.size(); ++k) {
    at(trial, model_.free[k]) = bounded_[k].value(p[static_cast<Index>(k)]);
  }
  return trial;
}

VectorXd SolidProblem::scale(const VectorXd& p) const {
  VectorXd slopes(constants());
  for (std::size_t k = 0; k < bounded_.size(); ++k) {
    slopes[static_cast<Index>(k)] = bounded_[k].slope(p[static_cast<Index>(k)]);
  }
  return slopes;
}

std::pair<double, double> SolidProblem::velocities(const HugoniotState& state, double v0) {
  return {v0 * std::sqrt(state.pressure.value / (v0 - state.volume)),
          std::sqrt(state.pressure.value * (v0 - state.volume))};
}

SolidProblem::Intercepts SolidProblem::intercepts(const VectorXd& p, std::size_t isochore) const {
  const Index place = constants() + 2 * static_cast<Index>(isochore);
  return {cold_[isochore].pressure + pressure_scale * p[place],
          cold_[isochore].energy + energy_scale * p[place + 1]};
}

VectorXd SolidProblem::residuals(const VectorXd& p) const {
  const SolidConstants constants = constants_at(p);
  const eos::GrayConstants& gray = constants.gray;
  VectorXd r(size());
  Index row = 0;
  r[row++] = observations_.reference_volume.value - gray.reference_specific_volume;
  for (const HugoniotState& state : window_) {
    const auto [us, up] = velocities(state, gray.reference_specific_volume);
    r[row++] =
        us - gray.hugoniot_intercept - gray.hugoniot_slope * up - gray.hugoniot_quadratic * up * up / us;
  }
  if (model_.isotherm) {
    for (const IsothermState& state : observations_.isotherm) {
      r[row++] = state.pressure.value - isotherm_pressure(constants, state.volume);
    }
  }
  for (std::size_t j = 0; j < observations_.isochores.size(); ++j) {
    const double v = observations_.isochores[j].volume;
    const Intercepts at_zero = intercepts(p, j);
    for (const ThermalState& state : observations_.isochores[j].states) {
      r[row++] = state.pressure.value - at_zero.pressure - gamma(gray, v) * state.energy.value / v -
                 anharmonic_pressure(gray, v, state.temperature);
      r[row++] = state.energy.value - at_zero.energy - thermal_energy(constants, v, state.temperature);
    }
  }
  if (melting_start_.size() > 0) {
    r.tail(melting_start_.size()) = -melting_start_ - melting_slopes_ * p.head(this->constants());
  }
  for (const MeltingPoint* point : melting_) r[row++] += point->temperature.value;
  for (const MeltingPoint* point : fusion_) r[row++] += point->latent_heat->value;
  return r;
}

LeastSquaresProblem SolidProblem::least_squares() const {
  LeastSquaresProblem problem;
  problem.residuals = [this](const VectorXd& p) { return residuals(p); };
  problem.start = VectorXd::Zero(constants() + 2 * static_cast<Index>(observations_.isochores.size()));
  problem.statistical = MatrixXd::Zero(size(), size());
  problem.model = MatrixXd::Zero(size(), size());
  weigh_noise(problem.statistical);
  weigh_model(problem.model);
  return problem;
}

}  // namespace whipple::fit
