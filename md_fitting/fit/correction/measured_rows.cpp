// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/correction/measured_rows.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "eos/experiments/comparison.hpp"
#include "eos/inversions.hpp"
#include "eos/loci.hpp"
#include "eos/model_equation_of_state.hpp"
#include "eos/models/gray.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using eos::State;
using eos::experiments::Experiment;
using eos::experiments::ExperimentKind;
using eos::experiments::VolumeScale;

/// Resolution of the splines beside the errors of measurement, relative.
constexpr double resolution = 1e-3;

/// Returns the surface of a state; nothing in a mixture of phases.
std::optional<PhaseSurface> surface_of(const State& s) {
  if (s.melted_fraction == 0.0) return PhaseSurface::solid;
  if (s.melted_fraction == 1.0 && s.vaporised_fraction == 0.0) return PhaseSurface::fluid;
  return std::nullopt;
}

/// Evaluates how the ordinates of measured curves change with the corrections.
class Linearised {
 public:
  explicit Linearised(const eos::GrayConstants& constants)
      : model_(constants),
        initial_(model_.state_at_temperature(model_.reference_density(), model_.reference_temperature())),
        hugoniot_(model_, initial_.density, initial_.specific_internal_energy) {}

  [[nodiscard]] const eos::EquationOfState& model() const { return model_; }
  [[nodiscard]] const State& initial() const { return initial_; }

  /// Returns the functionals of the ordinate of a point; nothing if it has none.
  [[nodiscard]] std::vector<SurfaceTerm> terms(const Experiment& experiment, std::size_t point) const {
    const double x = experiment.abscissa[point];
    switch (experiment.kind) {
      case ExperimentKind::isotherm: {
        const double reference = experiment.volume == VolumeScale::ratio
                                     ? eos::density_at_pressure(model_, 0.0, experiment.volume_temperature)
                                     : 1.0;
        const double V = experiment.volume == VolumeScale::density ? 1.0 / x : x / reference;
        return of_state(model_.state_at_temperature(1.0 / V, experiment.temperatures[point]), {.F_V = -1.0});
      }
      case ExperimentKind::shock_velocity:
        return shock_velocity(x);
      case ExperimentKind::isentrope:
        return isentrope(experiment.volume == VolumeScale::density ? 1.0 / x : x / initial_.density);
      case ExperimentKind::melting:
        return melting(x);
      default:
        return {};
    }
  }

 private:
  static std::vector<SurfaceTerm> of_state(const State& s, const eos::FreeEnergyTerms& weights) {
    const std::optional<PhaseSurface> surface = surface_of(s);
    if (!surface) return {};
    return {{*surface, 1.0 / s.density, s.temperature, weights}};
  }
  /// At a particle velocity: dUs = dP/(rho0 up - V0 up/Us^2 dP_H/dV), with the change of the Hugoniot at one volume
  /// dP = (dP_E)/(1 - Gamma (V0 - V)/(2 V)), dP_E = -dG/dV - Gamma/V (G - T dG/dT) at one volume and energy.
  [[nodiscard]] std::vector<SurfaceTerm> shock_velocity(double up) const {
    const eos::ShockState shock = hugoniot_.at_particle_velocity(up);
    const State& s = shock.state;
    const double V0 = 1.0 / initial_.density, V = 1.0 / s.density, us = shock.shock_velocity;
    constexpr double h = 1e-4;
    const double above = hugoniot_.at_density(s.density * (1.0 + h)).state.pressure;
    const double below = hugoniot_.at_density(s.density * (1.0 - h)).state.pressure;
    const double by_volume = -(above - below) / (2.0 * h * V);
    const double along = 1.0 - s.gruneisen * (V0 - V) / (2.0 * V);
    const double factor = 1.0 / (along * (up / V0 - V0 * up / (us * us) * by_volume));
    const double by_energy = -s.gruneisen / V;
    return of_state(s, {.F = factor * by_energy, .F_V = -factor, .F_T = -factor * by_energy * s.temperature});
  }
  /// At one volume and entropy: dP = -dG/dV + dP/dT T/C_v (dG/dT - dG/dT at rest).
  [[nodiscard]] std::vector<SurfaceTerm> isentrope(double V) const {
    const State s = eos::isentrope(model_, initial_, {1.0 / V}).back().state;
    // dP/dT T/C_v = Gamma T/V
    const double factor = s.gruneisen * s.temperature / V;
    std::vector<SurfaceTerm> terms = of_state(s, {.F_V = -1.0, .F_T = factor});
    if (!terms.empty())
      terms.push_back({PhaseSurface::solid, 1.0 / initial_.density, initial_.temperature, {.F_T = -factor}});
    return terms;
  }
  /// At one pressure: dT = (dG_l - dG_s)/(S_l - S_s) at the volumes of the phases.
  [[nodiscard]] std::vector<SurfaceTerm> melting(double pressure) const {
    const eos::GrayMeltingCurve::Tangent t =
        model_.underlying().melting_curve().value().at_pressure(pressure);
    const eos::GrayFreeEnergy& f = model_.underlying().free_energy();
    const double T = t.temperature;
    const double entropy = f.liquid(t.liquid_volume, T).entropy - f.solid(t.solid_volume, T).entropy;
    return {{PhaseSurface::fluid, t.liquid_volume, T, {.F = 1.0 / entropy}},
            {PhaseSurface::solid, t.solid_volume, T, {.F = -1.0 / entropy}}};
  }

  eos::ModelEquationOfState<eos::Gray> model_;
  State initial_;
  eos::Hugoniot hugoniot_;
};

}  // namespace

CorrectionData measured_rows(std::span<const MeasuredCurve> curves, const eos::GrayConstants& constants) {
  const Linearised gray(constants);
  CorrectionData all;
  std::vector<double> variances;
  for (const MeasuredCurve& curve : curves) {
    const Experiment& experiment = curve.experiment;
    const std::vector<double> densities =
        eos::experiments::initial_densities(gray.initial().density, experiment);
    const std::vector<double> here = eos::experiments::curve(
        gray.model(), gray.initial(), experiment, {experiment.abscissa, densities, experiment.temperatures});
    VarianceComponent scale{.name = "table, " + experiment.name,
                            .deviation = Deviation::table,
                            .rows = {},
                            .covariance = {},
                            .spread = 0.2};
    std::vector<double> sizes;
    for (std::size_t i = 0; i < curve.points(); ++i) {
      if (!std::isfinite(here[i]) || densities[i] < gray.initial().density) continue;
      std::vector<SurfaceTerm> terms;
      try {
        terms = gray.terms(experiment, i);
      } catch (const StateError&) {
        continue;  // outside the range of the model
      }
      if (terms.empty()) continue;
      const double measured = experiment.ordinate[i];
      scale.rows.push_back(static_cast<Eigen::Index>(all.data.size()));
      sizes.push_back(form_of(experiment.kind).of_table * measured);
      variances.push_back(std::pow(curve.error[i], 2) + std::pow(resolution * measured, 2));
      all.data.push_back({.kind = "measured, " + experiment.name,
                          .residual = measured - here[i],
                          .scale = measured,
                          .terms = std::move(terms),
                          .group = CurveGroup::measured,
                          .curve = experiment.name});
    }
    if (sizes.empty()) continue;
    const Eigen::Map<const Eigen::VectorXd> s(sizes.data(), static_cast<Eigen::Index>(sizes.size()));
    scale.covariance = s * s.transpose();
    all.deviations.push_back(std::move(scale));
  }
  const auto count = static_cast<Eigen::Index>(variances.size());
  all.covariance = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) all.covariance(i, i) = variances[static_cast<std::size_t>(i)];
  return all;
}

}  // namespace whipple::fit
