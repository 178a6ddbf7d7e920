// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/expected_data.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "eos/loci.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/gray.hpp"
#include "md_fitting/data_set/points.hpp"
#include "md_fitting/fit/laws.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using md::CoexistencePoint;
using md::HugoniotPoint;
using md::PointRecord;
using md::StatePoint;

/// Returns the geometric mean of sigma/scale (cells x steps)^1/2 over the points of a protocol whose result has an
/// error; 0 if there are none.
template <class Result, class Scale>
double coefficient(std::span<const PointRecord> points, md::PointKind protocol, Result result, Scale scale) {
  const std::string quantity(md::name_of(result));
  double sum = 0.0;
  int count = 0;
  for (const PointRecord& point : points) {
    if (!point.done() || point.kind() != protocol) continue;
    const auto found = point.results.find(quantity);
    if (found == point.results.end() || !(found->second.error > 0.0)) continue;
    sum += std::log(found->second.error / scale(point)) + 0.5 * std::log(Ranges::sampling(point));
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : 0.0;
}

}  // namespace

ExpectedData::ExpectedData(const GrayFit& fit, std::span<const PointRecord> points, const Ranges& ranges,
                           const std::vector<Candidate>& candidates)
    : ranges_(ranges),
      constants_(fit.solid.constants),
      data_(fit.solid.data),
      candidates_(candidates.size()),
      hugoniot_owners_(data_.hugoniot.size(), -1),
      melting_owners_(data_.melting.size(), -1) {
  const auto pressure = [](const PointRecord& point) {
    return md::required(point, &HugoniotPoint::pressure).value;
  };
  const auto thermal = [](const PointRecord& point) {
    return std::sqrt(md::condition(point, &StatePoint::temperature));
  };
  const auto one = [](const PointRecord&) { return 1.0; };
  shock_pressure_ = coefficient(points, md::PointKind::hugoniot, &HugoniotPoint::pressure, pressure);
  pressure_ = coefficient(points, md::PointKind::isochore, &StatePoint::pressure, thermal);
  energy_ = coefficient(points, md::PointKind::isochore, &StatePoint::specific_internal_energy, thermal);
  melting_ = coefficient(points, md::PointKind::coexistence, &CoexistencePoint::melting_temperature, one);
  solid_volume_ =
      coefficient(points, md::PointKind::coexistence, &CoexistencePoint::solid_specific_volume, one);
  latent_heat_ = coefficient(points, md::PointKind::coexistence, &CoexistencePoint::latent_heat, one);
  double sum = 0.0;
  double states = 0.0;
  for (const Isochore& isochore : data_.isochores) {
    isochore_owners_.emplace_back(isochore.states.size(), -1);
    for (const ThermalState& state : isochore.states) sum += state.correlation;
    states += static_cast<double>(isochore.states.size());
  }
  correlation_ = sum / states;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    for (const PlannedPoint& point : candidates[c].points) add(point, static_cast<int>(c), fit);
  }
}

double ExpectedData::error(double coefficient, const PlannedPoint& point) const {
  return coefficient / std::sqrt(ranges_.sampling(point));
}

void ExpectedData::add(const PlannedPoint& point, int owner, const GrayFit& fit) {
  if (point.protocol == md::PointKind::hugoniot) add_hugoniot(point, owner);
  if (point.protocol == md::PointKind::isochore) add_isochore(point, owner);
  if (point.protocol == md::PointKind::coexistence) add_coexistence(point, owner, fit);
}

void ExpectedData::add_hugoniot(const PlannedPoint& point, int owner) {
  const eos::GrayConstants& c = constants_.gray;
  const double v0 = c.reference_specific_volume;
  HugoniotState state;
  state.volume = point.volume_ratio * ranges_.static_volume();
  // Jump conditions with Us = C + S up: up = C x/(1 - S x), x = 1 - V/V0.
  const double x = 1.0 - state.volume / v0;
  const double rest = 1.0 - c.hugoniot_slope * x;
  if (!(x > 0.0 && rest > 0.0)) return;
  state.particle_velocity = c.hugoniot_intercept * x / rest;
  state.shock_velocity = c.hugoniot_intercept / rest;
  const double pressure = state.shock_velocity * state.particle_velocity / v0;
  state.pressure = {pressure, error(shock_pressure_, point) * pressure};
  data_.hugoniot.push_back(state);
  hugoniot_owners_.push_back(owner);
}

void ExpectedData::add_isochore(const PlannedPoint& point, int owner) {
  const double v = point.volume_ratio * ranges_.static_volume();
  const double t = point.temperature;
  if (t > melting_temperature(constants_.gray, v)) return;  // the fit excludes superheated states
  const auto found = std::find_if(data_.isochores.begin(), data_.isochores.end(),
                                  [&](const Isochore& one) { return std::abs(one.volume - v) <= 1e-6 * v; });
  const auto place = static_cast<std::size_t>(found - data_.isochores.begin());
  if (found == data_.isochores.end()) {
    data_.isochores.push_back({v, {}});
    isochore_owners_.emplace_back();
  }
  Isochore& isochore = data_.isochores[place];
  // The intercepts of an isochore are free: only differences from its first state are significant.
  double energy = thermal_energy(constants_, v, t);
  if (!isochore.states.empty()) {
    const ThermalState& first = isochore.states.front();
    energy += first.energy.value - thermal_energy(constants_, v, first.temperature);
  }
  const eos::GrayConstants& gray = constants_.gray;
  const double pressure = gamma(gray, v) * energy / v + anharmonic_pressure(gray, v, t);
  const double root = std::sqrt(t);
  isochore.states.push_back(
      {t, {pressure, error(pressure_, point) * root}, {energy, error(energy_, point) * root}, correlation_});
  isochore_owners_[place].push_back(owner);
}

void ExpectedData::add_coexistence(const PlannedPoint& point, int owner, const GrayFit& fit) {
  const eos::ModelEquationOfState<eos::Gray> model(fit.gray);
  try {
    const std::optional<eos::MeltingPoint> melting = eos::melting_point(model, point.pressure);
    if (!melting) return;
    MeltingPoint datum;
    datum.pressure = point.pressure;
    datum.temperature = {melting->solidus.temperature, error(melting_, point)};
    datum.solid_volume = {1.0 / melting->solidus.density, error(solid_volume_, point)};
    if (latent_heat_ > 0.0) {
      datum.latent_heat = {Melting(fit.gray).latent_heat(point.pressure, melting->solidus.temperature),
                           error(latent_heat_, point)};
    }
    data_.melting.push_back(datum);
    melting_owners_.push_back(owner);
  } catch (const StateError&) {
    // The model does not melt there: the candidate adds no datum to the fit.
  }
}

ExpectedData::Rows ExpectedData::rows(const SolidProblem& problem) const {
  Rows rows;
  rows.candidates.resize(candidates_);
  Eigen::Index row = 0;
  const auto take = [&](int owner, Eigen::Index count) {
    std::vector<Eigen::Index>& mine =
        owner < 0 ? rows.present : rows.candidates[static_cast<std::size_t>(owner)];
    for (Eigen::Index i = 0; i < count; ++i) mine.push_back(row++);
  };
  // The order of SolidProblem::list_data.
  take(-1, 1);
  for (std::size_t i = 0; i < data_.hugoniot.size(); ++i) {
    if (problem.in_window(data_.hugoniot[i])) take(hugoniot_owners_[i], 1);
  }
  for (const std::vector<int>& owners : isochore_owners_) {
    for (const int owner : owners) take(owner, 2);
  }
  for (const int owner : melting_owners_) take(owner, 1);
  for (std::size_t i = 0; i < data_.melting.size() && row < problem.size(); ++i) {
    if (data_.melting[i].latent_heat) take(melting_owners_[i], 1);
  }
  if (row != problem.size()) throw InternalError("the rows of the expected data do not fill the problem");
  return rows;
}

}  // namespace whipple::fit
