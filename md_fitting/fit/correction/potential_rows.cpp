// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/correction/potential_rows.hpp"

#include <cmath>

namespace whipple::fit {
namespace {

using Eigen::Index;

constexpr double same_isochore = 1e-6;  // relative, of the volume
/// Standard deviations of the cold pressure and energy of a volume, in units of rho0 C^2 and C^2: not known.
constexpr double free_pressure = 0.1, free_energy = 0.1;

}  // namespace

void add_potential_errors(CorrectionData& data, const eos::GrayFreeEnergy& simulated,
                          const PotentialErrors& errors) {
  const eos::GrayConstants& c = simulated.constants();
  const double V0 = c.reference_specific_volume, energy = c.hugoniot_intercept * c.hugoniot_intercept;
  DeviatingRows thermal, anharmonic, melting, fusion;
  const auto volume = [&](std::size_t i) { return data.data[i].terms.front().volume; };
  const auto free_on_isochore = [&](std::size_t i, double size) {
    for (std::size_t k = 0; k < data.data.size(); ++k) {
      if (data.data[k].row == data.data[i].row &&
          std::abs(volume(k) - volume(i)) <= same_isochore * volume(i))
        data.covariance(static_cast<Index>(i), static_cast<Index>(k)) += size * size;
    }
  };
  for (std::size_t i = 0; i < data.data.size(); ++i) {
    const CorrectionDatum& datum = data.data[i];
    const auto row = static_cast<Index>(i);
    const double V = volume(i), T = datum.terms.front().temperature, place = V / V0;
    switch (datum.row) {
      case CorrectionRowKind::pressure:
        free_on_isochore(i, free_pressure * energy / V0);
        thermal.add(row,
                    errors.gruneisen * simulated.gamma(V) * 3.0 * simulated.specific_gas_constant() * T / V,
                    place);
        break;
      case CorrectionRowKind::energy:
        free_on_isochore(i, free_energy * energy);
        anharmonic.add(row, errors.anharmonic / c.molar_mass * T * T / 2.0, place);
        break;
      case CorrectionRowKind::gibbs:
        melting.add(row, errors.melting * datum.scale, place);
        break;
      case CorrectionRowKind::fusion:
        fusion.add(row, errors.fusion * datum.scale, place);
        break;
      case CorrectionRowKind::film:
      case CorrectionRowKind::kept:
      case CorrectionRowKind::measured:
        break;  // with errors of their own
    }
  }
  thermal.finish("thermal pressure", errors.volume_ratio, errors.spread, data.deviations);
  anharmonic.finish("anharmonic heat", errors.volume_ratio, errors.spread, data.deviations);
  melting.finish("melting temperature", errors.volume_ratio, errors.spread, data.deviations);
  fusion.finish("heat of fusion", errors.volume_ratio, errors.spread, data.deviations);
}

void move_to(CorrectionData& data, double ratio) {
  for (CorrectionDatum& datum : data.data) {
    for (SurfaceTerm& term : datum.terms) {
      term.volume *= ratio;
      term.weights.F_V *= ratio;
      term.weights.F_VT *= ratio;
      term.weights.F_VV *= ratio * ratio;
    }
  }
}

}  // namespace whipple::fit
