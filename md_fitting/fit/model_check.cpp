// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/model_check.hpp"

#include <cmath>

#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/gray.hpp"
#include "md_fitting/data_set/points.hpp"
#include "md_fitting/fit/laws.hpp"
#include "md_fitting/fit/vapour_fit.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

/// Collects model minus datum.
class Deviations {
 public:
  Deviations(std::string quantity, std::string unit, double unit_size)
      : check_{std::move(quantity), std::move(unit)}, unit_size_(unit_size) {}

  template <class Model>
  void add(double datum, const Model& model) {
    try {
      const double deviation = (model() - datum) / unit_size_;
      ++check_.points;
      check_.mean += deviation;
      check_.rms += deviation * deviation;
      if (std::abs(deviation) > std::abs(check_.maximum)) check_.maximum = deviation;
    } catch (const StateError&) {
      // Outside the range of the model: not counted.
    }
  }
  void finish(std::vector<ModelCheck>& checks) {
    if (check_.points == 0) return;
    check_.mean /= check_.points;
    check_.rms = std::sqrt(check_.rms / check_.points);
    checks.push_back(check_);
  }

 private:
  ModelCheck check_;
  double unit_size_;
};

/// Returns the temperature of one edge of the melting band at a pressure.
double edge_temperature(const eos::GrayFreeEnergy& surface, double pressure, bool liquid) {
  const auto edge = [&](double volume) {
    const eos::GrayBand band = surface.band(surface.isochore(volume));
    return liquid ? std::pair(band.P2, band.T2) : std::pair(band.P1, band.T1);
  };
  double small = surface.least_volume();
  double large = surface.join_volume();
  if (edge(small).first < pressure || edge(large).first > pressure) {
    throw StateError("the melting curve does not reach the pressure");
  }
  while (large - small > 1e-10 * large) {
    const double middle = 0.5 * (small + large);
    (edge(middle).first > pressure ? small : large) = middle;
  }
  return edge(0.5 * (small + large)).second;
}

}  // namespace

std::vector<ModelCheck> check_solid(const eos::EquationOfState& model,
                                    const std::function<double(double, double)>& solid_pressure,
                                    const Observations& data, std::span<const md::PointRecord> points) {
  std::vector<ModelCheck> checks;
  Deviations shock("Hugoniot pressure", "GPa", 1e9);
  const eos::Hugoniot hugoniot(model);
  for (const HugoniotState& state : data.hugoniot) {
    shock.add(state.pressure.value, [&] { return hugoniot.at_density(1.0 / state.volume).state.pressure; });
  }
  shock.finish(checks);

  for (const char* protocol : {"isotherm", "isochore"}) {
    Deviations pressure(std::string(protocol) + " pressure", "GPa", 1e9);
    for (const md::StatePoint& point : md::select_as<md::StatePoint>(points, protocol)) {
      if (!point.solid) continue;
      pressure.add(point.pressure.value,
                   [&] { return solid_pressure(point.specific_volume, point.temperature); });
    }
    pressure.finish(checks);
  }

  Deviations expansion("volume at zero pressure", "%", 0.01);
  for (const md::ZeroPressurePoint& point : md::select_as<md::ZeroPressurePoint>(points)) {
    expansion.add(1.0, [&] {
      return 1.0 / (eos::density_at_pressure(model, point.pressure, point.temperature) *
                    point.specific_volume.value);
    });
  }
  expansion.finish(checks);
  return checks;
}

std::vector<ModelCheck> check_gray(const eos::GrayConstants& constants, const Observations& data,
                                   std::span<const md::PointRecord> points) {
  const eos::ModelEquationOfState<eos::Gray> model(constants);
  const eos::GrayFreeEnergy& surface = model.underlying().free_energy();
  std::vector<ModelCheck> checks =
      check_solid(model, [&](double V, double T) { return surface.solid(V, T).pressure; }, data, points);

  Deviations melting("melting temperature at the pressure", "K", 1.0);
  Deviations heat("latent heat of fusion", "%", 0.01);
  Deviations volume("volume of fusion", "%", 0.01);
  for (const MeltingPoint& point : data.melting) {
    melting.add(point.temperature.value, [&] {
      return 0.5 * (edge_temperature(surface, point.pressure, false) +
                    edge_temperature(surface, point.pressure, true));
    });
    const double T = point.temperature.value;
    const auto at = [&](bool liquid) { return condensed_volume(surface, liquid, point.pressure, T); };
    if (point.latent_heat) {
      heat.add(1.0, [&] {
        const double solid = at(false), liquid = at(true);
        return (surface.liquid(liquid, T).energy - surface.solid(solid, T).energy +
                point.pressure * (liquid - solid)) /
               point.latent_heat->value;
      });
    }
    if (point.fusion_volume)
      volume.add(1.0, [&] { return (at(true) - at(false)) / point.fusion_volume->value; });
  }
  for (Deviations* part : {&melting, &heat, &volume}) part->finish(checks);

  Deviations melt("volume of the melt", "%", 0.01);
  for (const LiquidState& state : data.liquid) {
    melt.add(1.0, [&] {
      return condensed_volume(surface, true, state.pressure, state.temperature) / state.volume.value;
    });
  }
  melt.finish(checks);
  Deviations liquid("saturated melt, density", "%", 0.01);
  Deviations vapour("saturated vapour, density", "%", 0.01);
  for (const SaturationState& state : data.saturation) {
    const auto density = [&] { return saturated_densities(constants, state.temperature); };
    liquid.add(1.0, [&] { return density().first / state.liquid_density.value; });
    vapour.add(1.0, [&] { return density().second / state.vapour_density.value; });
  }
  liquid.finish(checks);
  vapour.finish(checks);
  return checks;
}

}  // namespace whipple::fit
