// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/correction/correction_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "eos/models/gray_melting_curve.hpp"
#include "md_fitting/data_set/points.hpp"

namespace whipple::fit {
namespace {

using eos::GrayPoint;
using md::Estimate;

/// Resolution of the splines, which adds to the noise: of a pressure, in parts of it and of rho0 C^2, and of a thermal
/// energy.
constexpr double of_pressure = 5e-4, of_bulk_modulus = 1e-4, of_energy = 1e-3;
/// What a coexistence of a small box may be off beside its noise, relative: its temperature and its heat.
constexpr double of_melting = 5e-3, of_heat = 0.02;
/// The melting line of GRAY is kept to this, relative, up to this multiple of the melting temperature at rest, and
/// further than this in ln T from simulated coexistence.
constexpr double of_kept_melting = 0.01, hottest_kept = 4.0, near_simulated = 0.2;
constexpr double most_correlated = 0.999;

/// Holds the errors of a group of data as independent sources: covariance = columns columns^T.
struct Group {
  std::vector<CorrectionDatum> data;
  Eigen::MatrixXd covariance;
  std::string curve{};
};

/// Names what a datum is, and the group of its curve.
struct StateKind {
  std::string name;
  CurveGroup group;
};

class Collector {
 public:
  Collector(const eos::GrayFreeEnergy& gray, const FilmErrors& film_errors)
      : gray_(gray), film_errors_(film_errors) {
    const eos::GrayConstants& c = gray.constants();
    bulk_modulus_ = c.hugoniot_intercept * c.hugoniot_intercept / c.reference_specific_volume;
  }

  /// Names the curve to which the data that follow belong.
  void begin_curve(std::string name) { curve_ = std::move(name); }
  void begin_isochore(const std::string& name, double V) {
    begin_curve(fmt::format("{} {:.5g}", name, V / gray_.constants().reference_specific_volume));
  }
  /// Adds pressure and energy of a state at (V, T).
  void state(const StateKind& kind, PhaseSurface surface, double V, double T, const Estimate& pressure,
             const Estimate& energy, double correlation) {
    if (!in_range(surface, V)) return;
    const GrayPoint model = at(surface, V, T);
    const double rho = std::clamp(correlation, -most_correlated, most_correlated);
    const double heat = 3.0 * gray_.specific_gas_constant() * T;
    Eigen::MatrixXd covariance(2, 2);
    covariance << pressure.error * pressure.error, rho * pressure.error * energy.error,
        rho * pressure.error * energy.error, energy.error * energy.error;
    covariance(0, 0) +=
        std::pow(of_pressure * pressure.value, 2) + std::pow(of_bulk_modulus * bulk_modulus_, 2);
    covariance(1, 1) += std::pow(of_energy * heat, 2);
    add({{pressure_datum(kind, surface, V, T, pressure.value - model.pressure),
          energy_datum(kind, surface, V, T, energy.value - model.energy)},
         covariance});
  }
  /// Adds a pressure at (V, T).
  void pressure(const StateKind& kind, PhaseSurface surface, double V, double T, double pressure,
                double error) {
    if (!in_range(surface, V)) return;
    const double whole = std::hypot(error, of_pressure * pressure, of_bulk_modulus * bulk_modulus_);
    add({{pressure_datum(kind, surface, V, T, pressure - at(surface, V, T).pressure)},
         Eigen::MatrixXd::Constant(1, 1, whole * whole)});
  }
  /// Adds solid and melt in equilibrium: both pressures, equal Gibbs energies, and the heat of fusion.
  void coexistence(const md::CoexistencePoint& point) {
    if (!point.solid_specific_volume || !point.fusion_volume) return;
    const double T = point.melting_temperature.value, Vs = point.solid_specific_volume->value;
    const double Vl = Vs + point.fusion_volume->value, P = point.pressure;
    if (!in_range(PhaseSurface::solid, Vs) || !in_range(PhaseSurface::fluid, Vl)) return;
    const GrayPoint s = at(PhaseSurface::solid, Vs, T), l = at(PhaseSurface::fluid, Vl, T);
    const auto volume_error = [&](const GrayPoint& p, const Estimate& V) {
      return p.pressure_by_volume * V.error;
    };
    pressure({"coexistence, solid", CurveGroup::coexistence}, PhaseSurface::solid, Vs, T, P,
             volume_error(s, *point.solid_specific_volume));
    pressure({"coexistence, melt", CurveGroup::coexistence}, PhaseSurface::fluid, Vl, T, P,
             volume_error(l, *point.fusion_volume));
    // F_l - F_s + P (V_l - V_s) = 0, of which the error of T makes S_l - S_s times it.
    const double entropy = l.entropy - s.entropy;
    const double error = entropy * std::hypot(point.melting_temperature.error, of_melting * T);
    CorrectionDatum gibbs{
        "coexistence, Gibbs energies",
        CorrectionRowKind::gibbs,
        -(l.energy - s.energy - T * entropy + P * (Vl - Vs)),
        T * entropy,
        0.0,
        {{PhaseSurface::fluid, Vl, T, {.F = 1.0}}, {PhaseSurface::solid, Vs, T, {.F = -1.0}}},
        CurveGroup::coexistence};
    add({{std::move(gibbs)}, Eigen::MatrixXd::Constant(1, 1, error * error)});
    if (!point.latent_heat) return;
    const double heat = point.latent_heat->value;
    const double heat_error = std::hypot(point.latent_heat->error, of_heat * heat);
    CorrectionDatum fusion{"coexistence, heat of fusion",
                           CorrectionRowKind::fusion,
                           heat - P * (Vl - Vs) - (l.energy - s.energy),
                           heat,
                           0.0,
                           {{PhaseSurface::fluid, Vl, T, {.F = 1.0, .F_T = -T}},
                            {PhaseSurface::solid, Vs, T, {.F = -1.0, .F_T = T}}},
                           CurveGroup::coexistence};
    add({{std::move(fusion)}, Eigen::MatrixXd::Constant(1, 1, heat_error * heat_error)});
  }
  /// Keeps the melting line of GRAY, which the constants come from, where melting is not known otherwise: equal Gibbs
  /// energies at its pressures and temperatures.
  void melting_line(const std::vector<double>& known) {
    const eos::GrayMeltingCurve curve(gray_);
    const double first = curve.at_pressure(0.0).temperature;
    const double last = std::min(0.95 * curve.hottest().temperature, hottest_kept * first);
    constexpr int points = 8;
    for (int i = 0; i < points; ++i) {
      const double T = first * std::pow(last / first, static_cast<double>(i) / (points - 1));
      const bool is_known = std::ranges::any_of(
          known, [&](double temperature) { return std::abs(std::log(T / temperature)) < near_simulated; });
      if (is_known) continue;
      const eos::GrayMeltingCurve::Tangent t = curve.at_temperature(T);
      const double entropy = at(PhaseSurface::fluid, t.liquid_volume, T).entropy -
                             at(PhaseSurface::solid, t.solid_volume, T).entropy;
      const double error = of_kept_melting * T * entropy;
      add({{{"melting line kept",
             CorrectionRowKind::kept,
             0.0,
             T * entropy,
             0.0,
             {{PhaseSurface::fluid, t.liquid_volume, T, {.F = 1.0}},
              {PhaseSurface::solid, t.solid_volume, T, {.F = -1.0}}}}},
           Eigen::MatrixXd::Constant(1, 1, error * error)});
    }
  }
  /// Adds melt and vapour in equilibrium: equal pressures and Gibbs energies at the simulated densities.
  void film(const md::LiquidVapourPoint& point) {
    const double T = point.temperature;
    const double Vl = 1.0 / point.liquid_density.value, Vv = 1.0 / point.vapour_density.value;
    const GrayPoint l = at(PhaseSurface::fluid, Vl, T), v = at(PhaseSurface::fluid, Vv, T);
    const auto P = [&](double V, double sign) {
      return SurfaceTerm{PhaseSurface::fluid, V, T, {.F_V = -sign}};
    };
    const auto G = [&](double V, double sign) {
      return SurfaceTerm{PhaseSurface::fluid, V, T, {.F = sign, .F_V = -sign * V}};
    };
    const double liquid =
        std::hypot(point.liquid_density.error / point.liquid_density.value, film_errors_.liquid_density);
    const double vapour =
        std::hypot(point.vapour_density.error / point.vapour_density.value, film_errors_.vapour_density);
    // By the densities: dP = V (dP/dV) d ln V, d(F + P V) = V dP. Slopes of an ideal gas at least: those of GRAY may
    // lie in its loop.
    const double gas = gray_.specific_gas_constant() * T;
    const double slope_l = std::max(std::abs(Vl * l.pressure_by_volume), gas / Vl);
    const double slope_v = gas / Vv;
    const Estimate& stress = point.vapour_pressure;
    const double pressure = std::hypot(stress.error, film_errors_.vapour_pressure * stress.value);
    // Rows: pressures, Gibbs energies, pressure of the vapour; columns: errors of liquid, vapour and stress.
    Eigen::MatrixXd sources = Eigen::MatrixXd::Zero(3, 3);
    sources << slope_l * liquid, -slope_v * vapour, 0.0,  //
        Vl * slope_l * liquid, -Vv * slope_v * vapour, 0.0, 0.0, -slope_v * vapour, pressure;
    add({{{"film, pressures",
           CorrectionRowKind::film,
           v.pressure - l.pressure,
           gas / Vv,
           0.0,
           {P(Vl, 1.0), P(Vv, -1.0)},
           CurveGroup::film},
          {"film, Gibbs energies",
           CorrectionRowKind::film,
           v.gibbs(Vv, T) - l.gibbs(Vl, T),
           gas,
           0.0,
           {G(Vl, 1.0), G(Vv, -1.0)},
           CurveGroup::film},
          {"film, pressure of the vapour",
           CorrectionRowKind::film,
           stress.value - v.pressure,
           gas / Vv,
           0.0,
           {P(Vv, 1.0)},
           CurveGroup::film}},
         sources * sources.transpose()});
  }

  [[nodiscard]] double modulus(PhaseSurface surface, double V, double T) const {
    return std::abs(V * at(surface, V, T).pressure_by_volume);
  }
  [[nodiscard]] CorrectionData result() const {
    CorrectionData all;
    Eigen::Index rows = 0;
    for (const Group& group : groups_) rows += group.covariance.rows();
    all.covariance = Eigen::MatrixXd::Zero(rows, rows);
    Eigen::Index row = 0;
    for (const Group& group : groups_) {
      const Eigen::Index size = group.covariance.rows();
      all.covariance.block(row, row, size, size) = group.covariance;
      row += size;
      for (CorrectionDatum datum : group.data) {
        datum.curve = group.curve;
        all.data.push_back(std::move(datum));
      }
    }
    return all;
  }

 private:
  [[nodiscard]] bool in_range(PhaseSurface surface, double V) const {
    return V > gray_.least_volume() && (surface == PhaseSurface::fluid || V < gray_.join_volume());
  }
  [[nodiscard]] GrayPoint at(PhaseSurface surface, double V, double T) const {
    return surface == PhaseSurface::solid ? gray_.solid(V, T) : gray_.fluid(V, T);
  }
  [[nodiscard]] CorrectionDatum pressure_datum(const StateKind& kind, PhaseSurface surface, double V,
                                               double T, double residual) const {
    return {kind.name + ", pressure",
            CorrectionRowKind::pressure,
            residual,
            bulk_modulus_,
            0.0,
            {{surface, V, T, {.F_V = -1.0}}},
            kind.group};
  }
  [[nodiscard]] CorrectionDatum energy_datum(const StateKind& kind, PhaseSurface surface, double V, double T,
                                             double residual) const {
    return {kind.name + ", energy",
            CorrectionRowKind::energy,
            residual,
            3.0 * gray_.specific_gas_constant() * T,
            1.0,
            {{surface, V, T, {.F = 1.0, .F_T = -T}}},
            kind.group};
  }

  void add(Group group) {
    group.curve = curve_;
    groups_.push_back(std::move(group));
  }

  const eos::GrayFreeEnergy& gray_;
  FilmErrors film_errors_;
  double bulk_modulus_;
  std::string curve_;
  std::vector<Group> groups_;
};

PhaseSurface phase_of(bool solid) { return solid ? PhaseSurface::solid : PhaseSurface::fluid; }

}  // namespace

CorrectionData joined(CorrectionData first, const CorrectionData& second) {
  const Eigen::Index begin = first.covariance.rows(), added = second.covariance.rows();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(begin + added, begin + added);
  covariance.topLeftCorner(begin, begin) = first.covariance;
  covariance.bottomRightCorner(added, added) = second.covariance;
  first.covariance = std::move(covariance);
  first.data.insert(first.data.end(), second.data.begin(), second.data.end());
  for (VarianceComponent deviation : second.deviations) {
    for (Eigen::Index& row : deviation.rows) row += begin;
    first.deviations.push_back(std::move(deviation));
  }
  return first;
}

CorrectionData correction_data(std::span<const md::PointRecord> points, const eos::GrayFreeEnergy& classical,
                               Films films, const FilmErrors& film_errors,
                               std::span<const double> melts_measured) {
  Collector collector(classical, film_errors);
  const auto add_state = [&](const StateKind& solid, const StateKind& molten, const md::StatePoint& p) {
    collector.state(p.solid ? solid : molten, phase_of(p.solid), p.specific_volume, p.temperature, p.pressure,
                    p.specific_internal_energy, p.error_correlation);
  };
  collector.begin_curve("isotherm");
  for (const md::StatePoint& p : md::select_as<md::StatePoint>(points, "isotherm"))
    add_state({"isotherm", CurveGroup::isotherm}, {"molten isotherm", CurveGroup::molten_isotherm}, p);
  for (const md::StatePoint& p : md::select_as<md::StatePoint>(points, "isochore")) {
    collector.begin_isochore("isochore", p.specific_volume);
    add_state({"isochore", CurveGroup::isochore}, {"molten isochore", CurveGroup::molten_isochore}, p);
  }
  collector.begin_curve("shock");
  for (const md::HugoniotPoint& p : md::select_as<md::HugoniotPoint>(points)) {
    if (!(p.temperature.value > 0.0)) continue;  // an older store
    // The errors of pressure, energy and temperature of a shock are those of one state on the curve: the energy
    // follows from the pressure by the jump condition.
    const StateKind kind =
        p.solid ? StateKind{"shock", CurveGroup::shock} : StateKind{"molten shock", CurveGroup::molten_shock};
    collector.state(kind, phase_of(p.solid), p.specific_volume, p.temperature.value, p.pressure,
                    p.specific_internal_energy, 0.0);
  }
  collector.begin_curve("volume at zero pressure");
  for (const md::ZeroPressurePoint& p : md::select_as<md::ZeroPressurePoint>(points)) {
    const double V = p.specific_volume.value;
    const double error =
        collector.modulus(PhaseSurface::solid, V, p.temperature) * p.specific_volume.error / V;
    collector.pressure({"volume at zero pressure", CurveGroup::zero_pressure}, PhaseSurface::solid, V,
                       p.temperature, p.pressure, error);
  }
  for (const md::FluidPoint& p : md::select_as<md::FluidPoint>(points)) {
    if (!p.uniform) continue;
    collector.begin_isochore("fluid", p.specific_volume);
    collector.state({"fluid", CurveGroup::fluid}, PhaseSurface::fluid, p.specific_volume, p.temperature,
                    p.pressure, p.specific_internal_energy, p.error_correlation);
  }
  collector.begin_curve("melt");
  for (const md::LiquidPoint& p : md::select_as<md::LiquidPoint>(points)) {
    if (!p.liquid) continue;
    const double V = p.specific_volume.value;
    const double error =
        collector.modulus(PhaseSurface::fluid, V, p.temperature) * p.specific_volume.error / V;
    if (p.specific_internal_energy.error > 0.0) {
      collector.state({"melt", CurveGroup::melt}, PhaseSurface::fluid, V, p.temperature, {p.pressure, error},
                      p.specific_internal_energy, 0.0);
    } else {
      collector.pressure({"melt", CurveGroup::melt}, PhaseSurface::fluid, V, p.temperature, p.pressure,
                         error);
    }
  }
  std::vector<double> known(melts_measured.begin(), melts_measured.end());
  for (const md::CoexistencePoint& p : md::select_as<md::CoexistencePoint>(points)) {
    collector.begin_curve(fmt::format("coexistence at {} Pa", p.pressure));
    collector.coexistence(p);
    if (p.fusion_volume) known.push_back(p.melting_temperature.value);
  }
  collector.melting_line(known);
  if (films == Films::left_out) return collector.result();
  for (const md::LiquidVapourPoint& p : md::select_as<md::LiquidVapourPoint>(points)) {
    collector.begin_curve(fmt::format("film of {} K", p.temperature));
    collector.film(p);
  }
  return collector.result();
}

}  // namespace whipple::fit
