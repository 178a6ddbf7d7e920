// SPDX-License-Identifier: BSD-3-Clause
// GRAY over a wide range. Equation numbers: docs/theory/gray.md, section 12.
#include "eos/models/wide_gray_surfaces.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double greatest_compression = 10.0;

/// Holds the smooth step w of ln T with its derivatives by T.
struct Step {
  double w = 0, first = 0, second = 0;
};

/// Returns w = 35 q^4 - 84 q^5 + 70 q^6 - 20 q^7, q from 0 at the onset to 1: three continuous derivatives.
Step smooth_step(double T, double onset, double end) {
  const double rate = 1 / std::log(end / onset);
  const double q = std::clamp(rate * std::log(T / onset), 0.0, 1.0), r = 1 - q;
  const double w1 = 140 * q * q * q * r * r * r * rate;               // dw/d ln T
  const double w2 = 420 * q * q * r * r * (1 - 2 * q) * rate * rate;  // d2w/d(ln T)2
  return {q * q * q * q * (35 - q * (84 - q * (70 - q * 20))), w1 / T, (w2 - w1) / (T * T)};
}

FermiColdCurve continued(const GrayFreeEnergy& gray, const WideGrayConstants& constants,
                         double least_volume) {
  const GrayConstants& c = gray.constants();
  const double V0 = c.reference_specific_volume, V = constants.cold_join_ratio * V0;
  if (!(V > 1.02 * gray.least_volume()) || !(constants.cold_join_ratio < 1)) {
    throw InputError(
        fmt::format("gray_wide: cold_join_ratio must be between {:.4g}, where the cold curve of GRAY ends, "
                    "and 1, not {:.4g}",
                    1.02 * gray.least_volume() / V0, constants.cold_join_ratio));
  }
  const GrayIsochore join = gray.isochore(V);
  return FermiColdCurve(constants.atomic_number, c.molar_mass, V0, least_volume,
                        {V, join.solid.e0, join.solid.p0, join.solid.q0});
}

}  // namespace

ParameterTable<WideGrayConstants> WideGrayConstants::parameters() {
  using C = WideGrayConstants;
  ParameterTable<C> table = with_part(ParameterTable<C>{}, &C::gray, gray_parameters());
  table.append({
      real("atomic_number", &C::atomic_number, "", range::between(1, 100), "Z, electrons per atom"),
      real("cold_join_ratio", &C::cold_join_ratio, "", range::open_between(0.0, 1.0),
           "V/V0 at which the cold curve is continued to that of the degenerate electron gas")
          .optional(),
      real("electron_onset", &C::electron_onset, "K", range::positive(),
           "temperature at which the electrons of GRAY begin to be replaced by those of Thomas and Fermi")
          .optional(),
      real("electron_temperature", &C::electron_temperature, "K", range::positive(),
           "temperature above which they are replaced")
          .optional(),
  });
  return table;
}

WideGraySurfaces::WideGraySurfaces(const WideGrayConstants& constants)
    : constants_(constants),
      gray_(constants.gray),
      electrons_(constants.atomic_number, constants.gray.molar_mass),
      least_volume_(std::max(constants.gray.reference_specific_volume / greatest_compression,
                             electrons_.least_volume())),
      cold_(continued(gray_, constants, least_volume_)) {
  if (gray_.constants().melting != MeltingTransition::equilibrium)
    throw InputError("gray_wide: melting must be \"equilibrium\"");
  if (!(constants.electron_onset >= electrons_.least_temperature()) ||
      !(constants.electron_temperature > 1.5 * constants.electron_onset)) {
    throw InputError(fmt::format(
        "gray_wide: electron_onset must be at least {:.4g} K and electron_temperature more than 1.5 times "
        "that, not "
        "{:.4g} and {:.4g} K",
        electrons_.least_temperature(), constants.electron_onset, constants.electron_temperature));
  }
  check_stability();
}

GrayIsochore WideGraySurfaces::isochore(double V) const {
  if (V >= cold_.join_volume()) return gray_.isochore(V);
  const ColdPoint p = cold_(V);
  return gray_.isochore_of_cold_curve(V, p.energy, p.pressure, p.pressure_by_volume);
}

GrayPoint WideGraySurfaces::with_electrons(GrayPoint p, const GrayBranch& g, double V, double T) const {
  if (T <= constants_.electron_onset) return p;
  const FreeEnergyTerms f = electrons_(V, T);
  const Step s = smooth_step(T, constants_.electron_onset, constants_.electron_temperature);
  // D = F_TF + e2 T^2; F += w D
  const double D = f.F + g.e2 * T * T, D_T = f.F_T + 2 * g.e2 * T, D_TT = f.F_TT + 2 * g.e2;
  const double D_V = f.F_V + g.p2 * T * T, D_VT = f.F_VT + 2 * g.p2 * T, D_VV = f.F_VV + g.q2 * T * T;
  const double F_T = s.w * D_T + s.first * D, F_TT = s.w * D_TT + 2 * s.first * D_T + s.second * D;
  p.pressure -= s.w * D_V;
  p.entropy -= F_T;
  p.energy += s.w * D - T * F_T;
  p.heat_capacity -= T * F_TT;
  p.pressure_by_temperature -= s.w * D_VT + s.first * D_V;
  p.pressure_by_volume -= s.w * D_VV;
  return p;
}

GrayPoint WideGraySurfaces::solid(double V, double T) const {
  const GrayIsochore iso = isochore(V);
  return with_electrons(gray_.solid(iso, T), iso.solid, V, T);
}

GrayPoint WideGraySurfaces::liquid(double V, double T) const {
  const GrayIsochore iso = isochore(V);
  return with_electrons(gray_.liquid(iso, T), iso.solid, V, T);
}

GrayPoint WideGraySurfaces::fluid(double V, double T) const {
  if (V <= gray_.join_volume()) return liquid(V, T);
  // Of the hot branch, T^2 is the term of the electrons alone.
  return with_electrons(gray_.vapour(V, T), gray_.vapour_branch(V, true), V, T);
}

void WideGraySurfaces::check_stability() const {
  const double V0 = gray_.constants().reference_specific_volume;
  constexpr int volumes = 40, temperatures = 60;
  const double high = greatest_temperature();
  for (int i = 0; i <= volumes; ++i) {
    const double V = least_volume_ * std::pow(100 * V0 / least_volume_, static_cast<double>(i) / volumes);
    for (int k = 0; k <= temperatures; ++k) {
      const double T = std::min(high, constants_.electron_onset * std::pow(high / constants_.electron_onset,
                                                                           double(k) / temperatures));
      const GrayPoint p = fluid(V, T);
      const bool dense = V < V0;
      if (p.heat_capacity > 0 && (!dense || p.pressure_by_volume < 0)) continue;
      // The vapour of GRAY has such states itself (section 9).
      if (V > gray_.join_volume() && !(gray_.vapour(V, T).heat_capacity > 0)) continue;
      throw InputError(
          fmt::format("gray_wide: the fluid is not stable at V/V0 = {:.4g}, {:.5g} K (heat capacity {:.4g} "
                      "J/(kg K), bulk modulus "
                      "{:.4g} GPa); check electron_onset, electron_temperature and gruneisen_slope",
                      V / V0, T, p.heat_capacity, -V * p.pressure_by_volume * 1e-9));
    }
  }
}

SolidLiquidSurfaces WideGraySurfaces::melting_surfaces() const {
  return {.solid = [this](double V, double T) { return solid(V, T); },
          .liquid = [this](double V, double T) { return liquid(V, T); },
          .start_volume = gray_.constants().reference_specific_volume,
          .start_temperature = gray_.constants().melting_temperature,
          .least_volume = least_volume_,
          .join_volume = gray_.join_volume()};
}

}  // namespace whipple::eos
