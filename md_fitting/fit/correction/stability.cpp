// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/correction/stability.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whipple::fit {
namespace {

using eos::GrayPoint;

/// Least heat capacity and bulk modulus in units of those of GRAY.
constexpr double least_heat_capacity = 0.5, least_modulus = 0.4;
/// Least bulk modulus of the supercritical fluid in units of R T/V, from this multiple of GRAY's critical temperature on.
constexpr double least_gas_modulus = 0.05, supercritical = 1.2;
/// Least entropy of melting, and least distance of the free energies at half and at twice the melting temperature, at equal
/// volumes in units of those of GRAY: one melting temperature at every volume.
constexpr double least_melting = 0.2;
/// States of which GRAY's bulk modulus is below this fraction of rho0 C^2 are near a spinodal.
constexpr double near_spinodal = 0.1;

class Limits {
 public:
  Limits(const eos::GrayFreeEnergy& gray, const CorrectionGrids& grids) : gray_(gray), grids_(grids) {
    const eos::GrayConstants& c = gray.constants();
    modulus_ = c.hugoniot_intercept * c.hugoniot_intercept / c.reference_specific_volume;
  }

  void add(PhaseSurface surface, double V, double T) {
    const GrayPoint p = surface == PhaseSurface::solid ? gray_.solid(V, T) : gray_.fluid(V, T);
    if (p.heat_capacity > 0) push(surface, V, T, {.F_TT = -T / p.heat_capacity}, least_heat_capacity - 1.0);
    const bool condensed = V <= gray_.join_volume();
    const double modulus = -V * p.pressure_by_volume;
    if (condensed && modulus > near_spinodal * modulus_)
      push(surface, V, T, {.F_VV = V / modulus}, least_modulus - 1.0);
  }
  /// Adds that crystal and melt of one volume have one melting temperature, between half and twice that of GRAY.
  void add_melting(double V, double melting) {
    for (const double share : {0.5, 0.7, 1.0, 1.4, 2.0}) {
      const double T = share * melting;
      const GrayPoint s = gray_.solid(V, T), l = gray_.liquid(V, T);
      const double entropy = l.entropy - s.entropy, energy = (l.energy - s.energy) - T * entropy;
      push_melting(V, T, {.F_T = -1.0 / entropy});
      if (share == 0.5 || share == 2.0) push_melting(V, T, {.F = 1.0 / energy});
    }
  }
  /// Adds that an isotherm of the supercritical fluid falls.
  void add_supercritical(double V, double T) {
    const double gas = gray_.specific_gas_constant() * T / V;
    const double modulus = -V * gray_.fluid(V, T).pressure_by_volume;
    push(PhaseSurface::fluid, V, T, {.F_VV = V / gas}, least_gas_modulus - modulus / gas);
  }
  std::vector<StabilityLimit> result() && { return std::move(limits_); }

 private:
  void push_melting(double V, double T, const eos::FreeEnergyTerms& of_melt) {
    const eos::FreeEnergyTerms of_solid{.F = -of_melt.F, .F_T = -of_melt.F_T};
    limits_.push_back({V, T,
                       coefficient_row(grids_, {{PhaseSurface::fluid, V, T, of_melt},
                                                {PhaseSurface::solid, V, T, of_solid}}),
                       least_melting - 1.0});
  }
  void push(PhaseSurface surface, double V, double T, const eos::FreeEnergyTerms& weights, double least) {
    limits_.push_back({V, T, coefficient_row(grids_, {{surface, V, T, weights}}), least});
  }

  const eos::GrayFreeEnergy& gray_;
  const CorrectionGrids& grids_;
  double modulus_ = 0.0;
  std::vector<StabilityLimit> limits_;
};

}  // namespace

std::vector<StabilityLimit> stability_limits(const eos::GrayFreeEnergy& gray, const CorrectionGrids& grids) {
  Limits limits(gray, grids);
  const double least = std::max(1.001 * gray.least_volume(), grids.common.least_volume);
  const double join = gray.join_volume();
  constexpr int volumes = 36, thin_volumes = 12;
  for (int i = 0; i <= volumes; ++i) {
    const double V = least * std::pow(join / least, static_cast<double>(i) / volumes);
    const double melting = gray.melting_temperature(V);
    for (const double share : {0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2})
      limits.add(PhaseSurface::solid, V, share * melting);
    for (const double share : {0.8, 1.0, 1.3, 1.7, 2.5, 4.0, 6.0, 9.0})
      limits.add(PhaseSurface::fluid, V, share * melting);
    if (V < 1.1 * gray.constants().reference_specific_volume) limits.add_melting(V, melting);
  }
  const double melting = gray.melting_temperature(join);
  for (int i = 1; i <= thin_volumes; ++i) {
    const double V =
        join * std::pow(grids.fluid.greatest_volume / join, static_cast<double>(i) / thin_volumes);
    for (const double share : {1.0, 2.0, 4.0, 7.0, 12.0, 25.0})
      limits.add(PhaseSurface::fluid, V, share * melting);
  }
  const double critical = eos::critical_point(gray.dome_search()).temperature;
  constexpr int supercritical_volumes = 80;
  const double begin = gray.constants().reference_specific_volume;
  for (int i = 0; i <= supercritical_volumes; ++i) {
    const double V =
        begin * std::pow(grids.fluid.greatest_volume / begin, static_cast<double>(i) / supercritical_volumes);
    for (const double multiple : {1.0, 1.1, 1.2, 1.35, 1.5, 1.8, 2.2, 3.0, 4.0})
      limits.add_supercritical(V, multiple * supercritical * critical);
  }
  return std::move(limits).result();
}

std::vector<std::size_t> worst_violations(const std::vector<StabilityLimit>& limits, const Eigen::VectorXd& c,
                                          std::size_t most) {
  std::vector<std::pair<double, std::size_t>> violated;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const double lack = limits[i].least - limits[i].row.dot(c);
    if (lack > 0.0) violated.emplace_back(lack, i);
  }
  std::ranges::sort(violated, std::greater{});
  std::vector<std::size_t> indices;
  for (const auto& [lack, index] : violated) {
    if (indices.size() < most) indices.push_back(index);
  }
  return indices;
}

}  // namespace whipple::fit
