// SPDX-License-Identifier: BSD-3-Clause
// Corrected free energies. Equation numbers: docs/theory/gray.md.
#include "eos/models/corrected_gray_surfaces.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <utility>

#include "eos/root.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

/// Adds a correction F to a state  (G37).
GrayPoint corrected(GrayPoint p, const FreeEnergyTerms& f, double T) {
  p.pressure -= f.F_V;
  p.entropy -= f.F_T;
  p.energy += f.F - T * f.F_T;
  p.heat_capacity -= T * f.F_TT;
  p.pressure_by_temperature -= f.F_VT;
  p.pressure_by_volume -= f.F_VV;
  return p;
}

FreeEnergySpline spline(const CorrectionConstants& constants, const GrayConstants& gray) {
  std::vector<double> coefficients = constants.coefficients;
  for (double& c : coefficients) c *= gray.hugoniot_intercept * gray.hugoniot_intercept;
  return {constants.grid(gray), std::move(coefficients)};
}

}  // namespace

ParameterTable<CorrectionConstants> CorrectionConstants::parameters(const std::string& prefix,
                                                                    const std::string& of) {
  using C = CorrectionConstants;
  return {
      real(prefix + "_least_volume_ratio", &C::least_volume_ratio, "", range::positive(),
           fmt::format("V/V0 below which the correction of {} does not depend on the volume", of)),
      real(prefix + "_greatest_volume_ratio", &C::greatest_volume_ratio, "", range::positive(),
           "V/V0 above which it does not depend on the volume"),
      real(prefix + "_temperature", &C::temperature, "K", range::positive(), "T* of its u = T/(T + T*)"),
      integer(prefix + "_temperatures", &C::temperatures,
              {.lower = static_cast<double>(FreeEnergySpline::least_temperatures)},
              "number of its functions of the temperature"),
      real_list(prefix + "_coefficients", &C::coefficients, "", range::any(),
                "of its quintic splines, in units of hugoniot_intercept^2; the temperature runs fastest")};
}

FreeEnergyGrid CorrectionConstants::grid(const GrayConstants& gray) const {
  const auto functions = static_cast<std::size_t>(temperatures);
  if (functions == 0 || coefficients.size() % functions != 0) {
    throw InputError(
        fmt::format("gray_corrected: {} coefficients are no whole rows of {} functions of the temperature",
                    coefficients.size(), functions));
  }
  const double V0 = gray.reference_specific_volume;
  return {least_volume_ratio * V0, greatest_volume_ratio * V0, temperature, coefficients.size() / functions,
          functions};
}

ParameterTable<CorrectedGrayConstants> CorrectedGrayConstants::parameters() {
  using C = CorrectedGrayConstants;
  ParameterTable<C> table = with_part(ParameterTable<C>{}, &C::gray, gray_parameters());
  table = with_part(table, &C::common, CorrectionConstants::parameters("common", "solid and fluid"));
  return with_part(table, &C::fluid, CorrectionConstants::parameters("fluid", "the fluid alone"));
}

CorrectedGraySurfaces::CorrectedGraySurfaces(const CorrectedGrayConstants& constants)
    : gray_(constants.gray),
      common_(spline(constants.common, gray_.constants())),
      fluid_(spline(constants.fluid, gray_.constants())) {
  if (gray_.constants().melting != MeltingTransition::equilibrium) {
    throw InputError(
        "gray_corrected: melting must be \"equilibrium\": corrected phases have no other transition");
  }
}

GrayPoint CorrectedGraySurfaces::solid(double V, double T) const {
  return corrected(gray_.solid(V, T), common_(V, T), T);
}

GrayPoint CorrectedGraySurfaces::liquid(double V, double T) const {
  return corrected(corrected(gray_.liquid(V, T), common_(V, T), T), fluid_(V, T), T);
}

GrayPoint CorrectedGraySurfaces::fluid(double V, double T) const {
  return corrected(corrected(gray_.fluid(V, T), common_(V, T), T), fluid_(V, T), T);
}

double CorrectedGraySurfaces::isochoric_melting_temperature(double V) const {
  const auto excess = [&](double T) {
    const GrayPoint s = solid(V, T), l = liquid(V, T);
    return (l.energy - s.energy) - T * (l.entropy - s.entropy);
  };
  // Falls through zero: the entropy of the liquid is larger.
  const double guess = gray_.melting_temperature(V);
  constexpr double widest = 2.5;
  double low = guess, high = guess, factor = 1.05;
  while (excess(low) < 0 && low > guess / widest) low /= factor;
  while (excess(high) > 0 && high < guess * widest) high *= factor;
  if (!(excess(low) >= 0) || !(excess(high) <= 0)) {
    throw InputError(fmt::format(
        "gray_corrected: solid and liquid of V/V0 = {:.4g} have no equal free energies between {:.4g} and "
        "{:.4g} K",
        V / gray_.constants().reference_specific_volume, guess / widest, guess * widest));
  }
  return low == high ? low : find_root(excess, low, high, "isochoric melting temperature");
}

SolidLiquidSurfaces CorrectedGraySurfaces::melting_surfaces() const {
  const double V0 = gray_.constants().reference_specific_volume;
  return {.solid = [this](double V, double T) { return solid(V, T); },
          .liquid = [this](double V, double T) { return liquid(V, T); },
          .start_volume = V0,
          .start_temperature = isochoric_melting_temperature(V0),
          .least_volume = gray_.least_volume(),
          .join_volume = gray_.join_volume()};
}

}  // namespace whipple::eos
